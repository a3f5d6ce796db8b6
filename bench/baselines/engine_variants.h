#pragma once

#include <memory>

#include "edmd/engine.h"

/// The engine of the program itself, on rotating ellipses, with one of its devices taken out or changed:
/// what each of them gains. The collisions are the same.
namespace vitrel::bench {

/// Without the first look: every pair is searched.
std::unique_ptr<Engine2> make_engine_without_lower_bound();

/// Without the horizon: predictions for a particle look past the events already known of its
/// partners, as far as to its own.
std::unique_ptr<Engine2> make_engine_without_horizon();

/// With neighbourhoods shaped like the circumcircle, of the same margin, which a particle leaves by
/// translation alone.
std::unique_ptr<Engine2> make_engine_with_round_lists();

/// With another horizon of the search: contacts that cannot come within so many mean free times are put off; with
/// infinity, every contact that could come first is searched. The value is that of the thread.
std::unique_ptr<Engine2> make_engine_of_free_times();
void set_screened_free_times(double mean_free_times);

}  // namespace vitrel::bench

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

/// With another patience: a contact that cannot come within so many mean free times is not searched;
/// infinity: every one is that could come first. The patience is that of the thread when it predicts.
std::unique_ptr<Engine2> make_engine_of_patience();
void set_patience(double mean_free_times);

}  // namespace vitrel::bench

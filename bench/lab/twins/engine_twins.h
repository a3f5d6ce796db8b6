#pragma once

#include <cstdint>
#include <memory>

#include "edmd/engine.h"

/// The engine of the program itself, on rotating ellipses, with one of its devices taken out, or one
/// more put in: what each of them gains. The collisions are the same.
namespace vitrel::lab {

/// Without the first look: every pair is searched.
std::unique_ptr<Engine> make_engine_without_look();

/// Without the horizon: predictions for a particle look past the events already known of its
/// partners, as far as to its own.
std::unique_ptr<Engine> make_engine_without_horizon();

/// With neighbourhoods shaped like the circumcircle, of the same margin, which a particle leaves by
/// translation alone.
std::unique_ptr<Engine> make_engine_with_round_lists();

/// With lazy refinement: a contact that cannot come within the patience of this thread is not
/// searched; the particle is looked at again at the time before which the look rules it out.
std::unique_ptr<Engine> make_engine_with_lazy_searches();
void set_patience(double time);
/// Searches put off in this thread, which the engine counts as searches, since the last call.
std::uint64_t searches_put_off();

}  // namespace vitrel::lab

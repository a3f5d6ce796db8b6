#pragma once

#include <memory>

#include "edmd/engine.h"

/// @file
/// The engine for rotating ellipses with one optimisation removed or changed, to measure its speed-up. All variants
/// simulate the same collisions.
namespace vitrel::bench {

/// Without the contact screen: every pair is searched.
std::unique_ptr<Engine2> make_engine_without_lower_bound();

/// Without the partner's horizon: predictions for a particle extend up to its own next event, past those already
/// known for its partners.
std::unique_ptr<Engine2> make_engine_without_horizon();

/// With neighbourhoods shaped like the circumcircle and of the same margin. A particle leaves them only by
/// translation.
std::unique_ptr<Engine2> make_engine_with_round_lists();

/// With another search window: a contact that cannot occur within this number of mean free times is not searched yet.
/// With an infinite window every contact that could come first is searched. The window is that of the current thread
/// at the time of the prediction.
std::unique_ptr<Engine2> make_engine_with_search_window();
void set_search_window(double mean_free_times);

}  // namespace vitrel::bench

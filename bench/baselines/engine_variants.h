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

}  // namespace vitrel::bench

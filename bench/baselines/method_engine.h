#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "bench/methods/method.h"
#include "edmd/engine.h"

namespace vitrel::bench {

/// The engine of the program with its own events and lists, but with another method to predict collisions. If the
/// method has no answer, or if it finds a contact at which the surfaces recede (of the pair that has just collided),
/// there is no contact; the default method has neither. `options.on_overlap` determines what happens to a pair that
/// the method finds overlapping, or that has come to overlap. `method` must outlive the engine. Only one such engine
/// may run at a time per thread.
std::unique_ptr<Engine2> make_method_engine(const Method& method, const EngineOptions& options);

/// The first `count` predictions that the engine requests on the way from `start`, velocities included, in this order
/// and with the horizons that the engine sets. Pairs whose circumcircles stay apart are left out, because every
/// method dismisses them in closed form.
std::vector<CollisionCase> recorded_cases(const Configuration2& start, std::size_t count);

}  // namespace vitrel::bench

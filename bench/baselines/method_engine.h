#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "bench/methods/method.h"
#include "edmd/engine.h"

namespace vitrel::bench {

/// The engine of the program itself, its events and lists unchanged, with another method to predict
/// collisions. No answer, and a contact at which the surfaces recede (the pair that has just
/// collided), count as no contact; the default gives neither. A pair that the method finds, or that
/// has come to be, overlapping is treated as `options.on_overlap` says. `method` must outlive the
/// engine; one such engine at a time per thread.
std::unique_ptr<Engine2> make_method_engine(const Method& method, const EngineOptions& options);

/// Every question that the engine asks its predictor on the way from `start`, velocities included,
/// in the order in which it asks: `count` of them, the horizon as the engine sets it. Pairs whose
/// circumcircles stay apart are left out, since every method dismisses them in closed form.
std::vector<CollisionCase> recorded_cases(const Configuration2& start, std::size_t count);

}  // namespace vitrel::bench

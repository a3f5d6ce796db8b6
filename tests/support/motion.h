#pragma once

#include <algorithm>
#include <cmath>

#include "edmd/brownian.h"
#include "edmd/engine.h"

/// Engines at work, for tests that compare their motions.
namespace vitrel {

/// The same with velocities of Maxwell's distribution.
inline Configuration2 moving(Configuration2 c, std::uint64_t seed = 1) {
  set_initial_velocities(c, seed, InitialVelocities::maxwell, Temperature::total);
  return c;
}

/// Runs the engine to `until`, over the ends of blocks, and writes where it is.
inline void advance(Engine2& engine, Configuration2& now, double until, RunCounters& counters) {
  while (engine.advance(until, counters) == Engine2::Stop::block_end) {
    engine.write(now);
    engine.load(now);
  }
  engine.write(now);
}

/// The largest difference of a position, an angle or a velocity.
inline double difference(const Configuration2& one, const Configuration2& two) {
  double largest = 0;
  for (std::size_t i = 0; i < one.size(); ++i)
    largest =
        std::max({largest, (one.unwrapped(i) - two.unwrapped(i)).norm(),
                  (one.velocity[i] - two.velocity[i]).norm(), std::abs(one.angle[i] - two.angle[i]),
                  std::abs(one.angular_velocity[i] - two.angular_velocity[i])});
  return largest;
}

}  // namespace vitrel

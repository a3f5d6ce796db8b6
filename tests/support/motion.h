#pragma once

#include <algorithm>
#include <cmath>

#include "edmd/brownian.h"
#include "edmd/engine.h"

/// Engines at work, for tests that compare their motions.
namespace vitrel {

/// The same with velocities of Maxwell's distribution.
template <int Dim>
Configuration<Dim> moving(Configuration<Dim> c, std::uint64_t seed = 1) {
  set_initial_velocities(c, seed, InitialVelocities::maxwell, Temperature::total);
  return c;
}

/// Runs the engine to `until`, over the ends of blocks, and writes where it is.
template <int Dim>
void advance(Engine<Dim>& engine, Configuration<Dim>& now, double until, RunCounters& counters) {
  while (engine.advance(until, counters) == Engine<Dim>::Stop::block_end) {
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

inline double difference(const Configuration3& one, const Configuration3& two) {
  double largest = 0;
  for (std::size_t i = 0; i < one.size(); ++i)
    largest = std::max({largest, (one.unwrapped(i) - two.unwrapped(i)).norm(),
                        (one.velocity[i] - two.velocity[i]).norm(),
                        one.orientation[i].angularDistance(two.orientation[i]),
                        (one.angular_velocity[i] - two.angular_velocity[i]).norm()});
  return largest;
}

}  // namespace vitrel

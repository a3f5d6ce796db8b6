#pragma once

#include <vector>

#include "analysis/trajectory.h"
#include "tests/support/solids.h"

/// Bodies in space that do not see each other.
namespace vitrel {

/// Bodies of these semi-axes that hop and turn at random by up to `turn` between frames.
inline MemoryTrajectory3 walkers(std::size_t n, std::size_t frames, const Vec3& semi_axes,
                                 double turn, std::uint64_t seed) {
  Stream draw(seed, Purpose::tests);
  Configuration3 c;
  c.resize(n);
  c.species_names = {"A"};
  c.box = PeriodicBox<3>(Vec3(4, 5, 6));
  for (std::size_t i = 0; i < n; ++i) {
    c.shape[i].semi_axes = semi_axes;
    c.orientation[i] = random_orientation(draw);
  }
  std::vector<Configuration3> all;
  for (std::size_t k = 0; k < frames; ++k) {
    c.time = 0.5 * static_cast<double>(k);
    all.push_back(c);
    for (std::size_t i = 0; i < n; ++i) {
      c.position[i] += 0.7 * Vec3{draw.normal(), draw.normal(), draw.normal()};
      c.box.wrap(c.position[i], c.image[i]);
      const Eigen::AngleAxisd step{draw.uniform(0, turn), random_direction(draw)};
      c.orientation[i] = (Quaternion(step) * c.orientation[i]).normalized();
    }
  }
  return MemoryTrajectory3(std::move(all));
}

}  // namespace vitrel

#include "analysis/dynamics/director_frame.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/frames.h"
#include "tests/support/scenes.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;

/// Three ellipses at −0.2, 0 and 0.2 from a director that turns by 0.7 per frame, and a disk.
MemoryTrajectory2 turning_nematic() {
  Configuration2 start;
  start.resize(4);
  for (int i = 0; i < 3; ++i) start.shape[i] = of_aspect_ratio(3);
  return trajectory_of(20, start, [](Configuration2& c, std::size_t k) {
    c.time = static_cast<double>(k);
    for (int i = 0; i < 3; ++i) c.angle[i] = 0.3 + 0.7 * c.time + 0.2 * (i - 1);
    c.position[1] = Vec2(0.5, c.time);
  });
}

// The director is followed over more than four turns, so that angles beside it stand still.
TEST(DirectorFrame, AnglesAreThoseToTheDirector) {
  MemoryTrajectory2 trajectory = turning_nematic();
  DirectorFrame<2> seen(trajectory);
  EXPECT_EQ(seen.times(), trajectory.times());
  for (std::size_t k = 0; k < seen.frames(); ++k) {
    const Configuration2& frame = seen.read(k);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(frame.angle[i], 0.2 * (i - 1), 1e-12) << k;
    EXPECT_EQ(frame.position[1], Vec2(0.5, static_cast<double>(k)));
  }
}

// Half a turn of a particle is a turn beside the director too: angles stay unwrapped.
TEST(DirectorFrame, TurnsOfParticlesStay) {
  MemoryTrajectory2 trajectory = turning_nematic();
  Configuration2 last = trajectory.read(19);
  last.time = 20;
  last.angle[2] += 3 * pi;
  MemoryTrajectory2 two({trajectory.read(19), last});
  DirectorFrame<2> seen(two);
  EXPECT_NEAR(seen.read(1).angle[2] - seen.read(0).angle[2], 3 * pi, 1e-12);
}

}  // namespace
}  // namespace vitrel

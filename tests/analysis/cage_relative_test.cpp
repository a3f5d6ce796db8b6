#include "analysis/dynamics/cage_relative.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/dynamics/displacement.h"
#include "analysis/structure/voronoi.h"
#include "tests/support/frames.h"
#include "tests/support/free_brownian.h"
#include "tests/support/random_gas.h"

namespace vitrel {
namespace {

/// Disks that start anywhere.
Configuration2 gas(std::size_t n, std::uint64_t seed) {
  return random_gas<2>(n, {12, 10}, seed);
}

Vec2 moved(const Configuration2& from, const Configuration2& to, std::size_t i) {
  return to.unwrapped(i) - from.unwrapped(i);
}

TEST(CageRelative, IsThatOfALoopOverNeighbours) {
  MemoryTrajectory2 trajectory = free_brownian(gas(25, 1), 40, 2);
  const CageRelative found =
      *cage_relative(trajectory, {.wave_numbers = {0.5, 2}, .overlap_distance = 0.4});
  for (const std::size_t lag : {1u, 3u, 10u}) {
    double square = 0, scattering = 0, overlap = 0, count = 0;
    for (std::size_t k = 0; k + lag < 40; ++k) {
      const Configuration2 from = trajectory.read(k), to = trajectory.read(k + lag);
      const Voronoi voronoi(from);
      for (std::size_t i = 0; i < 25; ++i, ++count) {
        Vec2 around = Vec2::Zero();
        double neighbors = 0;
        for (const VoronoiEdge& edge : voronoi.cell(i).edges) {
          around += moved(from, to, edge.neighbor);
          ++neighbors;
        }
        const double distance = (moved(from, to, i) - around / neighbors).norm();
        square += distance * distance;
        scattering += ::j0(2 * distance);
        overlap += distance < 0.4;
      }
    }
    EXPECT_NEAR(found.square.value[lag - 1], square / count, 1e-12);
    EXPECT_NEAR(found.self_scattering[1].value[lag - 1], scattering / count, 1e-9);
    EXPECT_NEAR(found.overlap.value[lag - 1], overlap / count, 1e-12);
  }
}

// ⟨|Δr_c|²⟩ = ⟨|Δr|²⟩ (1 + ⟨1/n⟩): four standard errors.
TEST(CageRelative, IndependentParticlesFollowTheClosedForm) {
  MemoryTrajectory2 trajectory = free_brownian(gas(200, 3), 400, 4);
  const CageRelative found = *cage_relative(trajectory);
  double inverse = 0, count = 0;
  for (std::size_t k = 0; k < trajectory.frames(); k += 20) {
    const Voronoi voronoi(trajectory.read(k));
    for (std::size_t i = 0; i < 200; ++i, ++count)
      inverse += 1 / static_cast<double>(voronoi.cell(i).edges.size());
  }
  for (const std::size_t l : {0u, 4u, 19u}) {
    const double expected = free_msd(found.lag[l]) * (1 + inverse / count);
    EXPECT_NEAR(found.square.value[l], expected, 4 * found.square.error[l]) << found.lag[l];
    EXPECT_GT(found.square.error[l], 0);
  }
}

// A wave as long as the box moves particles far, but neighbours together.
TEST(CageRelative, LongWavesDoNotMatter) {
  const Configuration2 start = gas(2000, 5);
  MemoryTrajectory2 trajectory = trajectory_of(40, start, [&](Configuration2& c, std::size_t k) {
    c = start;
    c.time = static_cast<double>(k);
    for (std::size_t i = 0; i < c.size(); ++i) {
      const double phase = 2 * M_PI * start.position[i].x() / 12;
      c.position[i] += Vec2(0, 2 * std::sin(phase) * std::sin(0.3 * c.time) + c.time);
      c.box.wrap(c.position[i], c.image[i]);
    }
  });
  const CageRelative found = *cage_relative(trajectory);
  const Displacements usual = displacements(trajectory);
  // Neighbours are some 0.25 apart in x: the wave differs by 2π/12 · 0.25 of its height, squared and averaged
  // over six neighbours 0.003 of its mean square; the drift is not seen at all.
  for (std::size_t l = 0; l < found.lag.size(); ++l)
    EXPECT_LT(found.square.value[l], 0.02 * 4 + 1e-12 * usual.groups[0].translation.value[l]);
  EXPECT_GT(usual.groups[0].translation.value.back(), 100);
}

TEST(CageRelative, IsNotGivenBeyondTheMemory) {
  MemoryTrajectory2 trajectory = free_brownian(gas(50, 6), 100, 7);
  EXPECT_FALSE(cage_relative(trajectory, {.memory = std::size_t{50} * 100 * 16}));
  EXPECT_TRUE(cage_relative(trajectory, {.memory = std::size_t{50} * 100 * 44}));
}

TEST(CageRelative, DoesNotDependOnThreads) {
  MemoryTrajectory2 trajectory = free_brownian(gas(50, 8), 100, 9);
  const CageRelative one = *cage_relative(trajectory, {.threads = 1});
  const CageRelative three = *cage_relative(trajectory, {.threads = 3});
  EXPECT_EQ(one.square.value, three.square.value);
  EXPECT_EQ(one.square.error, three.square.error);
}

}  // namespace
}  // namespace vitrel

#include "analysis/dynamics/four_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "analysis/dynamics/collective_scattering.h"
#include "core/random/stream.h"
#include "tests/support/frames.h"
#include "tests/support/random_gas.h"
#include "tests/support/scenes.h"

namespace vitrel {
namespace {

/// Every particle is in one of `states` boxes at every frame, at the same place in each: from any frame to any other it
/// stays with probability 1/states, whatever it does elsewhere.
template <int Dim>
MemoryTrajectory<Dim> jumping(const Configuration<Dim>& places, std::size_t frames,
                              std::uint64_t states) {
  Stream draw(2, Purpose::tests);
  return trajectory_of(frames, places, [&](Configuration<Dim>& c, std::size_t k) {
    c.time = static_cast<double>(k);
    for (Shift<Dim>& image : c.image) image[0] = static_cast<std::int32_t>(draw.below(states));
  });
}

/// The wave numbers of the eight shells, in steps of the longest side.
template <int Dim>
std::vector<double> shells(const PeriodicBox<Dim>& box) {
  std::vector<double> wave_numbers;
  for (int k = 1; k <= 8; ++k)
    wave_numbers.push_back(2 * std::numbers::pi * k / box.lengths().maxCoeff());
  return wave_numbers;
}

/// S(q) of the places in the same shells.
template <int Dim>
std::vector<double> structure_factors(MemoryTrajectory<Dim>& trajectory) {
  std::vector<double> factors;
  const std::vector<double> wave_numbers = shells(trajectory.read(0).box);
  for (const Correlation& f : collective_scattering(trajectory, wave_numbers).scattering)
    factors.push_back(f.value[0]);
  return factors;
}

template <int Dim>
TwoTimeAverages four_point(MemoryTrajectory<Dim>& trajectory, double overlap_distance = 0.3,
                           int threads = all_cores) {
  const PeriodicBox<Dim> box = trajectory.read(0).box;
  return average_two_times<Dim>(trajectory, few_lags_of_motion(trajectory, {}),
                                {four_point_structure(box, overlap_distance)}, {}, threads)
      .front();
}

template <int Dim>
void expect_structure_factor(const Vec<Dim>& lengths) {
  auto trajectory = jumping<Dim>(random_gas<Dim>(Dim == 2 ? 25 : 125, lengths, 1), 30, 1);
  const TwoTimeAverages found = four_point(trajectory);
  ASSERT_EQ(found.x.size(), 8u);
  const std::vector<double> expected = structure_factors(trajectory);
  for (std::size_t s = 0; s < 8; ++s)
    for (std::size_t l = 0; l < found.at_lag.size(); ++l)
      EXPECT_NEAR(found.at_lag[l].mean[s], expected[s], 1e-12);
}

TEST(FourPointStructure, OfFrozenParticlesIsTheStructureFactor) {
  expect_structure_factor<2>({10, 10});
  expect_structure_factor<3>({8, 8, 8});
}

// S₄ = p² S + p (1 − p), with S of the places and p = 1/3. |Σ w exp(iq·r)|² varies by no more than its mean from one
// origin to another, and from one wave vector to another; so the mean quotient of all has the limit below, five of its
// standard deviations, and that of a single shell and lag as well.
template <int Dim>
void expect_independent(const Configuration<Dim>& places, std::size_t frames) {
  auto trajectory = jumping<Dim>(places, frames, 3);
  const TwoTimeAverages found = four_point(trajectory);
  const std::vector<Lag> lags = few_lags_of_motion(trajectory, {});
  const std::vector<double> still = structure_factors(trajectory);
  double quotients = 0, count = 0;
  for (std::size_t s = 0; s < 8; ++s)
    for (std::size_t l = 0; l < found.at_lag.size(); ++l) {
      const double expected = still[s] / 9 + 2. / 9;
      const std::size_t vectors = wave_vector_shell(places.box, shells(places.box)[s]).n.size();
      const auto modes = static_cast<double>(vectors * lags[l].origins);
      EXPECT_NEAR(found.at_lag[l].mean[s] / expected, 1, 5 / std::sqrt(modes));
      quotients += modes * found.at_lag[l].mean[s] / expected;
      count += modes;
    }
  EXPECT_NEAR(quotients / count, 1, 5 / std::sqrt(count));
}

TEST(FourPointStructure, OfIndependentParticlesFollowsFromTheirShareWithinTheDistance) {
  expect_independent<2>(random_gas<2>(400, {30, 30}, 1), 200);
  expect_independent<3>(random_gas<3>(343, {15, 15, 15}, 1), 200);
  // On a lattice S = 0 at these q, and S₄ is χ₄ = p (1 − p).
  const auto lattice = square_lattice(20, 0.5, 0, [](std::size_t) { return Ellipse{1, 1}; });
  expect_independent<2>(lattice, 200);
  auto trajectory = jumping<2>(lattice, 200, 3);
  EXPECT_LT(structure_factors(trajectory)[0], 1e-12);
}

// At a = 0 nobody counts as still, and beyond the longest way everybody.
TEST(FourPointStructure, DependsOnTheDistance) {
  auto trajectory = jumping<2>(random_gas<2>(36, {10, 10}, 1), 40, 3);
  const TwoTimeAverages none = four_point(trajectory, 0);
  const TwoTimeAverages all = four_point(trajectory, 21);
  const double still = structure_factors(trajectory)[2];
  for (std::size_t l = 0; l < all.at_lag.size(); ++l) {
    EXPECT_EQ(none.at_lag[l].mean[2], 0);
    EXPECT_NEAR(all.at_lag[l].mean[2], still, 1e-12);
  }
}

TEST(FourPointStructure, ResultDoesNotDependOnTheNumberOfThreads) {
  auto trajectory = jumping<2>(random_gas<2>(36, {10, 10}, 1), 40, 3);
  const TwoTimeAverages one = four_point(trajectory, 0.3, 1), many = four_point(trajectory, 0.3, 4);
  for (std::size_t l = 0; l < one.at_lag.size(); ++l) {
    EXPECT_EQ(one.at_lag[l].mean, many.at_lag[l].mean);
    EXPECT_EQ(one.at_lag[l].error.size(), 8u);
  }
}

}  // namespace
}  // namespace vitrel

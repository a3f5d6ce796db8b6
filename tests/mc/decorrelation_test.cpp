#include "mc/decorrelation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bench/reference/literature.h"
#include "mc/contact_pressure.h"
#include "mc/hard_core.h"
#include "mc/lattice.h"
#include "mc/sampler.h"
#include "tests/support/equal_bodies.h"
#include "tests/support/visited_states.h"

namespace vitrel {
namespace {

Configuration2 dilute(double aspect_ratio) {
  return square_lattice(10, 0.2, 0, of_aspect_ratio(aspect_ratio));
}

TEST(Decorrelation, LeavesTheStateAndNumbersItsSweeps) {
  const Configuration2 state = dilute(2);
  const auto one = measure_decorrelation(state, 50, 7, 3, {}),
             same = measure_decorrelation(state, 50, 7, 3, {});
  ASSERT_TRUE(one && same);
  EXPECT_EQ(one->orientation, same->orientation);
  EXPECT_EQ(one->compressibility, same->compressibility);
  EXPECT_NE(one->orientation, measure_decorrelation(state, 50, 7, 4, {})->orientation);
  EXPECT_NE(one->orientation, measure_decorrelation(state, 50, 8, 3, {})->orientation);
  EXPECT_EQ(one->measured, 40u);
  EXPECT_EQ(one->compressibility.size(), 8u);
}

// By hand, with the sampler itself: a fifth of 500 sweeps with a tuning after every fifth one, then 400
// with fixed steps.
TEST(Decorrelation, MeasuresWhatTheSamplerDoes) {
  const Configuration2 state = dilute(2);
  const auto result = measure_decorrelation(state, 500, 7, 3, {});
  ASSERT_TRUE(result);
  Configuration2 copy = state;
  Sampler sampler(copy, 7, {.next_sweep = 3});
  sweep_and_tune(sampler, 100, 5);
  const Configuration2 start = copy;
  std::vector<double> orientation, displacement, pressures;
  ContactPressure pressure;
  for (int t = 1; t <= 400; ++t) {
    sampler.sweep();
    double kept = 0, moved = 0;
    for (std::size_t i = 0; i < copy.size(); ++i) {
      kept += std::cos(2 * copy.angle[i] - 2 * start.angle[i]) / 100;
      moved += (copy.unwrapped(i) - start.unwrapped(i)).squaredNorm() / 100;
    }
    orientation.push_back(kept);
    displacement.push_back(std::sqrt(moved) / std::sqrt(2.0));  // 2b = √2
    if (t % 5 != 1) continue;
    pressure.clear();
    pressure.add(copy);
    pressures.push_back(pressure.compressibility());
  }
  EXPECT_EQ(result->compressibility, pressures);
  ASSERT_EQ(result->sweeps.front(), 1);
  for (std::size_t k = 0; k < result->sweeps.size(); ++k) {
    const auto t = static_cast<std::size_t>(result->sweeps[k]);
    EXPECT_NEAR(result->orientation[k], orientation[t - 1], 1e-12);
    EXPECT_NEAR(result->displacement[k], displacement[t - 1], 1e-12 * displacement[t - 1]);
  }
  const auto first = [](const std::vector<double>& values, const auto& holds) {
    return static_cast<std::uint64_t>(std::ranges::find_if(values, holds) - values.begin()) + 1;
  };
  EXPECT_EQ(result->orientation_time,
            first(orientation, [](double c) { return c < std::exp(-1); }));
  EXPECT_EQ(result->displacement_time, first(displacement, [](double moved) { return moved > 1; }));
  // Far enough that some particles left the box.
  EXPECT_GT(displacement.back(), 1);
}

// Monte Carlo of the ideal gas is a random walk. Each particle is tried once a sweep on the
// average, a number of Poisson distribution, half of the times turned by up to ± w: C₂(t) =
// exp(−t/2 (1 − sin(2w)/(2w))). All steps are accepted, so tuning makes them as large as it may: w
// = π/2, where sin 2w = 0.
TEST(Decorrelation, OrientationsOfAnIdealGasAreLostAtAKnownRate) {
  Configuration2 state = dilute(1.5);
  for (Ellipse& shape : state.shape) shape = scaled(shape, 1e-3);
  const auto result = measure_decorrelation(state, 500, 1, 0, {});
  ASSERT_TRUE(result && result->orientation.size() > 3);
  // C₂ of 100 particles scatters by less than 1/√200; five standard deviations.
  for (const std::size_t k : {0u, 1u, 2u})
    EXPECT_NEAR(result->orientation[k], std::exp(-0.5 * result->sweeps[k]), 5 / std::sqrt(200.0));
  ASSERT_TRUE(result->orientation_time);
  EXPECT_GE(*result->orientation_time, 1u);
  EXPECT_LE(*result->orientation_time, 4u);
  EXPECT_EQ(*result->displacement_time, 1u);
}

TEST(Decorrelation, DenseCrystalsKeepTheirPlacesAndOrientations) {
  Configuration2 state = dilute(2);
  scale_to_packing_fraction(state, 0.88);
  place_on_lattice(state, {Arrangement::triangular, 0});
  const auto result = measure_decorrelation(state, 200, 1, 0, {});
  ASSERT_TRUE(result);
  EXPECT_FALSE(result->orientation_time);
  EXPECT_FALSE(result->displacement_time);
  EXPECT_GT(result->orientation.back(), 0.9);
  EXPECT_LT(result->displacement.back(), 0.5);
  EXPECT_GT(result->displacement.back(), 0);
}

TEST(Decorrelation, RoundParticlesHaveNoOrientationToLose) {
  const auto result = measure_decorrelation(dilute(1), 1000, 1, 0, {});
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->orientation.empty());
  EXPECT_FALSE(result->orientation_time);
  EXPECT_TRUE(result->displacement_time);
}

TEST(Decorrelation, EvenOneSweepIsMeasured) {
  const auto result = measure_decorrelation(dilute(2), 1, 1, 0, {});
  ASSERT_TRUE(result);
  EXPECT_EQ(result->measured, 1u);
  EXPECT_EQ(result->compressibility.size(), 1u);
}

// 720 configurations of 400 disks in ten
// blocks, five standard errors: with ten blocks, a false alarm in 1500.
TEST(Decorrelation, ThePressureIsThatOfTheDiskFluid) {
  const Configuration2 state = lattice_of_disks(20, 0.3);
  const auto result = measure_decorrelation(state, 4500, 2, 0, {});
  ASSERT_TRUE(result);
  std::vector<double> blocks;
  for (std::size_t k = 0; k + 72 <= result->compressibility.size(); k += 72) {
    double sum = 0;
    for (std::size_t m = 0; m < 72; ++m) sum += result->compressibility[k + m] / 72;
    blocks.push_back(sum);
  }
  ASSERT_EQ(blocks.size(), 10u);
  const Estimate z = estimate(blocks);
  EXPECT_LT(z.error, 0.02);
  EXPECT_NEAR(z.mean, fluid_pressure(1, 0.3).z, 5 * z.error);
}

TEST(Decorrelation, TheBudgetStopsIt) {
  RunControl control;
  int asked = 0;
  control.should_stop = [&] { return ++asked > 3; };
  EXPECT_FALSE(measure_decorrelation(dilute(2), 50, 1, 0, control));
  EXPECT_EQ(asked, 4);
}

// In space, by hand again: P₂ of the axes of spheroids, displacements in widths, and Z of the contact function.
TEST(Decorrelation, InSpaceMeasuresWhatTheSamplerDoes) {
  const Configuration3 state =
      cubic_lattice(5, 0.15, [](std::size_t i) { return i % 2 ? prolate(2) : Ellipsoid{}; });
  const auto result = measure_decorrelation(state, 100, 7, 3, {}, 2);
  ASSERT_TRUE(result);
  Configuration3 copy = state;
  Sampler sampler(copy, 7, {.next_sweep = 3});
  sweep_and_tune(sampler, 20, 5);
  const Configuration3 start = copy;
  sampler.sweep();
  double kept = 0, moved = 0;
  for (std::size_t i = 0; i < copy.size(); ++i) {
    const double width = 2 * copy.shape[i].inradius();
    moved += (copy.unwrapped(i) - start.unwrapped(i)).squaredNorm() / (width * width) / 125;
    if (i % 2 == 0) continue;
    const Vec3 before = start.orientation[i] * Vec3::UnitX();
    kept += std::legendre(2, before.dot(copy.orientation[i] * Vec3::UnitX())) / 62;
  }
  EXPECT_NEAR(result->orientation[0], kept, 1e-13);
  EXPECT_NEAR(result->displacement[0], std::sqrt(moved), 1e-13);
  ContactPressure pressure;
  pressure.add(copy);
  EXPECT_EQ(result->compressibility[0], pressure.compressibility());
  ASSERT_TRUE(result->orientation_time);
  EXPECT_LT(*result->orientation_time, 60u);
}

}  // namespace
}  // namespace vitrel

#include "analysis/displacement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/random/stream.h"

namespace vitrel {
namespace {

constexpr double brownian_step = 0.1;

/// n ellipses of aspect ratio 2 (a b = 1), mass 1, at the origin of a box that is soon left.
Configuration2 ellipses(std::size_t n) {
  Configuration2 configuration;
  configuration.box = PeriodicBox<2>(Vec2(5, 7));
  configuration.species_names = {"A"};
  configuration.resize(n);
  for (Ellipse& shape : configuration.shape) shape = {std::sqrt(2.0), std::sqrt(0.5)};
  return configuration;
}

void fly(Configuration2& configuration, double time) {
  configuration.time += time;
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    configuration.position[i] += time * configuration.velocity[i];
    configuration.box.wrap(configuration.position[i], configuration.image[i]);
    configuration.angle[i] += time * configuration.angular_velocity[i];
  }
}

void redraw_velocities(Configuration2& configuration, Stream& draw) {
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const double speed = std::sqrt(1 / configuration.mass[i]);
    configuration.velocity[i] = {speed * draw.normal(), speed * draw.normal()};
    configuration.angular_velocity[i] = draw.normal() / std::sqrt(configuration.inertia(i));
  }
}

/// Free particles whose velocities are drawn anew after every step: the k-th frame follows k steps.
MemoryTrajectory free_brownian(Configuration2 configuration, std::size_t frames,
                               std::uint64_t seed) {
  Stream draw(seed, Purpose::tests);
  std::vector<Configuration2> saved{configuration};
  while (saved.size() < frames) {
    redraw_velocities(configuration, draw);
    fly(configuration, brownian_step);
    saved.push_back(configuration);
  }
  return MemoryTrajectory(std::move(saved));
}

// Closed forms after n steps: MSD = 2 n τ² kT/m, MSR = n τ² kT/I.
double free_msd(double time) {
  return 2 * brownian_step * time;
}
double free_msr(double time, double inertia) {
  return brownian_step * time / inertia;
}

// 3 standard errors: false-alarm rate 0.3 % (0.6 % with the fewest blocks) for each of these
// points.
TEST(Displacement, FreeBrownianParticlesFollowTheClosedForm) {
  const Configuration2 start = ellipses(100);
  const double inertia = start.inertia(0);
  MemoryTrajectory trajectory = free_brownian(start, 801, 1);
  const Displacements result = displacements(trajectory);
  ASSERT_EQ(result.groups.size(), 1u);
  const DisplacementGroup& all = result.groups[0];
  EXPECT_EQ(all.rotors, 100u);
  for (const std::size_t k : {0u, 1u, 4u, 19u, 99u, 115u}) {
    const double t = result.lag.at(k);
    EXPECT_NEAR(all.translation.value.at(k), free_msd(t), 3 * all.translation.error[k]) << t;
    EXPECT_NEAR(all.rotation.value.at(k), free_msr(t, inertia), 3 * all.rotation.error[k]) << t;
    EXPECT_LT(all.translation.error[k], 0.1 * free_msd(t));
  }
  EXPECT_LE(result.lag.back(), 40 + 1e-9);
  EXPECT_GT(result.lag.back(), 37);
}

/// Counts of truths within one and two errors over many runs, for one lag.
struct Coverage {
  double lag;
  bool blocked = false;
  int msd_one = 0, msd_two = 0, msr_one = 0, msr_two = 0;
};

void count(Coverage& coverage, const Displacements& result, double inertia) {
  std::size_t k = 0;
  while (result.lag.at(k) < coverage.lag - 1e-9) ++k;
  const DisplacementGroup& all = result.groups[0];
  const double msd = std::abs(all.translation.value[k] - free_msd(result.lag[k]));
  const double msr = std::abs(all.rotation.value[k] - free_msr(result.lag[k], inertia));
  coverage.blocked = all.translation.blocks[k] > 0;
  coverage.msd_one += msd < all.translation.error[k];
  coverage.msd_two += msd < 2 * all.translation.error[k];
  coverage.msr_one += msr < all.rotation.error[k];
  coverage.msr_two += msr < 2 * all.rotation.error[k];
}

// 100 runs; the counts stay within 3 binomial standard deviations (4.65 for one error, 2.2 for two)
// of 68.27 and 95: false-alarm rate 0.3 % each. Short lags have errors by blocking, long ones by
// particles.
TEST(Displacement, ErrorBarsCoverTheClosedForm) {
  Coverage lags[] = {{0.1}, {0.5}, {1}, {5}, {20}};
  const Configuration2 start = ellipses(40);
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    MemoryTrajectory trajectory = free_brownian(start, 501, 100 + seed);
    const Displacements result = displacements(trajectory);
    for (Coverage& lag : lags) count(lag, result, start.inertia(0));
  }
  EXPECT_TRUE(lags[0].blocked);
  EXPECT_FALSE(lags[4].blocked);
  for (const Coverage& lag : lags) {
    EXPECT_NEAR(lag.msd_one, 68.27, 3 * 4.65) << lag.lag;
    EXPECT_NEAR(lag.msr_one, 68.27, 3 * 4.65) << lag.lag;
    EXPECT_NEAR(lag.msd_two, 95, 3 * 2.2) << lag.lag;
    EXPECT_NEAR(lag.msr_two, 95, 3 * 2.2) << lag.lag;
  }
}

// r = v t and θ = ω t: every origin gives the same square, through any number of box crossings.
TEST(Displacement, BallisticMotionIsExactAndWrappingImmaterial) {
  Configuration2 configuration = ellipses(3);
  configuration.velocity = {Vec2(1, 2), Vec2(-3, 0.5), Vec2(0, 0)};
  configuration.angular_velocity = {2, -7, 0.5};
  std::vector<Configuration2> frames;
  for (int k = 0; k <= 60; ++k, fly(configuration, 0.25)) frames.push_back(configuration);
  ASSERT_NE(frames.back().image[1], Shift<2>(Shift<2>::Zero()));
  MemoryTrajectory trajectory(std::move(frames));
  const Displacements result = displacements(trajectory);
  ASSERT_EQ(result.lag.size(), 30u);
  const double v2 = (5 + 9.25) / 3, w2 = (4 + 49 + 0.25) / 3;
  for (std::size_t k = 0; k < result.lag.size(); ++k) {
    const double t = result.lag[k];
    EXPECT_DOUBLE_EQ(t, 0.25 * static_cast<double>(k + 1));
    EXPECT_EQ(result.origins[k], 60 - k);
    EXPECT_NEAR(result.groups[0].translation.value[k], v2 * t * t, 1e-12 * v2 * t * t);
    EXPECT_NEAR(result.groups[0].rotation.value[k], w2 * t * t, 1e-12 * w2 * t * t);
  }
}

TEST(Displacement, LogarithmicTimesUseTheFirstFrameAsTheOnlyOrigin) {
  Configuration2 configuration = ellipses(4);
  for (int i = 0; i < 4; ++i) configuration.velocity[i] = Vec2(1 + i, 0);
  std::vector<Configuration2> frames{configuration};
  for (double t = 0.125; t < 10; t *= 2) {
    fly(configuration, t - configuration.time);
    frames.push_back(configuration);
  }
  MemoryTrajectory trajectory(std::move(frames));
  const Displacements result = displacements(trajectory);
  ASSERT_EQ(result.lag.size(), 7u);
  // Squares t² {1, 4, 9, 16}: mean 7.5 t², variance 43 t⁴, and four particles behind the error.
  for (std::size_t k = 0; k < 7; ++k) {
    const double t = result.lag[k];
    EXPECT_DOUBLE_EQ(t, 0.125 * std::pow(2, k));
    EXPECT_EQ(result.origins[k], 1u);
    EXPECT_NEAR(result.groups[0].translation.value[k], 7.5 * t * t, 1e-12 * t * t);
    EXPECT_NEAR(result.groups[0].translation.error[k], std::sqrt(43.0 / 4) * 1.1967592 * t * t,
                1e-6 * t * t);
  }
}

Configuration2 mixture_of_ellipses_and_disks() {
  Configuration2 configuration = ellipses(3);
  configuration.species_names = {"ellipse", "disk", "absent"};
  configuration.shape[2] = {1.4, 1.4};
  configuration.species = {0, 0, 1};
  configuration.velocity = {Vec2(1, 0), Vec2(2, 0), Vec2(3, 0)};
  configuration.angular_velocity = {1, 2, 100};
  return configuration;
}

TEST(Displacement, SpeciesApartAndRoundParticlesDoNotTurn) {
  Configuration2 configuration = mixture_of_ellipses_and_disks();
  std::vector<Configuration2> frames;
  for (int k = 0; k <= 4; ++k, fly(configuration, 1)) frames.push_back(configuration);
  MemoryTrajectory trajectory(std::move(frames));
  const Displacements result = displacements(trajectory);
  ASSERT_EQ(result.groups.size(), 3u);
  EXPECT_EQ(result.groups[0].name, "all");
  EXPECT_EQ(result.groups[1].name, "ellipse");
  EXPECT_EQ(result.groups[2].name, "disk");
  EXPECT_NEAR(result.groups[0].translation.value[0], 14.0 / 3, 1e-13);
  EXPECT_NEAR(result.groups[1].translation.value[0], 2.5, 1e-13);
  EXPECT_NEAR(result.groups[2].translation.value[0], 9, 1e-13);
  EXPECT_NEAR(result.groups[0].rotation.value[0], 2.5, 1e-13);
  EXPECT_NEAR(result.groups[1].rotation.value[0], 2.5, 1e-13);
  EXPECT_EQ(result.groups[0].rotors, 2u);
  EXPECT_TRUE(result.groups[2].rotation.value.empty());
}

TEST(Displacement, ResultDoesNotDependOnTheMemoryGranted) {
  MemoryTrajectory trajectory = free_brownian(ellipses(7), 60, 3);
  const Displacements whole = displacements(trajectory);
  const Displacements single = displacements(trajectory, {.memory = 1});
  EXPECT_EQ(whole.groups[0].translation.value, single.groups[0].translation.value);
  EXPECT_EQ(whole.groups[0].translation.error, single.groups[0].translation.error);
  EXPECT_EQ(whole.groups[0].rotation.value, single.groups[0].rotation.value);
}

TEST(Displacement, OriginsAreThinnedEvenlyAndLongLagsLogarithmically) {
  MemoryTrajectory trajectory = free_brownian(ellipses(1), 2001, 4);
  const Displacements result = displacements(
      trajectory, {.axis = {.every_lag_up_to = 10, .lags_per_decade = 5, .most_origins = 100}});
  for (const std::size_t origins : result.origins) {
    EXPECT_LE(origins, 100u);
    EXPECT_GE(origins, 50u);
  }
  // 10 single steps, then two decades (10 … 1000) of five, the last one met up to rounding.
  EXPECT_GE(result.lag.size(), 19u);
  EXPECT_LE(result.lag.size(), 20u);
}

TEST(Displacement, OneFrameIsTheUsersMistake) {
  MemoryTrajectory trajectory({ellipses(1)});
  EXPECT_THROW(displacements(trajectory), UserError);
}

/// A mean square m(t) with small relative errors.
MeanSquare square(const std::vector<double>& lag, double (*m)(double), double error = 0.01) {
  MeanSquare result;
  for (const double t : lag) {
    result.value.push_back(m(t));
    result.error.push_back(error * m(t));
  }
  return result;
}

std::vector<double> lags_up_to(int last) {
  std::vector<double> lag;
  for (int k = 1; k <= last; ++k) lag.push_back(k);
  return lag;
}

TEST(LongTimeDiffusion, IsGivenOnlyWhereMotionIsDiffusive) {
  const std::vector<double> lag = lags_up_to(90);
  // Langevin: 4 D (t − τ(1 − e^{−t/τ})) with D = 0.5, τ = 2; the offset drops out.
  const Diffusion d = long_time_diffusion(
      lag, square(lag, [](double t) { return 2 * (t - 2 * (1 - std::exp(-t / 2))); }), 2);
  EXPECT_NEAR(d.value, 0.5, 0.01);
  // Errors 0.01·2·88 and 0.01·2·28, over 4·60.
  EXPECT_NEAR(d.error, 0.01 * 2 * std::hypot(88, 28) / 240, 1e-4);
  // m' = 2 − 1/√t: the slopes are 2 − 2 (√a − √b)/(a − b), 5 % apart, and that is the error.
  const Diffusion slow =
      long_time_diffusion(lag,
                          square(
                              lag, [](double t) { return 2 * t - 2 * std::sqrt(t); }, 1e-6),
                          1);
  const auto steepness = [](double from, double to) {
    return 1 - (std::sqrt(to) - std::sqrt(from)) / (to - from);
  };
  EXPECT_NEAR(slow.value, steepness(30, 90), 1e-3);
  EXPECT_NEAR(slow.error, steepness(30, 90) - steepness(10, 30), 1e-3);
  const auto ballistic = square(lag, [](double t) { return t * t; });
  EXPECT_TRUE(std::isnan(long_time_diffusion(lag, ballistic, 2).value));
  const auto caged = square(lag, [](double t) { return 0.01 * t; });
  EXPECT_TRUE(std::isnan(long_time_diffusion(lag, caged, 2).value));
  const std::vector<double> few = lags_up_to(5);
  EXPECT_TRUE(
      std::isnan(long_time_diffusion(few, square(few, [](double t) { return t; }), 1).value));
}

}  // namespace
}  // namespace vitrel

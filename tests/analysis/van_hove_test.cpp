#include "analysis/dynamics/van_hove.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "analysis/structure/pair_correlation.h"
#include "tests/support/coverage.h"
#include "tests/support/frames.h"
#include "tests/support/free_brownian.h"
#include "tests/support/pairs.h"
#include "tests/support/random_gas.h"

namespace vitrel {
namespace {

constexpr double interval = 0.25;

/// n particles at random places with random velocities.
template <int Dim>
Configuration<Dim> ideal_gas(std::size_t n, const Vec<Dim>& lengths, std::uint64_t seed) {
  Stream draw(seed, Purpose::tests);
  return random_gas(n, lengths, draw, [&](Configuration<Dim>& c, std::size_t i) {
    for (double& v : c.velocity[i]) v = draw.normal();
  });
}

template <int Dim>
struct VanHove {
  VanHove(Trajectory<Dim>& trajectory, const PairCorrelationOptions& options,
          int threads = all_cores)
      : lags(few_lags_of_motion(trajectory, {})) {
    const Configuration<Dim> first = trajectory.read(0);
    const auto found = average_two_times<Dim>(
        trajectory, lags, {van_hove_self<Dim>(options), van_hove_distinct(first, lags, options)},
        {}, threads);
    self = found[0];
    distinct = found[1];
  }
  std::vector<Lag> lags;
  TwoTimeAverages self, distinct;
};

template <int Dim>
MemoryTrajectory<Dim> free_flight(const Configuration<Dim>& start, std::size_t frames) {
  return trajectory_of(frames, start, [](Configuration<Dim>& c, std::size_t k) {
    if (k == 0) return;
    c.time += interval;
    for (std::size_t i = 0; i < c.size(); ++i) {
      c.position[i] += interval * c.velocity[i];
      c.box.wrap(c.position[i], c.image[i]);
    }
  });
}

/// The share of normal displacements with variance 1 per axis that are shorter than r.
double share_within(int dimension, double r) {
  if (dimension == 2) return 1 - std::exp(-r * r / 2);
  return std::erf(r / std::sqrt(2)) - std::sqrt(2 / std::numbers::pi) * r * std::exp(-r * r / 2);
}

// The variance of displacements is t² kT/m. All origins see the same displacements, so a bin holds a binomial number
// of n particles; it is compared where 20 are expected, within five standard deviations.
template <int Dim>
void expect_gaussian(const VanHove<Dim>& found, double n, double step) {
  for (std::size_t l = 0; l < found.lags.size(); ++l) {
    double integral = 0;
    for (std::size_t k = 0; k < found.self.x.size(); ++k) {
      const double r = found.self.x[k], value = found.self.at_lag[l].mean[k];
      integral += value * step;
      const double share = share_within(Dim, (r + step / 2) / found.lags[l].time) -
                           share_within(Dim, (r - step / 2) / found.lags[l].time);
      if (n * share < 20) continue;
      EXPECT_NEAR(value, share / step, 5 * std::sqrt(share * (1 - share) / n) / step) << r;
    }
    EXPECT_NEAR(integral, 1, 1e-12);
  }
}

// One origin alone has r_j(t) − r_i(0) of n (n − 1) pairs in a volume, those of (i, j) and (j, i) correlated at the
// most; so the number in a bin varies by no more than twice itself. Five standard deviations.
template <int Dim>
void expect_uniform(const VanHove<Dim>& found, double n, double starts, double density,
                    double step) {
  for (std::size_t l = 0; l < found.lags.size(); ++l)
    for (std::size_t k = 0; k < found.distinct.x.size(); ++k) {
      const double r = found.distinct.x[k];
      const double pairs =
          starts * (n - 1) / n * density * volume_between<Dim>(r - step / 2, r + step / 2);
      EXPECT_NEAR(found.distinct.at_lag[l].mean[k], 1, 5 * std::sqrt(2 / pairs)) << r;
    }
}

/// The distinct part has so many bins of 0.5, up to half the box, and so many particles to start
/// from.
template <int Dim>
void expect_ideal_gas(const Vec<Dim>& lengths, std::uint64_t seed, std::size_t bins,
                      double starts) {
  auto trajectory = free_flight<Dim>(ideal_gas<Dim>(2000, lengths, seed), 41);
  const VanHove<Dim> found(trajectory, {.distance_max = 30, .distance_step = 0.5});
  ASSERT_EQ(found.lags.front().time, interval);
  ASSERT_EQ(found.lags.back().time, 5 * interval);
  expect_gaussian<Dim>(found, 2000, 0.5);
  ASSERT_EQ(found.distinct.x.size(), bins);
  expect_uniform<Dim>(found, 2000, starts, 2000 / lengths.prod(), 0.5);
}

// Within 10 of a particle of the plane are 1257; five lags of about 38 origins need every 29th or
// so to start from.
TEST(VanHove, OfAnIdealGasInFreeFlightIsGaussianAndOne) {
  expect_ideal_gas<2>({20, 25}, 1, 20, 2000 / 31.);
  expect_ideal_gas<3>({9, 10, 11}, 2, 9, 2000 / 20.);
}

/// All pairs, nearest images.
template <int Dim>
std::vector<double> distinct_counts(const Configuration<Dim>& start, const Configuration<Dim>& end,
                                    std::size_t bins, double step) {
  std::vector<double> counts(bins);
  for (std::size_t i = 0; i < start.size(); ++i)
    for (std::size_t j = 0; j < start.size(); ++j) {
      if (i == j) continue;
      const Vec<Dim> d = to_nearest_image<Dim>(start.box, end.position[j] - start.position[i]);
      const auto bin = static_cast<std::size_t>(d.norm() / step);
      if (bin < bins) ++counts[bin];
    }
  return counts;
}

template <int Dim>
void expect_loop_over_pairs(const Vec<Dim>& lengths) {
  auto trajectory = free_flight<Dim>(ideal_gas<Dim>(40, lengths, 3), 3);
  const VanHove<Dim> found(trajectory, {.distance_max = 30, .distance_step = 0.25});
  ASSERT_EQ(found.lags.size(), 1u);
  ASSERT_EQ(found.lags[0].origins, 2u);
  const std::size_t bins = found.distinct.x.size();
  ASSERT_EQ(bins, static_cast<std::size_t>(lengths.minCoeff() / 2 / 0.25));
  const Configuration<Dim> frames[] = {trajectory.read(0), trajectory.read(1), trajectory.read(2)};
  const auto first = distinct_counts(frames[0], frames[1], bins, 0.25);
  const auto second = distinct_counts(frames[1], frames[2], bins, 0.25);
  for (std::size_t k = 0; k < bins; ++k) {
    const double r = 0.25 * static_cast<double>(k);
    const double expected = 40 * 39 * volume_between<Dim>(r, r + 0.25) / lengths.prod();
    EXPECT_NEAR(found.distinct.at_lag[0].mean[k], (first[k] + second[k]) / 2 / expected, 1e-12)
        << r;
  }
}

TEST(VanHove, DistinctPartIsThatOfALoopOverAllPairs) {
  expect_loop_over_pairs<2>({8, 30});
  expect_loop_over_pairs<2>({11, 11});
  expect_loop_over_pairs<3>({6, 7, 13});
}

// G_d(r, t → 0) = g(r), and nothing leaves the first bin of G_s.
template <int Dim>
void expect_pair_correlation(const Vec<Dim>& lengths) {
  Configuration<Dim> frozen = ideal_gas<Dim>(60, lengths, 4);
  for (Vec<Dim>& v : frozen.velocity) v.setZero();
  auto trajectory = free_flight<Dim>(frozen, 9);
  const PairCorrelationOptions options{.distance_max = 4, .distance_step = 0.5};
  const VanHove<Dim> found(trajectory, options);
  const PairCorrelation pairs = pair_correlation(frozen, options);
  ASSERT_EQ(found.distinct.x, pairs.distance);
  for (const Averages& distinct : found.distinct.at_lag)
    for (std::size_t k = 0; k < pairs.g.size(); ++k)
      EXPECT_NEAR(distinct.mean[k], pairs.g[k], 1e-12);
  for (const Averages& self : found.self.at_lag)
    for (std::size_t k = 0; k < 8; ++k) EXPECT_EQ(self.mean[k], k == 0 ? 1 / 0.5 : 0);
}

TEST(VanHove, OfFrozenParticlesIsThePairCorrelation) {
  expect_pair_correlation<2>({13, 14});
  expect_pair_correlation<3>({9, 8.5, 10});
}

// 100 runs; counts within 3.5 binomial standard deviations (4.65), false-alarm rate 0.05 % each. Displacements of
// Brownian particles are normal with variance free_msd/2 per axis; the middle bins of three lags are compared.
TEST(VanHove, ErrorBarsCoverTheTruth) {
  Coverage coverage[3];
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    MemoryTrajectory2 trajectory = free_brownian(ellipses(50), 1001, 700 + seed);
    const VanHove<2> found(trajectory, {.distance_max = 20, .distance_step = 0.1});
    for (const std::size_t l : {0, 1, 2}) {
      const double deviation = std::sqrt(free_msd(found.lags[l].time) / 2);
      const auto k = static_cast<std::size_t>(deviation / 0.1);
      const double r = 0.1 * static_cast<double>(k);
      const double truth =
          (share_within(2, (r + 0.1) / deviation) - share_within(2, r / deviation)) / 0.1;
      const Averages& self = found.self.at_lag[l];
      coverage[l].count(self.mean[k] - truth, self.error[k]);
    }
  }
  for (const Coverage& lag : coverage) expect_binomial(lag.one, 100, 0.6827, 3.5);
}

TEST(VanHove, UnevenTimesHaveNoErrorsAndThreadsDoNotMatter) {
  auto even = free_flight<2>(ideal_gas<2>(30, {9, 9}, 5), 9);
  auto uneven = chosen_frames<2>(even, {0, 1, 2, 4, 8});
  const VanHove<2> one(uneven, {}, 1), many(uneven, {}, 4);
  ASSERT_EQ(one.lags.size(), 4u);
  for (std::size_t l = 0; l < 4; ++l) {
    EXPECT_EQ(one.lags[l].origins, l < 3 ? 2u : 1u);
    EXPECT_EQ(one.self.at_lag[l].mean, many.self.at_lag[l].mean);
    EXPECT_EQ(one.distinct.at_lag[l].mean, many.distinct.at_lag[l].mean);
    for (const double error : one.self.at_lag[l].error) EXPECT_TRUE(std::isnan(error));
  }
}

}  // namespace
}  // namespace vitrel

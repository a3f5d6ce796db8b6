#include "analysis/statistics/blocking.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/random/stream.h"
#include "tests/support/coverage.h"
#include "tests/support/series.h"

namespace vitrel {
namespace {

std::vector<double> series_of(std::size_t n, double c, std::uint64_t seed) {
  Stream draw(seed, Purpose::tests);
  return autoregressive_series(n, c, draw);
}

/// Exact standard error of the mean of n such values:
/// σ²/n (1 + 2 Σ_{k=1}^{n−1} (1 − k/n) c^k).
double autoregressive_error(std::size_t n, double c) {
  double sum = 1;
  for (std::size_t k = 1; k < n; ++k)
    sum += 2 * (1 - static_cast<double>(k) / static_cast<double>(n)) *
           std::pow(c, static_cast<double>(k));
  return std::sqrt(sum / static_cast<double>(n));
}

// One error covers 68.27 % by construction (Student's factor); two cover 95.4 % of a normal
// variable and 94.3 % with the fewest blocks met here (15). Three standard deviations: false-alarm
// rate 0.3 %.
TEST(Blocking, ErrorsCoverTheTrueMean) {
  for (const double c : {0.0, 0.5, 0.9}) {
    SCOPED_TRACE(c);
    Coverage coverage;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      const Estimate estimate = block_average(series_of(4096, c, seed));
      coverage.count(estimate.mean, estimate.error);
    }
    EXPECT_EQ(coverage.known, 100);
    expect_binomial(coverage.one, 100, 0.6827, 3);
    expect_binomial(coverage.two, 100, 0.95, 3);
  }
}

// The error itself, averaged over the seeds, equals the exact one: its bias from the finite block
// length is at most correlation time over block length, here 7 %, and its scatter over 400 seeds is
// below 1 %.
TEST(Blocking, MeanErrorIsTheExactOne) {
  for (const double c : {0.0, 0.9}) {
    double sum = 0;
    const int seeds = 400;
    for (int seed = 0; seed < seeds; ++seed) {
      const Estimate estimate = block_average(series_of(4096, c, 1000 + seed));
      sum += estimate.error / student_factor(estimate.blocks - 1);
    }
    EXPECT_NEAR(sum / seeds / autoregressive_error(4096, c), 1, 0.07) << "c = " << c;
  }
}

TEST(Blocking, NoErrorForSeriesTooShortToTell) {
  EXPECT_TRUE(std::isnan(block_average({}).mean));
  for (const std::size_t n : {1u, 2u, 7u, 31u}) {
    const Estimate estimate = block_average(series_of(n, 0, 5));
    EXPECT_TRUE(std::isfinite(estimate.mean));
    EXPECT_TRUE(std::isnan(estimate.error)) << n;
    EXPECT_EQ(estimate.blocks, 0u);
  }
  // Two correlation times long: no blocking can know the error, whatever the number of values.
  EXPECT_TRUE(std::isnan(block_average(series_of(1000, 0.996, 5)).error));
}

TEST(Blocking, ConstantSeriesHasErrorZero) {
  const Estimate estimate = block_average(std::vector<double>(50, 1.5));
  EXPECT_EQ(estimate.mean, 1.5);
  EXPECT_EQ(estimate.error, 0);
}

/// Eight blocks of four values with the means 0 … 7: their variance is 6, the error of the mean
/// √(6/8).
std::vector<double> eight_blocks(const std::vector<double>& offsets) {
  std::vector<double> series;
  for (int block = 0; block < 8; ++block)
    for (const double offset : offsets) series.push_back(block + offset);
  return series;
}

void expect_eight_blocks(const Estimate& estimate, double mean) {
  EXPECT_EQ(estimate.blocks, 8u);
  EXPECT_DOUBLE_EQ(estimate.mean, mean);
  EXPECT_NEAR(estimate.error, std::sqrt(0.75) * student_factor(7), 1e-14);
}

// 32 independent values: blocks of 4 are the first to pass B³ ≥ 2 n, and 8 of them are left. With
// known blocks and a rest of 2, the error is the same, the mean that of all 34 values.
TEST(Blocking, ErrorOfAShortSeriesByHand) {
  expect_eight_blocks(block_average(eight_blocks({-10, 10, -10, 10})), 3.5);
  std::vector<double> series = eight_blocks({-9, -1, 1, 9});
  series.insert(series.end(), {20.5, 20.5});
  expect_eight_blocks(known_block_average(series, 4), (112 + 41) / 34.0);
  EXPECT_TRUE(std::isnan(known_block_average(series, 5).error));
  EXPECT_EQ(known_block_average(series, 5).blocks, 0u);
}

// Thirty correlation times: too few for a plateau, and fifteen blocks of twice the time, which is measured
// in the series itself: that makes errors a little small, and they cover the truth in 64 % of the runs
// instead of 68 (measured, and three standard deviations about it).
TEST(Blocking, SlowSeriesNeedNoPlateau) {
  Coverage coverage;
  int without_plateau = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const std::vector<double> series = series_of(600, 0.951, 2000 + seed);
    without_plateau += std::isnan(block_average(series).error);
    const Estimate estimate = slow_average(series);
    coverage.count(estimate.mean, estimate.error);
  }
  EXPECT_GE(without_plateau, 270);
  EXPECT_GE(coverage.known, 250);
  expect_binomial(coverage.one, coverage.known, 0.64, 3);
}

// c^k = 1/e at k = 1/ln(1/c).
TEST(Blocking, CorrelationSteps) {
  EXPECT_NEAR(correlation_steps(series_of(100000, 0.9, 1)), 1 / -std::log(0.9), 1);
  EXPECT_EQ(correlation_steps(std::vector<double>(10, 1.5)), 0u);
}

// Quantiles of Student's distribution at the probability 0.8413447 of one standard deviation, from
// its cumulative distribution in closed form: ν = 3 by root finding, 15 from the incomplete beta
// function.
TEST(Blocking, StudentFactor) {
  EXPECT_NEAR(student_factor(3), 1.1968813532652132, 2e-4);
  EXPECT_NEAR(student_factor(7), 1.0767133754161282, 1e-6);
  EXPECT_NEAR(student_factor(15), 1.034462913051221, 1e-7);
}

TEST(IndependentAverage, ByHand) {
  const ValueSums four{4, 1 + 2 + 3 + 6, 1 + 4 + 9 + 36}, one{1, 2, 4};
  const Estimate estimate = independent_average({&four, 1});
  EXPECT_DOUBLE_EQ(estimate.mean, 3);
  EXPECT_NEAR(estimate.error, std::sqrt(14.0 / 3 / 4) * student_factor(3), 1e-15);
  EXPECT_TRUE(std::isnan(independent_average({&one, 1}).error));
}

// The classes are 1 and 3, and 11 and 13: within each the variance is 2.
TEST(IndependentAverage, OfClassesHasNoDifferencesBetweenThem) {
  std::vector<ValueSums> classes(3);
  for (const double value : {1, 3}) classes[0].add(value);
  for (const double value : {11, 13}) classes[2].add(value);
  const Estimate estimate = independent_average(classes);
  EXPECT_DOUBLE_EQ(estimate.mean, 7);
  EXPECT_NEAR(estimate.error, std::sqrt(2.0 / 4) * student_factor(2), 1e-15);
  classes[2] = {};
  classes[1].add(12);
  EXPECT_DOUBLE_EQ(independent_average(classes).error, std::sqrt(2.0 / 3) * student_factor(1));
  EXPECT_TRUE(std::isnan(independent_average(std::span(classes).subspan(1)).error));
}

// Student's 97.5 % quantile is 2.2622 for 9 degrees of freedom, 12.706 for one (tables).
TEST(MeanOfRuns, ByHand) {
  const std::vector<double> two = {1, 3};
  EXPECT_DOUBLE_EQ(mean_of_runs(two).mean, 2);
  EXPECT_NEAR(mean_of_runs(two).half_width(0.95), 12.706, 1e-3);
  const std::vector<double> ten = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  EXPECT_NEAR(mean_of_runs(ten).half_width(0.95), 2.26216 * std::sqrt(55.0 / 6 / 10), 1e-5);
  EXPECT_TRUE(std::isnan(mean_of_runs(std::vector<double>{1}).half_width(0.95)));
}

// 4000 samples of five: the share covered is 0.95 with a standard error of 0.0034; four of them.
TEST(MeanOfRuns, CoversTheTruthAsOftenAsItSays) {
  Stream draw(4, Purpose::tests);
  int covered = 0;
  for (int sample = 0; sample < 4000; ++sample) {
    std::vector<double> values(5);
    for (double& value : values) value = 3 + 2 * draw.normal();
    const MeanOfRuns mean = mean_of_runs(values);
    covered += std::abs(mean.mean - 3) < mean.half_width(0.95);
  }
  EXPECT_NEAR(covered / 4000.0, 0.95, 4 * 0.0034);
}

// Two values 6 apart have s² = 18; with errors of 5 the variance is (18 + 20 · 25)/21.
TEST(MeanOfRuns, ErrorsAndScatterBothCount) {
  const std::vector<double> values = {29, 35}, errors = {5, 5};
  const MeanOfRuns mean = mean_of_runs(values, errors);
  EXPECT_EQ(mean.mean, 32);
  EXPECT_DOUBLE_EQ(mean.scatter, std::sqrt(18.0 / 25));
  EXPECT_FALSE(mean.is_excessive);
  EXPECT_DOUBLE_EQ(mean.squared_error, 518.0 / 21 / 2);
  EXPECT_EQ(mean.degrees_of_freedom, 21);
  const std::vector<double> one_unknown = {5, std::nan("")};
  EXPECT_EQ(mean_of_runs(values, one_unknown).squared_error, 9);
  EXPECT_TRUE(std::isnan(mean_of_runs(values, one_unknown).scatter));
}

// The upper 1 % point of F for 1 and 20 degrees of freedom is 8.0960 (tables).
TEST(MeanOfRuns, SaysThatTheScatterIsExcessive) {
  const std::vector<double> errors = {1, 1};
  const double limit = std::sqrt(2 * 8.0960);
  EXPECT_FALSE(mean_of_runs(std::vector{0.0, 0.999 * limit}, errors).is_excessive);
  const MeanOfRuns mean = mean_of_runs(std::vector{0.0, 1.001 * limit}, errors);
  EXPECT_TRUE(mean.is_excessive);
  EXPECT_EQ(mean.degrees_of_freedom, 1);
  EXPECT_DOUBLE_EQ(mean.half_width(0.95),
                   mean_of_runs(std::vector{0.0, 1.001 * limit}).half_width(0.95));
}

/// 4000 times the mean of two runs, with errors from ten blocks each; the values have this variance beside that of the
/// blocks, of which the errors do not know. The share of intervals that cover.
double coverage_of_two(double beside) {
  Stream draw(5, Purpose::tests);
  int covered = 0;
  for (int sample = 0; sample < 4000; ++sample) {
    std::vector<double> values, errors;
    for (int run = 0; run < 2; ++run) {
      ValueSums blocks;
      for (int b = 0; b < 10; ++b) blocks.add(draw.normal());
      const Estimate estimate = independent_average({&blocks, 1});
      values.push_back(estimate.mean + std::sqrt(beside) * draw.normal());
      errors.push_back(estimate.error);
    }
    const MeanOfRuns mean = mean_of_runs(values, errors);
    covered += std::abs(mean.mean) < mean.half_width(0.6827);
  }
  return covered / 4000.0;
}

// Binomial error 0.0074, four of them. Student's factors are in the errors already, which makes the intervals of honest
// errors 5 % wider: 0.70 instead of 0.683. With ten times the scatter that errors know, two values that happen to agree
// are believed to: 0.65 (measured).
TEST(MeanOfRuns, OfTwoCoversTheTruth) {
  EXPECT_NEAR(coverage_of_two(0), 0.70, 0.03);
  EXPECT_NEAR(coverage_of_two(10), 0.65, 0.03);
}

}  // namespace
}  // namespace vitrel

#include "analysis/dynamics/relaxation.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "analysis/statistics/blocking.h"
#include "core/error.h"
#include "core/random/stream.h"
#include "core/special_values.h"
#include "tests/support/coverage.h"

namespace vitrel {
namespace {

using std::numbers::e;
using testing::HasSubstr;

std::vector<double> logarithmic_times(double from, double to, int per_decade) {
  const auto at = [&](int k) { return from * std::pow(10, static_cast<double>(k) / per_decade); };
  std::vector<double> time;
  for (int k = 0; at(k) <= to; ++k) time.push_back(at(k));
  return time;
}

template <class C>
Decay decay(const std::vector<double>& time, double error, C&& c) {
  Decay result;
  for (const double t : time) {
    result.time.push_back(t);
    result.value.push_back(c(t));
    result.error.push_back(error);
  }
  return result;
}

// The line is wrong by less than 0.2 % (the header); d ln t/dC at 1/e is e/β.
TEST(RelaxationTime, OfStretchedExponentials) {
  for (const double beta : {0.4, 0.7, 1.0}) {
    for (const int per_decade : {8, 20, 100}) {
      const RelaxationTime tau =
          relaxation_time(decay(logarithmic_times(0.013, 1e4, per_decade), 0.01,
                                [&](double t) { return std::exp(-std::pow(t / 17, beta)); }));
      EXPECT_NEAR(tau.value, 17, 0.002 * 17) << beta << ' ' << per_decade;
      EXPECT_NEAR(tau.error, 0.01 * 17 * e / beta, 0.02 * tau.error);
      EXPECT_EQ(tau.reason, "");
    }
  }
}

// Two points, linear in ln t: from 0.5 at t = 1 to 0.25 at t = 4.
TEST(RelaxationTime, BetweenTwoPointsIsInterpolatedInLogarithmicTime) {
  const RelaxationTime tau = relaxation_time({{1, 4}, {0.5, 0.25}, {0.01, 0.03}});
  const double slope = -0.25 / std::log(4);
  EXPECT_NEAR(tau.value, std::exp((1 / e - 0.5) / slope), 1e-12);
  const double error = 0.01 + 0.02 * std::log(tau.value) / std::log(4);
  EXPECT_NEAR(tau.error, tau.value * error / -slope, 1e-12);
}

/// ⟨cos Δθ⟩ of n independent Brownian rotors from one origin, D_r = 1/20: exp(−t/20).
Decay rotors(int n, std::uint64_t seed) {
  Stream draw(seed, Purpose::tests);
  const int frames = 80;
  std::vector<ValueSums> sums(frames);
  for (int i = 0; i < n; ++i) {
    double angle = 0;
    for (int k = 0; k < frames; ++k) {
      angle += std::sqrt(0.1) * draw.normal();
      sums[k].add(std::cos(angle));
    }
  }
  Decay result;
  for (int k = 0; k < frames; ++k) {
    const Estimate estimate = independent_average({&sums[k], 1});
    result.time.push_back(k + 1);
    result.value.push_back(estimate.mean);
    result.error.push_back(estimate.error);
  }
  return result;
}

// A count within 3 binomial standard deviations of 68.27 and 95.4: false-alarm rate 0.3 % each.
TEST(RelaxationTime, ErrorsCoverTheTruth) {
  Coverage coverage;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const RelaxationTime tau = relaxation_time(rotors(400, seed));
    coverage.count(tau.value - 20, tau.error);
  }
  expect_binomial(coverage.one, 100, 0.6827, 3);
  expect_binomial(coverage.two, 100, 0.954, 3);
}

TEST(RelaxationTime, WithoutOneTheReasonIsGiven) {
  const auto exponential = [](double t) { return std::exp(-t / 100); };
  const RelaxationTime late = relaxation_time(decay({1, 10, 90}, 0.01, exponential));
  EXPECT_TRUE(std::isnan(late.value) && std::isnan(late.error));
  EXPECT_EQ(late.least, 90);
  EXPECT_TRUE(std::isnan(late.most));
  EXPECT_THAT(late.reason, HasSubstr("still 0.41"));
  const RelaxationTime early = relaxation_time(decay({110, 200}, 0.01, exponential));
  EXPECT_TRUE(std::isnan(early.value) && std::isnan(early.least));
  EXPECT_EQ(early.most, 110);
  EXPECT_THAT(early.reason, HasSubstr("sample more often"));
  const RelaxationTime back = relaxation_time({{1, 2, 4}, {0.5, 0.3, 0.6}, {0.01, 0.01, 0.01}});
  EXPECT_TRUE(std::isnan(back.value));
  EXPECT_THAT(back.reason, HasSubstr("returns"));
}

TEST(RelaxationTime, UnknownErrorsOfTheCurveGiveNoError) {
  const RelaxationTime tau = relaxation_time({{1, 4}, {0.5, 0.25}, {unknown, unknown}});
  EXPECT_GT(tau.value, 1);
  EXPECT_TRUE(std::isnan(tau.error));
}

TEST(RelaxationTime, ColumnsThatDoNotFitAreRefused) {
  EXPECT_THROW(relaxation_time({}), UserError);
  EXPECT_THROW(relaxation_time({{1, 2}, {1}, {1, 1}}), UserError);
  EXPECT_THROW(relaxation_time({{2, 1}, {1, 0}, {0, 0}}), UserError);
  EXPECT_THROW(relaxation_time({{0, 1}, {1, 0}, {0, 0}}), UserError);
}

// L₂ of rotors that turn about a fixed director decays to a plateau P; without it the exponential is
// back. Its error is worth (1 − C)/(1 − P) of that of the curve: 1 − 1/e where C is 1/e.
TEST(ConnectedPart, TakesOffThePlateauOfANematic) {
  const double p = 0.64;
  const Decay whole = decay(logarithmic_times(0.1, 1e3, 20), 0.01,
                            [&](double t) { return p + (1 - p) * std::exp(-t / 7); });
  EXPECT_TRUE(std::isnan(relaxation_time(whole).value));
  const RelaxationTime tau = relaxation_time(connected_part(whole, {p, 0, 0}));
  EXPECT_NEAR(tau.value, 7, 0.002 * 7);
  EXPECT_NEAR(tau.error, 0.01 / 0.36 * 7 * e, 0.02 * tau.error);
  const RelaxationTime unsure = relaxation_time(connected_part(whole, {p, 0.02, 8}));
  EXPECT_EQ(unsure.value, tau.value);
  const double of_plateau = 0.02 * (1 - 1 / e);
  EXPECT_NEAR(unsure.error, std::hypot(0.01, of_plateau) / 0.36 * 7 * e, 0.02 * unsure.error);
}

}  // namespace
}  // namespace vitrel

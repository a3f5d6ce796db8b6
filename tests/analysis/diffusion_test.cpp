#include "analysis/dynamics/diffusion.h"

#include <gmock/gmock.h>

#include <cmath>

#include "analysis/statistics/blocking.h"
#include "core/error.h"
#include "core/random/stream.h"
#include "tests/support/coverage.h"

namespace vitrel {
namespace {

std::vector<double> geometric_lags(std::size_t longest) {
  std::vector<double> lag;
  double next = 1;
  while (next <= static_cast<double>(longest)) {
    lag.push_back(std::floor(next));
    next = std::max(1.12 * next, std::floor(next) + 1);
  }
  return lag;
}

/// Particles on a line that diffuse with D and rattle in a cage that they carry along: an
/// Ornstein–Uhlenbeck process of variance `cage` and correlation time 5 is added, which is forgotten
/// long before the longest lags.
std::vector<double> walk(std::size_t frames, double diffusion, double cage, Stream& draw) {
  const double c = std::exp(-1.0 / 5);
  std::vector<double> path(frames);
  double x = 0, rattle = std::sqrt(cage) * draw.normal();
  for (double& value : path) {
    value = x + rattle;
    x += std::sqrt(2 * diffusion) * draw.normal();
    rattle = c * rattle + std::sqrt(cage * (1 - c * c)) * draw.normal();
  }
  return path;
}

/// The mean square of independent walkers, its errors from their spread; all frames are origins, or
/// the first one only.
MeanSquareCurve walkers(std::size_t n, std::size_t frames, double cage, bool single_origin,
                        std::uint64_t seed) {
  Stream draw(seed, Purpose::tests);
  MeanSquareCurve curve;
  curve.time = geometric_lags(single_origin ? frames - 1 : frames / 2);
  curve.duration = single_origin ? 0 : static_cast<double>(frames - 1);
  std::vector<ValueSums> sums(curve.time.size());
  for (std::size_t i = 0; i < n; ++i) {
    const std::vector<double> path = walk(frames, 0.5, cage, draw);
    for (std::size_t k = 0; k < curve.time.size(); ++k) {
      const auto lag = static_cast<std::size_t>(curve.time[k]);
      const std::size_t origins = single_origin ? 1 : frames - lag;
      double mean = 0;
      for (std::size_t a = 0; a < origins; ++a)
        mean += (path[a + lag] - path[a]) * (path[a + lag] - path[a]);
      mean /= static_cast<double>(origins);
      sums[k].add(mean);
    }
  }
  for (std::size_t k = 0; k < curve.time.size(); ++k) {
    const Estimate estimate = independent_average({&sums[k], 1});
    curve.value.push_back(estimate.mean);
    curve.error.push_back(estimate.error);
  }
  return curve;
}

struct Walk {
  const char* name;
  double cage;
  bool single_origin;
};

// 400 runs; a count within 3 binomial standard deviations of 68.27 and 95.4 %, false-alarm rate
// 0.3 % each. The points of one curve are as strongly correlated as those of a run.
TEST(DiffusionCoefficient, ErrorsCoverTheTruth) {
  for (const auto& [name, cage, single_origin] : {Walk{"free", 0, false},
                                                  {"caged", 20, false},
                                                  {"free, one origin", 0, true},
                                                  {"caged, one origin", 20, true}}) {
    SCOPED_TRACE(name);
    Coverage coverage;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
      const auto curve = walkers(200, 401, cage, single_origin, 500 + seed);
      const DiffusionCoefficient d = diffusion_coefficient(curve, 1);
      coverage.count(d.value - 0.5, d.error);
    }
    EXPECT_LE(coverage.unknown, 8);
    EXPECT_NEAR(coverage.one, 273, 3 * 9.3);
    EXPECT_NEAR(coverage.two, 381.8, 3 * 4.2);
  }
}

/// A mean square m(t) at t = 1 … last with relative errors, all frames of a run of twice that length
/// being origins.
template <class M>
MeanSquareCurve curve_of(int last, double relative_error, M&& m) {
  MeanSquareCurve curve;
  for (int t = 1; t <= last; ++t) {
    curve.time.push_back(t);
    curve.value.push_back(m(static_cast<double>(t)));
    curve.error.push_back(relative_error * m(static_cast<double>(t)));
  }
  curve.duration = 2 * last;
  return curve;
}

// m = 4 D (t − τ(1 − e^{−t/τ})) + c with D = 0.5, τ = 2: constants drop out. It is above 1 from the first time on, and,
// known to 1e-4, straight neither from 90/27 nor from 10 on.
TEST(DiffusionCoefficient, IgnoresShortTimesAndSaysWhereItLooked) {
  const DiffusionCoefficient d = diffusion_coefficient(
      curve_of(90, 1e-4, [](double t) { return 2 * (t - 2 * (1 - std::exp(-t / 2))) + 3; }), 2);
  EXPECT_NEAR(d.value, 0.5, 1e-3);
  EXPECT_EQ(d.from, 30);
  EXPECT_EQ(d.to, 90);
  EXPECT_EQ(d.reason, "");
}

// m = 2t − 2√t: between a and b the slope is 2 − 2 (√b − √a)/(b − a), below 2 by 0.24 … 0.45 in
// [10, 30] and 0.21 … 0.37 in [30, 90], at the ends of these. The change, known to 1e-6, is the error.
TEST(DiffusionCoefficient, SlowChangeOfTheSlopeIsTheError) {
  const DiffusionCoefficient d = diffusion_coefficient(
      curve_of(90, 1e-6, [](double t) { return 2 * t - 2 * std::sqrt(t); }), 1);
  const auto slope = [](double from, double to) {
    return 1 - (std::sqrt(to) - std::sqrt(from)) / (to - from);
  };
  EXPECT_GT(d.value, slope(30, 31));
  EXPECT_LT(d.value, slope(89, 90));
  EXPECT_NEAR(d.error, slope(30, 90) - slope(10, 30), 0.01);
  EXPECT_EQ(d.from, 30);
}

// Straight from the start: the window begins at T/27, at m = 1 or at T/3, whatever chance does to the points.
TEST(DiffusionCoefficient, TheWindowBeginsWhereParticlesHaveMovedByOne) {
  const auto from = [](double last) {
    return diffusion_coefficient(curve_of(81, 0.1, [&](double t) { return last * t / 81; }), 1)
        .from;
  };
  EXPECT_EQ(from(100), 3);
  EXPECT_EQ(from(9), 9);
  EXPECT_EQ(from(2), 27);
}

// Four points a decade: two on each side of the middle take a factor of nine, though m = 1 is later.
TEST(DiffusionCoefficient, SparseTimesTakeALongerWindow) {
  MeanSquareCurve curve;
  for (int k = 0; k <= 8; ++k) {
    curve.time.push_back(std::pow(10, k / 4.0));
    curve.value.push_back(0.02 * curve.time.back());
    curve.error.push_back(0.002 * curve.time.back());
  }
  curve.duration = 200;
  const DiffusionCoefficient d = diffusion_coefficient(curve, 1);
  EXPECT_NEAR(d.value, 0.01, 1e-12);
  EXPECT_EQ(d.from, curve.time[5]);
}

TEST(DiffusionCoefficient, MotionThatIsNotDiffusiveHasNoneAndSaysWhy) {
  using testing::HasSubstr;
  const auto reason = [](const MeanSquareCurve& curve) {
    const DiffusionCoefficient d = diffusion_coefficient(curve, 2);
    EXPECT_TRUE(std::isnan(d.value));
    EXPECT_TRUE(std::isnan(d.error));
    return d.reason;
  };
  const auto power = [](double factor, double exponent) {
    return [=](double t) { return factor * std::pow(t, exponent); };
  };
  EXPECT_THAT(reason(curve_of(90, 0.01, power(1, 2))), HasSubstr("not diffusive"));
  EXPECT_THAT(reason(curve_of(90, 0.01, power(1, 0.6))), HasSubstr("not diffusive"));
  EXPECT_THAT(reason(curve_of(90, 0.01, power(0.01, 1))), HasSubstr("only 0.9"));
  EXPECT_THAT(reason(curve_of(8, 0.01, power(1, 1))), HasSubstr("factor of nine"));
  EXPECT_THAT(reason(curve_of(90, 0, power(1, 1))), HasSubstr("known errors"));
  EXPECT_THAT(reason({}), HasSubstr("known errors"));
}

TEST(DiffusionCoefficient, ColumnsThatDoNotFitAreRefused) {
  EXPECT_THROW(diffusion_coefficient({{1, 2}, {1}, {1}, 0}, 2), UserError);
  EXPECT_THROW(diffusion_coefficient({{2, 1}, {1, 2}, {1, 1}, 0}, 2), UserError);
}

}  // namespace
}  // namespace vitrel

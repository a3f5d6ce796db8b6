#include "analysis/dynamics/equilibration.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "analysis/statistics/blocking.h"
#include "core/random/stream.h"
#include "core/special_values.h"
#include "tests/support/series.h"

namespace vitrel {
namespace {

using testing::HasSubstr;
using enum EquilibrationVerdict;

constexpr std::size_t frames = 4096;

/// Standard error of the mean of n ≫ 1/(1 − c) such values.
double error_of_mean(std::size_t n, double c) {
  return std::sqrt((1 + c) / (1 - c) / static_cast<double>(n));
}

/// ⟨(x(t + lag) − x(t))²⟩ of part of a series.
BlockedCurve mean_square(const std::vector<double>& x, std::size_t begin, std::size_t end) {
  BlockedCurve curve;
  for (std::size_t lag = 1; lag <= 64; lag *= 2) {
    std::vector<double> squares;
    for (std::size_t k = begin; k + lag < end; ++k)
      squares.push_back((x[k + lag] - x[k]) * (x[k + lag] - x[k]));
    const Estimate estimate = block_average(squares, 4.0 * static_cast<double>(lag));
    curve.time.push_back(static_cast<double>(lag));
    curve.value.push_back(estimate.mean);
    curve.error.push_back(estimate.error);
    curve.blocks.push_back(estimate.blocks);
  }
  return curve;
}

HalvesOfCurve halves(const std::vector<double>& x) {
  return {"MSD", mean_square(x, 0, x.size() / 2), mean_square(x, x.size() / 2, x.size())};
}

RelaxationTime known(double tau) {
  return {tau, 0.1 * tau, unknown, unknown, ""};
}

RunEvidence stationary(std::uint64_t seed) {
  Stream draw(seed, Purpose::tests);
  RunEvidence run{4096, {}, {}, {{"tau", known(100)}}};
  for (const double c : {0.0, 0.5, 0.9})
    run.series.push_back({"x", autoregressive_series(frames, c, draw)});
  run.curves.push_back(halves(autoregressive_series(frames, 0.8, draw)));
  return run;
}

/// A drift by this much over the series.
void add_drift(std::vector<double>& series, double change) {
  const auto count = static_cast<double>(series.size());
  for (std::size_t k = 0; k < series.size(); ++k)
    series[k] += change * static_cast<double>(k) / count;
}

/// How many of the runs, one for every seed, are judged how.
template <class RunOf>
std::map<EquilibrationVerdict, int> verdicts(std::uint64_t seeds, RunOf&& run_of) {
  std::map<EquilibrationVerdict, int> counts;
  for (std::uint64_t seed = 0; seed < seeds; ++seed)
    ++counts[judge_equilibration(run_of(seed)).verdict];
  return counts;
}

void expect_too_short(const Equilibration& result, const testing::Matcher<std::string>& reason) {
  EXPECT_EQ(result.verdict, too_short);
  EXPECT_THAT(result.reason, reason);
}

// Stated: at most 1 % of 600 runs, 6 ± 2.4; three standard deviations allow 13.
TEST(Equilibration, StationaryRunsAreHardlyEverCalledAgeing) {
  auto counts = verdicts(600, stationary);
  EXPECT_LE(counts[ageing], 13);
  EXPECT_GE(counts[equilibrated], 580);
}

// A change over the run of six of its standard errors √12 e: the statistic is normal about 6, the
// limit for one of 3 + 7 tests is 3.4 with about 60 degrees of freedom; power 99 %.
TEST(Equilibration, DriftOfSixErrorsIsFound) {
  const auto drifting = [](std::uint64_t seed) {
    RunEvidence run = stationary(seed);
    add_drift(run.series[1].value, 6 * std::sqrt(12) * error_of_mean(frames, 0.5));
    return run;
  };
  EXPECT_GE(verdicts(100, drifting)[ageing], 95);
}

// Displacements half as long in the second half: squares a quarter. Compared from lag 5 on, half the
// correlation time of the slowest series. About 2048/18 squares of that lag are independent, each half
// has errors of √(2·18/2048) = 13 %: a difference of 0.75/0.13 = 5.6 errors, where 3.5 would do.
TEST(Equilibration, SlowerSecondHalfIsFound) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    RunEvidence run = stationary(seed);
    Stream draw(seed, Purpose::tests, 1);
    std::vector<double> x = autoregressive_series(frames, 0.8, draw);
    for (std::size_t k = frames / 2; k < frames; ++k) x[k] *= 0.5;
    run.curves = {halves(x)};
    run.times = {{"tau", known(5)}};
    const Equilibration result = judge_equilibration(run);
    found += result.verdict == ageing && result.reason.find("MSD at time") != std::string::npos;
  }
  EXPECT_GE(found, 95);
}

// A mode of a hundred steps with a quarter of the amplitude of the noise that hides it: blocks that are not
// told of it do not see it, and call 28 of these 300 runs ageing.
TEST(Equilibration, SlowModesUnderNoiseAreNoDrift) {
  const auto noisy = [](std::uint64_t seed) {
    Stream draw(seed, Purpose::tests, 4);
    std::vector<double> x = autoregressive_series(frames, 0, draw);
    const std::vector<double> slow = autoregressive_series(frames, 0.99, draw);
    for (std::size_t k = 0; k < frames; ++k) x[k] += 0.25 * slow[k];
    return RunEvidence{4096, {{"Z", x}}, {halves(x)}, {{"tau", known(100)}}};
  };
  EXPECT_LE(verdicts(300, noisy)[ageing],
            12 + 3 * 3.4);  // 4 % of 300, and three standard deviations
}

// A value that approaches its end exponentially, over a fifth of the run.
TEST(Equilibration, RelaxationFromTheStartNeverPasses) {
  const auto relaxing = [](std::uint64_t seed) {
    RunEvidence run = stationary(seed);
    for (std::size_t k = 0; k < frames; ++k)
      run.series[1].value[k] += 2 * std::exp(-5.0 * static_cast<double>(k) / frames);
    return run;
  };
  EXPECT_EQ(verdicts(100, relaxing)[equilibrated], 0);
}

Equilibration with_time(const RelaxationTime& time) {
  RunEvidence run = stationary(1);
  run.times = {{"tau", known(1)}, {"tau_2", time}};
  return judge_equilibration(run);
}

// 4096 values, 4096/4095 apart: 8 blocks of 512 of them, which is twice 256.06.
TEST(Equilibration, SixteenRelaxationTimesAreNeeded) {
  const Equilibration enough = with_time(known(256));
  EXPECT_EQ(enough.verdict, equilibrated);
  EXPECT_GE(enough.tests, 3u);  // three series
  const Equilibration shorter = with_time(known(256.1));
  expect_too_short(shorter, HasSubstr("16 times tau_2 = 256.1"));
  EXPECT_EQ(shorter.tests, 0u);
  // Not relaxed, and relaxed before the first sample.
  expect_too_short(with_time({unknown, unknown, 2000, unknown, "still 0.8"}), "tau_2: still 0.8");
  EXPECT_EQ(with_time({unknown, unknown, unknown, 1, "already 0.1"}).verdict, equilibrated);
}

TEST(Equilibration, ThreeRelaxationTimesAreNeededFromEquilibrium) {
  const auto from_equilibrium = [](double time) {
    RunEvidence run = stationary(1);
    run.starts_in_equilibrium = true;
    run.times = {{"tau", known(time)}};
    return judge_equilibration(run);
  };
  EXPECT_EQ(from_equilibrium(1365).verdict, equilibrated);
  expect_too_short(from_equilibrium(1366), HasSubstr("3 times are needed"));
  RunEvidence drifting = stationary(1);
  drifting.starts_in_equilibrium = true;
  add_drift(drifting.series[1].value, 1);
  EXPECT_EQ(judge_equilibration(drifting).verdict, ageing);
}

TEST(Equilibration, WithoutEvidenceThereIsNotEnoughTime) {
  EXPECT_EQ(judge_equilibration({100, {}, {}, {}}).verdict, too_short);
  RunEvidence run{4096, {}, {}, {{"tau", known(1)}}};
  EXPECT_EQ(judge_equilibration(run).verdict, too_short);
  // Halves are enough where no series was stored; of a series nobody knows nothing follows.
  run.curves = stationary(1).curves;
  EXPECT_EQ(judge_equilibration(run).verdict, equilibrated);
  run.series = {{"Z", std::vector<double>(4096, unknown)}};
  expect_too_short(judge_equilibration(run), "Z is not known at all times");
  // As slow as the run is long.
  Stream draw(1, Purpose::tests);
  run.series = {{"S", autoregressive_series(1000, 0.999, draw)}};
  expect_too_short(judge_equilibration(run), HasSubstr("times the correlation time of S = "));
}

TEST(Equilibration, NothingIsInEquilibriumUntested) {
  const RunEvidence run{100, {{"Z", std::vector<double>(6, 1.5)}}, {}, {{"tau", known(1)}}};
  const Equilibration result = judge_equilibration(run);
  expect_too_short(result, HasSubstr("too little to test Z for ageing"));
  EXPECT_EQ(result.tests, 0u);
}

// Sixteen to thirty-two times the correlation time: too few for a plateau of blocking. Measured: 0.8 % of
// 1000 runs are called ageing, where 1 % are stated.
TEST(Equilibration, ShortSeriesAreTestedToo) {
  int false_alarms = 0, drifting = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    Stream draw(seed, Purpose::tests, 5);
    RunEvidence run{
        1999, {{"S", autoregressive_series(2000, 0.99, draw)}}, {}, {{"tau", known(90)}}};
    const Equilibration still = judge_equilibration(run);
    EXPECT_LE(still.tests, 1u);
    false_alarms += still.verdict == ageing;
    // Twelve errors √12 e, where eight blocks need five to seven.
    add_drift(run.series[0].value, 12 * std::sqrt(12) * error_of_mean(2000, 0.99));
    drifting += judge_equilibration(run).verdict != equilibrated;
  }
  EXPECT_LE(false_alarms, 5 + 3 * 2.2);
  EXPECT_EQ(drifting, 500);
}

// A correlation time of a hundred steps, estimated from the series itself: six of them, and
// eighty.
TEST(Equilibration, SixteenCorrelationTimesOfASeriesAreNeeded) {
  int few = 0, many = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Stream draw(seed, Purpose::tests, 3);
    RunEvidence run{4000, {}, {}, {{"tau", known(1)}}};
    run.series = {{"S", autoregressive_series(600, 0.99, draw)}};
    few += judge_equilibration(run).verdict == equilibrated;
    run.series = {{"S", autoregressive_series(8000, 0.99, draw)}};
    many += judge_equilibration(run).verdict == equilibrated;
  }
  EXPECT_LE(few, 50);
  EXPECT_GE(many, 95);
}

// Independent values, where blocking is exact: the rate is the stated 1 %, 20 ± 4.5 of 2000 runs.
TEST(Equilibration, RateOfFalseAlarmsIsTheStatedOne) {
  const auto independent = [](std::uint64_t seed) {
    Stream draw(seed, Purpose::tests, 2);
    RunEvidence run{100, {}, {}, {{"tau", known(1)}}};
    for (int k = 0; k < 5; ++k) run.series.push_back({"x", autoregressive_series(512, 0, draw)});
    return run;
  };
  EXPECT_NEAR(verdicts(2000, independent)[ageing], 20, 3 * 4.5);
}

TEST(Equilibration, ConstantsDoNotDriftButForRounding) {
  RunEvidence run{100, {{"E", std::vector<double>(100, 1.5)}}, {}, {{"tau", known(1)}}};
  EXPECT_EQ(judge_equilibration(run).verdict, equilibrated);
  add_drift(run.series[0].value, 1e-10);
  EXPECT_EQ(judge_equilibration(run).verdict, equilibrated);
}

}  // namespace
}  // namespace vitrel

#include "analysis/dynamics/equilibration.h"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "analysis/statistics/blocking.h"
#include "analysis/statistics/gsl_errors.h"

namespace vitrel {

namespace {

constexpr double false_alarms = 0.01;  // probability of a false verdict of ageing
constexpr double rounding = 1e-9;      // relative; conserved energies drift by it
constexpr double spacing = 2;          // ratio of the times at which curves are compared

/// One comparison: its subject, and the probability of such a difference by chance.
struct Comparison {
  std::string text;
  double probability;
};

double two_sided(double t, std::size_t degrees) {
  return 2 * gsl_cdf_tdist_Q(std::abs(t), static_cast<double>(degrees));
}

/// Returns the time between two values of a series over the whole run.
double step_of(const ScalarSeries& series, double duration) {
  return duration / static_cast<double>(series.value.size() - 1);
}

bool is_known(const ScalarSeries& series) {
  return series.value.size() >= 2 &&
         std::ranges::all_of(series.value, [](double value) { return std::isfinite(value); });
}

double correlation_time(const ScalarSeries& series, double duration) {
  if (!is_known(series)) return 0;
  return step_of(series, duration) * static_cast<double>(correlation_steps(series.value));
}

/// Returns the time by which a correlation has decayed; NaN if it is not known.
double known_time(const RelaxationTime& tau) {
  return std::isnan(tau.value) ? tau.most : tau.value;
}

std::vector<double> correlation_times(const RunEvidence& run) {
  std::vector<double> times;
  for (const ScalarSeries& series : run.series)
    times.push_back(correlation_time(series, run.duration));
  return times;
}

double slowest_time(const RunEvidence& run, const std::vector<double>& of_series) {
  double slowest = 0;
  for (const NamedTime& named : run.times) slowest = std::fmax(slowest, known_time(named.time));
  for (const double time : of_series) slowest = std::max(slowest, time);
  return slowest;
}

/// Standard error of a mean, without Student's factor, and the number of blocks behind it; 0 if there are too few.
struct BlockError {
  double error;
  std::size_t blocks;
};

BlockError without_student(const Estimate& estimate) {
  if (estimate.blocks == 0) return {0, 0};
  return {estimate.error / student_factor(estimate.blocks - 1), estimate.blocks};
}

/// Returns the error of the mean of the residuals of a line fitted to a series whose correlations decay in
/// `correlation` steps. It comes from blocking, if that reaches a plateau; otherwise from blocks of the smallest
/// length, where the line takes a degree of freedom.
BlockError error_of_residual(const std::vector<double>& residual, double shortest_block,
                             double correlation) {
  const BlockError plateau = without_student(block_average(residual, shortest_block));
  if (plateau.blocks > 0) return plateau;
  const auto length = static_cast<std::size_t>(std::ceil(std::max(1.0, shortest_block)));
  const BlockError known = without_student(
      known_block_average(residual, length, seen_of_exponential(length, correlation)));
  const double m = static_cast<double>(known.blocks);
  return {known.error * std::sqrt((m - 1) / (m - 2)), known.blocks};
}

/// The change over the series of the line fitted to it, and the error of the mean of the residuals.
struct Trend {
  double mean, change;
  BlockError residual;
};

Trend trend(const std::vector<double>& series, double shortest_block, double correlation) {
  const double n = static_cast<double>(series.size());
  const double mean = mean_of(series);
  double xy = 0, xx = 0;
  for (std::size_t k = 0; k < series.size(); ++k) {
    const double x = (static_cast<double>(k) + 0.5) / n - 0.5;
    xy += x * (series[k] - mean);
    xx += x * x;
  }
  const double change = xy / xx;
  std::vector<double> residual;
  for (std::size_t k = 0; k < series.size(); ++k)
    residual.push_back(series[k] - mean - change * ((static_cast<double>(k) + 0.5) / n - 0.5));
  return {mean, change, error_of_residual(residual, shortest_block, correlation)};
}

/// Tests a series for drift. Returns nothing if the series is too short for an error.
std::optional<Comparison> drift(const ScalarSeries& series, double duration, double correlation,
                                double slowest) {
  if (!is_known(series)) return std::nullopt;
  const double step = step_of(series, duration);
  const Trend t = trend(series.value, 2 * slowest / step, correlation / step);
  if (t.residual.blocks == 0) return std::nullopt;
  const std::size_t degrees = t.residual.blocks - 2;
  const double error = std::sqrt(12) * t.residual.error;
  const bool rounded = std::abs(t.change) <= rounding * std::abs(t.mean);
  const double probability = rounded ? 1 : two_sided(t.change / error, degrees);
  return Comparison{fmt::format("{} drifts by {:.3g} over the run, {:.1f} standard errors",
                                series.name, t.change, std::abs(t.change / error)),
                    probability};
}

/// Compares two curves at the k-th point of the first one and the l-th of the second.
Comparison difference(const HalvesOfCurve& c, std::size_t k, std::size_t l) {
  const auto squared = [](const BlockedCurve& curve, std::size_t at) {
    const double error = curve.error[at] / student_factor(curve.blocks[at] - 1);
    return error * error;
  };
  const double change = c.second.value[l] - c.first.value[k];
  const double error = std::sqrt(squared(c.first, k) + squared(c.second, l));
  const std::size_t degrees = c.first.blocks[k] + c.second.blocks[l] - 2;
  const double probability = change == 0 ? 1 : two_sided(change / error, degrees);
  return {fmt::format("{} at time {:.4g} is {:.4g} in the first half, {:.4g} in the second, {:.1f} "
                      "standard errors apart",
                      c.name, c.first.time[k], c.first.value[k], c.second.value[l],
                      std::abs(change / error)),
          probability};
}

void compare_halves(const HalvesOfCurve& c, double slowest, std::vector<Comparison>& comparisons) {
  double next = std::numeric_limits<double>::infinity();
  for (std::size_t k = c.first.time.size(); k-- > 0;) {
    const double time = c.first.time[k];
    if (time < slowest / 2) return;
    if (time > next * (1 + 1e-9) || c.first.blocks[k] == 0) continue;
    const auto same = std::ranges::find_if(
        c.second.time, [&](double other) { return std::abs(other - time) <= 1e-9 * time; });
    if (same == c.second.time.end()) continue;
    const auto l = static_cast<std::size_t>(same - c.second.time.begin());
    if (c.second.blocks[l] == 0) continue;
    comparisons.push_back(difference(c, k, l));
    next = time / spacing;
  }
}

std::string shortage(const std::string& name, double time, double duration, double needed) {
  if (duration >= needed * time) return "";
  return fmt::format("the run lasts {:.3g} times {} = {:.4g}; {:g} times are needed",
                     duration / time, name, time, needed);
}

std::string shortage(const ScalarSeries& series, double correlation_time, double duration) {
  if (!is_known(series)) return series.name + " is not known at all times";
  return shortage("the correlation time of " + series.name, correlation_time, duration,
                  min_relaxations);
}

/// Returns why the run is too short for a relaxation time, which is empty if it is not.
std::string shortage(const NamedTime& named, double duration, double needed) {
  const double time = known_time(named.time);
  if (std::isnan(time)) return fmt::format("{}: {}", named.name, named.time.reason);
  return shortage(named.name, time, duration, needed);
}

/// Returns why the run is too short for a verdict, which is empty if it is not.
std::string shortage(const RunEvidence& run, const std::vector<double>& of_series,
                     const std::string& untested, double slowest) {
  if (run.times.empty()) return "no relaxation time";
  const double needed =
      run.starts_in_equilibrium ? min_relaxations_from_equilibrium : min_relaxations;
  std::string reason;
  for (const NamedTime& time : run.times)
    if (reason.empty()) reason = shortage(time, run.duration, needed);
  if (run.starts_in_equilibrium) return reason;
  for (std::size_t k = 0; k < run.series.size() && reason.empty(); ++k)
    reason = shortage(run.series[k], of_series[k], run.duration);
  if (reason.empty() && !untested.empty())
    reason = fmt::format(
        "too little to test {} for ageing: it takes {} blocks of twice the slowest time, {:.4g}",
        untested, min_blocks, slowest);
  return reason;
}

}  // namespace

Equilibration judge_equilibration(const RunEvidence& run) {
  const std::vector<double> of_series = correlation_times(run);
  const double slowest = slowest_time(run, of_series);
  std::vector<Comparison> comparisons;
  std::string untested = run.series.empty() ? "anything" : "";
  for (std::size_t k = 0; k < run.series.size(); ++k)
    if (const auto comparison = drift(run.series[k], run.duration, of_series[k], slowest))
      comparisons.push_back(*comparison);
    else if (untested.empty())
      untested = run.series[k].name;
  for (const HalvesOfCurve& curve : run.curves) compare_halves(curve, slowest, comparisons);
  if (run.series.empty() && !comparisons.empty()) untested.clear();

  const std::size_t tests = comparisons.size();
  for (const Comparison& c : comparisons)
    if (c.probability < false_alarms / static_cast<double>(tests))
      return {EquilibrationVerdict::ageing, c.text, tests};
  const std::string too_short = shortage(run, of_series, untested, slowest);
  if (!too_short.empty()) return {EquilibrationVerdict::too_short, too_short, tests};
  return {EquilibrationVerdict::equilibrated, "", tests};
}

}  // namespace vitrel

#include "analysis/statistics/blocking.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "analysis/statistics/gsl_errors.h"
#include "core/special_values.h"

namespace vitrel {

namespace {

constexpr double rounding = 1e-9;           // relative to a mean: below it nothing fluctuates
constexpr double degrees_of_an_error = 10;  // degrees of freedom behind the error of a run
constexpr double excessive = 0.01;          // probability below which scatter is not by chance

/// Returns the variance of the mean of values taken as independent.
double squared_error(double count, double squares) {
  return squares / (count * (count - 1));
}

}  // namespace

double mean_of(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

Estimate block_average(std::span<const double> series, double shortest_block) {
  BlockSums sums;
  for (const double value : series) sums.add(value);
  return sums.estimate(shortest_block);
}

Estimate known_block_average(std::span<const double> series, std::size_t block, double seen) {
  const std::size_t blocks = series.size() / block;
  ValueSums sums;
  for (std::size_t b = 0; b < blocks; ++b) sums.add(mean_of(series.subspan(b * block, block)));
  if (blocks < min_blocks) return {mean_of(series), unknown, 0};
  return {mean_of(series), independent_average({&sums, 1}).error / std::sqrt(seen), blocks};
}

double seen_of_exponential(std::size_t block, double correlation) {
  const double ratio = static_cast<double>(block) / correlation;
  return correlation > 0 ? 1 + std::expm1(-ratio) / ratio : 1;
}

std::size_t correlation_steps(std::span<const double> series) {
  const double mean = mean_of(series);
  const auto correlation = [&](std::size_t lag) {
    double sum = 0;
    for (std::size_t k = lag; k < series.size(); ++k)
      sum += (series[k] - mean) * (series[k - lag] - mean);
    return sum / static_cast<double>(series.size() - lag);
  };
  const double variance = correlation(0);
  if (std::sqrt(variance) <= rounding * std::abs(mean)) return 0;
  const auto lasts = [&](std::size_t lag) {
    const double bias = 2 * static_cast<double>(lag) / static_cast<double>(series.size());
    return correlation(lag) / variance + bias > (1 + bias) / std::numbers::e;
  };
  std::size_t lag = 0;
  while (lag + 1 < series.size() && lasts(lag)) ++lag;
  return lag;
}

Estimate slow_average(std::span<const double> series, std::size_t shortest_block) {
  const Estimate plateau = block_average(series, static_cast<double>(shortest_block));
  if (plateau.blocks > 0) return plateau;
  const std::size_t steps = correlation_steps(series);
  const std::size_t block = std::max(shortest_block, 2 * steps);
  return known_block_average(series, block, seen_of_exponential(block, static_cast<double>(steps)));
}

void BlockSums::add(double value) {
  for (std::size_t k = 0;; ++k) {
    if (k == levels_.size()) levels_.emplace_back();
    Level& level = levels_[k];
    const double step = value - level.mean;
    level.count += 1;
    level.mean += step / level.count;
    level.squares += step * (value - level.mean);
    const bool is_odd = static_cast<std::uint64_t>(level.count) % 2 == 1;
    if (is_odd) {
      level.waiting = value;
      return;
    }
    value = 0.5 * (level.waiting + value);
  }
}

std::size_t BlockSums::count() const {
  return levels_.empty() ? 0 : static_cast<std::size_t>(levels_.front().count);
}

Estimate BlockSums::estimate(double shortest_block) const {
  if (levels_.empty()) return {unknown, unknown, 0};
  const double n = levels_.front().count;
  const double mean = levels_.front().mean;
  if (n < min_blocks) return {mean, unknown, 0};
  const double naive = squared_error(n, levels_.front().squares);
  if (naive == 0) return {mean, 0, count()};

  double length = 1;
  for (const Level& level : levels_) {
    if (level.count < min_blocks) break;
    const double squared = squared_error(level.count, level.squares);
    const double correlation = std::max(1.0, squared / naive);
    if (level.count < too_many_blocks && length >= shortest_block &&
        length * length * length >= 2 * n * correlation * correlation) {
      const auto blocks = static_cast<std::size_t>(level.count);
      return {mean, std::sqrt(squared) * student_factor(blocks - 1), blocks};
    }
    length *= 2;
  }
  return {mean, unknown, 0};
}

void BlockSums::store(std::vector<double>& numbers) const {
  numbers.push_back(static_cast<double>(levels_.size()));
  for (const Level& level : levels_)
    numbers.insert(numbers.end(), {level.count, level.mean, level.squares, level.waiting});
}

std::span<const double> BlockSums::restore(std::span<const double> numbers) {
  levels_.resize(static_cast<std::size_t>(numbers.front()));
  numbers = numbers.subspan(1);
  for (Level& level : levels_) {
    level = {numbers[0], numbers[1], numbers[2], numbers[3]};
    numbers = numbers.subspan(4);
  }
  return numbers;
}

void ValueSums::add(double value) {
  add({1, value, value * value});
}

void ValueSums::add(const ValueSums& other) {
  count += other.count;
  sum += other.sum;
  squares += other.squares;
}

Estimate independent_average(std::span<const ValueSums> classes) {
  ValueSums all;
  double squares = 0, degrees = 0;
  for (const ValueSums& one : classes) {
    if (one.count == 0) continue;
    all.add(one);
    // Rounding can make the variance of equal values a little negative.
    squares += std::max(0.0, one.squares - one.sum * one.sum / one.count);
    degrees += one.count - 1;
  }
  if (all.count == 0) return {unknown, unknown, 0};
  const double mean = all.sum / all.count;
  if (degrees == 0) return {mean, unknown, 0};
  return {
      mean,
      std::sqrt(squares / degrees / all.count) * student_factor(static_cast<std::size_t>(degrees)),
      static_cast<std::size_t>(all.count)};
}

double MeanOfRuns::half_width(double level) const {
  if (std::isnan(squared_error)) return unknown;
  return gsl_cdf_tdist_Pinv(0.5 * (1 + level), degrees_of_freedom) * std::sqrt(squared_error);
}

MeanOfRuns mean_of_runs(std::span<const double> values, std::span<const double> errors) {
  const double mean = mean_of(values), n = static_cast<double>(values.size());
  if (values.size() < 2) return {mean, unknown, false, unknown, 0};
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const MeanOfRuns by_scatter{mean, unknown, false, squares / (n - 1) / n, n - 1};
  if (errors.empty() || !std::ranges::all_of(errors, [](double e) { return e > 0; }))
    return by_scatter;

  double square_error = 0;
  for (const double error : errors) square_error += error * error / n;
  const double ratio = squares / (n - 1) / square_error;
  const double within = degrees_of_an_error * n;
  if (gsl_cdf_fdist_Q(ratio, n - 1, within) < excessive)
    return {mean, std::sqrt(ratio), true, by_scatter.squared_error, n - 1};
  const double degrees = n - 1 + within;
  return {mean, std::sqrt(ratio), false, (squares + within * square_error) / degrees / n, degrees};
}

double student_factor(std::size_t degrees_of_freedom) {
  const double x = 1 / static_cast<double>(degrees_of_freedom);
  return 1 + x * (1.0 / 2 + x * (1.0 / 4 + x / 16));
}

}  // namespace vitrel

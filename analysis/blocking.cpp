#include "analysis/blocking.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace vitrel {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Variance of the mean of values taken as independent.
double squared_error(std::span<const double> values) {
  const double mean = mean_of(values);
  double sum = 0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  const double n = static_cast<double>(values.size());
  return sum / (n * (n - 1));
}

/// Averages neighbours in pairs; an odd last value is left out.
void halve(std::vector<double>& values) {
  const std::size_t pairs = values.size() / 2;
  for (std::size_t k = 0; k < pairs; ++k) values[k] = 0.5 * (values[2 * k] + values[2 * k + 1]);
  values.resize(pairs);
}

}  // namespace

Estimate block_average(std::span<const double> series, double shortest_block) {
  if (series.empty()) return {none, none, 0};
  const double mean = mean_of(series);
  if (series.size() < fewest_blocks) return {mean, none, 0};
  const double naive = squared_error(series);
  if (naive == 0) return {mean, 0, series.size()};

  const double n = static_cast<double>(series.size());
  std::vector<double> blocks(series.begin(), series.end());
  for (double length = 1; blocks.size() >= fewest_blocks; length *= 2, halve(blocks)) {
    if (length < shortest_block) continue;
    const double squared = squared_error(blocks);
    const double correlation = std::max(1.0, squared / naive);
    if (length * length * length >= 2 * n * correlation * correlation)
      return {mean, std::sqrt(squared) * student_factor(blocks.size() - 1), blocks.size()};
  }
  return {mean, none, 0};
}

Estimate independent_average(std::size_t count, double sum, double sum_of_squares) {
  if (count == 0) return {none, none, 0};
  const double n = static_cast<double>(count);
  const double mean = sum / n;
  if (count == 1) return {mean, none, 0};
  // Rounding can make the variance of equal values a little negative.
  const double variance = std::max(0.0, (sum_of_squares - n * mean * mean) / (n - 1));
  return {mean, std::sqrt(variance / n) * student_factor(count - 1), count};
}

double student_factor(std::size_t degrees_of_freedom) {
  const double x = 1 / static_cast<double>(degrees_of_freedom);
  return 1 + x * (1.0 / 2 + x * (1.0 / 4 + x / 16));
}

}  // namespace vitrel

#include "edmd/sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/elementary.h"

namespace vitrel {

namespace {

/// Room for the rounding of the last time, so that a duration of 100 intervals has 101 samples.
constexpr double slack = 1e-9;

}  // namespace

std::uint64_t even_count(double interval, double duration) {
  return static_cast<std::uint64_t>(std::floor(duration / interval * (1 + slack))) + 1;
}

double even_time(std::uint64_t k, double interval, double duration) {
  return std::min(interval * static_cast<double>(k), duration);
}

std::vector<double> linear_times(double interval, double duration) {
  std::vector<double> times;
  const std::uint64_t count = even_count(interval, duration);
  for (std::uint64_t k = 0; k < count; ++k) times.push_back(even_time(k, interval, duration));
  return times;
}

std::vector<double> logarithmic_times(double first, int per_decade, double duration) {
  std::vector<double> times{0.0};
  for (int k = 0;; ++k) {
    const double within = std::numbers::ln10 * (k % per_decade) / per_decade;
    const double time = first * power(10., k / per_decade) * exponential(within);
    if (time > duration * (1 + slack)) return times;
    times.push_back(std::min(time, duration));
  }
}

}  // namespace vitrel

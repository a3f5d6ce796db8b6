#include "edmd/sampling.h"

#include <algorithm>
#include <cmath>

namespace vitrel {

namespace {

/// Room for the rounding of the last time, so that a duration of 100 intervals has 101 samples.
constexpr double slack = 1e-9;

}  // namespace

std::vector<double> linear_times(double interval, double duration) {
  std::vector<double> times;
  const auto last = static_cast<long>(std::floor(duration / interval * (1 + slack)));
  for (long k = 0; k <= last; ++k) times.push_back(std::min(interval * k, duration));
  return times;
}

std::vector<double> logarithmic_times(double first, int per_decade, double duration) {
  std::vector<double> times{0.0};
  for (int k = 0;; ++k) {
    const double time = first * std::pow(10.0, static_cast<double>(k) / per_decade);
    if (time > duration * (1 + slack)) return times;
    times.push_back(std::min(time, duration));
  }
}

}  // namespace vitrel

#include "edmd/sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/elementary.h"

namespace vitrel {

namespace {

/// Allows for the rounding of the last time, so that a duration of 100 intervals has 101 samples.
constexpr double slack = 1e-9;

/// Returns first · 10^(k/per_decade).
double logarithmic_time(std::uint64_t k, double first, int per_decade) {
  const auto steps = static_cast<std::uint64_t>(per_decade);
  const double within = std::numbers::ln10 * static_cast<double>(k % steps) / per_decade;
  return first * power(10., static_cast<int>(k / steps)) * exponential(within);
}

}  // namespace

double SampleTimes::operator[](std::uint64_t k) const {
  if (!listed_.empty()) return listed_[k];
  if (k == 0) return 0;
  const double time = per_decade_ == 0 ? interval_ * static_cast<double>(k)
                                       : logarithmic_time(k - 1, interval_, per_decade_);
  return std::min(time, duration_);
}

SampleTimes linear_times(double interval, double duration) {
  SampleTimes times;
  times.interval_ = interval;
  times.duration_ = duration;
  times.size_ = static_cast<std::uint64_t>(std::floor(duration / interval * (1 + slack))) + 1;
  return times;
}

SampleTimes logarithmic_times(double first, int per_decade, double duration) {
  SampleTimes times;
  times.interval_ = first;
  times.duration_ = duration;
  times.per_decade_ = per_decade;
  const double last = duration * (1 + slack);
  const auto is_in = [&](std::uint64_t k) {
    return logarithmic_time(k, first, per_decade) <= last;
  };
  // The logarithm is off by no more than rounding.
  const double steps = per_decade * logarithm(last / first) / std::numbers::ln10;
  auto count = static_cast<std::uint64_t>(std::max(0., std::floor(steps)));
  while (count > 0 && !is_in(count - 1)) --count;
  while (is_in(count)) ++count;
  times.size_ = count + 1;
  return times;
}

}  // namespace vitrel

#include "analysis/dynamics/relaxation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/special_values.h"

namespace vitrel {

namespace {

constexpr double level = 1 / std::numbers::e;
constexpr double reach = 1.25;  // range of the straight line, as a factor of time

void check(const Decay& c) {
  if (c.time.empty() || c.value.size() != c.time.size() || c.error.size() != c.time.size())
    throw UserError(
        fmt::format("relaxation time: {} times, {} values and {} errors; a correlation has "
                    "equally many, one at least",
                    c.time.size(), c.value.size(), c.error.size()));
  if (c.time.front() <= 0 || !std::is_sorted(c.time.begin(), c.time.end(), std::less_equal<>()))
    throw UserError("relaxation time: the times of a correlation must be above 0 and ascend");
}

RelaxationTime without(const std::string& reason, double least = unknown, double most = unknown) {
  return {unknown, unknown, least, most, reason};
}

/// Returns whether some value from `begin` on is above 1/e by more than three errors.
bool returns(const Decay& c, std::size_t begin) {
  for (std::size_t k = begin; k < c.time.size(); ++k)
    if (c.value[k] - 3 * c.error[k] > level) return true;
  return false;
}

/// A straight line in ln t through the points [begin, end).
struct Line {
  double time, value;  ///< geometric and arithmetic mean of the points
  double slope;        ///< per unit of ln t
  double error;        ///< the mean error of the points
  double error_slope;  ///< slope of the line through the errors
};

Line straight_line(const Decay& c, std::size_t begin, std::size_t end) {
  double x = 0, y = 0, error = 0;
  for (std::size_t k = begin; k < end; ++k) {
    x += std::log(c.time[k]);
    y += c.value[k];
    error += c.error[k];
  }
  const double n = static_cast<double>(end - begin);
  x /= n, y /= n;
  double xx = 0, xy = 0, xe = 0;
  for (std::size_t k = begin; k < end; ++k) {
    const double dx = std::log(c.time[k]) - x;
    xx += dx * dx;
    xy += dx * (c.value[k] - y);
    xe += dx * (c.error[k] - error / n);
  }
  return {std::exp(x), y, xy / xx, error / n, xe / xx};
}

}  // namespace

RelaxationTime relaxation_time(const Decay& c) {
  check(c);
  const auto below = std::ranges::find_if(c.value, [](double value) { return value <= level; });
  if (below == c.value.end())
    return without(
        fmt::format("still {:.2g} at the longest time {:.4g}", c.value.back(), c.time.back()),
        c.time.back());
  const auto k = static_cast<std::size_t>(below - c.value.begin());
  if (k == 0)
    return without(fmt::format("already {:.2g} at the shortest time {:.4g}: sample more often",
                               c.value.front(), c.time.front()),
                   unknown, c.time.front());
  if (returns(c, k)) return without("returns above 1/e after having fallen below", c.time[k]);

  std::size_t begin = k - 1, end = k + 1;
  while (begin > 0 && c.time[begin - 1] >= c.time[k] / reach) --begin;
  while (end < c.time.size() && c.time[end] <= c.time[k] * reach) ++end;
  const Line line = straight_line(c, begin, end);
  if (!(line.slope < 0)) return without("does not fall where it crosses 1/e");
  const double shift = (level - line.value) / line.slope;
  const double time = line.time * std::exp(shift);
  if (!(time > c.time[begin] / reach && time < c.time[end - 1] * reach))
    return without("too noisy where it crosses 1/e");
  const double error = std::abs(line.error + line.error_slope * shift);
  return {time, time * error / -line.slope, unknown, unknown, ""};
}

Decay connected_part(const Decay& correlation, const Estimate& plateau) {
  Decay result = correlation;
  const double rest = 1 - plateau.mean;
  for (std::size_t k = 0; k < result.value.size(); ++k) {
    result.value[k] = (correlation.value[k] - plateau.mean) / rest;
    // The derivative of (C − P)/(1 − P) with respect to P is −(1 − C)/(1 − P)².
    const double of_plateau = plateau.error * (1 - correlation.value[k]) / rest;
    result.error[k] = std::hypot(correlation.error[k], of_plateau) / rest;
  }
  return result;
}

}  // namespace vitrel

#include "bench/lab/reference/interval_jet.h"

#include <numbers>

namespace vitrel::lab {

namespace {

constexpr Real pi = std::numbers::pi_v<Real>;

/// Whether offset + k · period lies in the interval for some whole k, in doubt yes.
bool holds_multiple(const Interval& x, Real offset, Real period) {
  const Real slack = 8 * std::numeric_limits<Real>::epsilon() * (1 + std::abs(x.low / period));
  return std::floor((x.high - offset) / period + slack) >=
         std::ceil((x.low - offset) / period - slack);
}

}  // namespace

Interval cos(const Interval& angle) {
  const Real at_low = std::cos(angle.low);
  const Real at_high = std::cos(angle.high);
  Interval range = widened(std::min(at_low, at_high), std::max(at_low, at_high));
  if (holds_multiple(angle, 0, 2 * pi)) range.high = 1;
  if (holds_multiple(angle, pi, 2 * pi)) range.low = -1;
  return {std::max(range.low, Real(-1)), std::min(range.high, Real(1))};
}

Interval sin(const Interval& angle) {
  const Real at_low = std::sin(angle.low);
  const Real at_high = std::sin(angle.high);
  Interval range = widened(std::min(at_low, at_high), std::max(at_low, at_high));
  if (holds_multiple(angle, 0.5L * pi, 2 * pi)) range.high = 1;
  if (holds_multiple(angle, -0.5L * pi, 2 * pi)) range.low = -1;
  return {std::max(range.low, Real(-1)), std::min(range.high, Real(1))};
}

Jet cosine(Real angle, Real rate, const Interval& time) {
  const Interval phase = Interval(angle) + Interval(rate) * time;
  const Interval c = cos(phase);
  const Interval s = sin(phase);
  return {c, Interval(-rate) * s, Interval(-rate) * Interval(rate) * c};
}

Jet sine(Real angle, Real rate, const Interval& time) {
  const Interval phase = Interval(angle) + Interval(rate) * time;
  const Interval c = cos(phase);
  const Interval s = sin(phase);
  return {s, Interval(rate) * c, Interval(-rate) * Interval(rate) * s};
}

Jet linear(Real offset, Real rate, const Interval& time) {
  return {Interval(offset) + Interval(rate) * time, rate, 0};
}

}  // namespace vitrel::lab

#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

/// Interval arithmetic in long double, and functions of time with two derivatives over an interval.
namespace vitrel::lab {

using Real = long double;

/// [low, high], rounded outwards: every operation widens its result by two units in the last place, which
/// covers the rounding of the operation itself.
struct Interval {
  Real low = 0, high = 0;

  Interval() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a number is an interval
  Interval(Real value) : low(value), high(value) {}
  Interval(Real from, Real to) : low(from), high(to) {}

  Real middle() const { return 0.5L * (low + high); }
  Real width() const { return high - low; }
};

inline Interval widened(Real low, Real high) {
  constexpr Real unit = 2 * std::numeric_limits<Real>::epsilon();
  constexpr Real tiny = std::numeric_limits<Real>::min();
  return {low - unit * std::abs(low) - tiny, high + unit * std::abs(high) + tiny};
}

inline Interval operator+(const Interval& x, const Interval& y) {
  return widened(x.low + y.low, x.high + y.high);
}
inline Interval operator-(const Interval& x, const Interval& y) {
  return widened(x.low - y.high, x.high - y.low);
}
inline Interval operator*(const Interval& x, const Interval& y) {
  const auto [low, high] =
      std::minmax({x.low * y.low, x.low * y.high, x.high * y.low, x.high * y.high});
  return widened(low, high);
}

/// Cosine over an interval: the extremes at the ends, or ±1 where it passes a multiple of π.
Interval cos(const Interval& angle);
Interval sin(const Interval& angle);

/// f and its first two derivatives with respect to time, all as intervals over one interval of time.
struct Jet {
  Interval value, first, second;

  Jet() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a number is a constant function
  Jet(Real constant) : value(constant) {}
  Jet(const Interval& f, const Interval& f1, const Interval& f2)
      : value(f), first(f1), second(f2) {}
};

inline Jet operator+(const Jet& f, const Jet& g) {
  return {f.value + g.value, f.first + g.first, f.second + g.second};
}
inline Jet operator-(const Jet& f, const Jet& g) {
  return {f.value - g.value, f.first - g.first, f.second - g.second};
}
inline Jet operator*(const Jet& f, const Jet& g) {
  return {f.value * g.value, f.first * g.value + f.value * g.first,
          f.second * g.value + Interval(2) * f.first * g.first + f.value * g.second};
}

/// cos(angle + rate t) and sin(angle + rate t) over the times t.
Jet cosine(Real angle, Real rate, const Interval& time);
Jet sine(Real angle, Real rate, const Interval& time);
/// offset + rate t.
Jet linear(Real offset, Real rate, const Interval& time);

}  // namespace vitrel::lab

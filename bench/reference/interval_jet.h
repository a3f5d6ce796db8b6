#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

/// @file
/// Interval arithmetic in any binary floating-point type, and functions of time with two
/// derivatives over an interval.
///
/// Results are rounded outwards: every operation widens its result by two units in the last place,
/// more than the rounding of the operation itself. The elementary functions of the type are taken
/// to be right to within the same two units (those of glibc are, to one).
namespace vitrel::bench {

template <class Real>
struct Interval {
  Real low = 0, high = 0;

  Interval() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a number is an interval
  Interval(const Real& value) : low(value), high(value) {}
  Interval(const Real& from, const Real& to) : low(from), high(to) {}

  Real middle() const { return (low + high) / 2; }
  Real width() const { return high - low; }

  friend Interval operator+(const Interval& x, const Interval& y) {
    return widened(x.low + y.low, x.high + y.high);
  }
  friend Interval operator-(const Interval& x, const Interval& y) {
    return widened(x.low - y.high, x.high - y.low);
  }
  friend Interval operator*(const Interval& x, const Interval& y) {
    const Real p = x.low * y.low, q = x.low * y.high, r = x.high * y.low, s = x.high * y.high;
    return widened(std::min(std::min(p, q), std::min(r, s)),
                   std::max(std::max(p, q), std::max(r, s)));
  }
  friend Interval operator*(const Real& x, const Interval& y) {
    const Real p = x * y.low, q = x * y.high;
    return widened(std::min(p, q), std::max(p, q));
  }
  /// y must not hold 0.
  friend Interval operator/(const Interval& x, const Interval& y) {
    const Real p = x.low / y.low, q = x.low / y.high, r = x.high / y.low, s = x.high / y.high;
    return widened(std::min(std::min(p, q), std::min(r, s)),
                   std::max(std::max(p, q), std::max(r, s)));
  }

  /// [low, high] and two units in the last place to either side.
  static Interval widened(const Real& low, const Real& high) {
    using std::abs;
    const Real unit = 2 * std::numeric_limits<Real>::epsilon();
    const Real tiny = std::numeric_limits<double>::min();  // where doubles lose digits
    return {low - (unit * abs(low) + tiny), high + (unit * abs(high) + tiny)};
  }
};

/// The product of an interval with itself, never negative.
template <class Real>
Interval<Real> square(const Interval<Real>& x) {
  const Real p = x.low * x.low, q = x.high * x.high;
  const bool holds_zero = x.low <= 0 && x.high >= 0;
  const auto range = Interval<Real>::widened(std::min(p, q), std::max(p, q));
  return {holds_zero ? Real(0) : std::max(range.low, Real(0)), range.high};
}

/// The square root of what is not negative in x; x.high ≥ 0.
template <class Real>
Interval<Real> root(const Interval<Real>& x) {
  using std::sqrt;
  const Real low = sqrt(std::max(x.low, Real(0)));
  const Real high = sqrt(x.high);
  return Interval<Real>::widened(low, high);
}

/// f and its first two derivatives with respect to time, all as intervals over one interval of
/// time.
template <class Real>
struct Jet {
  Interval<Real> value, first, second;

  friend Jet operator+(const Jet& f, const Jet& g) {
    return {f.value + g.value, f.first + g.first, f.second + g.second};
  }
  friend Jet operator-(const Jet& f, const Jet& g) {
    return {f.value - g.value, f.first - g.first, f.second - g.second};
  }
  friend Jet operator*(const Jet& f, const Jet& g) {
    return {f.value * g.value, f.first * g.value + f.value * g.first,
            f.second * g.value + Real(2) * (f.first * g.first) + f.value * g.second};
  }
  friend Jet operator*(const Interval<Real>& constant, const Jet& f) {
    return {constant * f.value, constant * f.first, constant * f.second};
  }
};

template <class Real>
Jet<Real> square(const Jet<Real>& f) {
  return {square(f.value), Real(2) * (f.value * f.first),
          Real(2) * (square(f.first) + f.value * f.second)};
}

/// offset + rate t over the times t.
template <class Real>
Jet<Real> linear(const Interval<Real>& offset, const Interval<Real>& rate,
                 const Interval<Real>& time) {
  return {offset + rate * time, rate, {}};
}

/// The cosine and the sine of one angle, known to lie in an interval.
template <class Real>
struct Direction {
  Interval<Real> cosine, sine;
};

/// The direction after a further turn by anything between −δ and δ, δ ≥ 0:
/// cos(φ + x) = cos φ cos x − sin φ sin x with cos x ∈ [1 − δ²/2, 1] and |sin x| ≤ δ.
template <class Real>
Direction<Real> turned(const Direction<Real>& from, const Real& delta) {
  const Real most = delta * (1 + 4 * std::numeric_limits<Real>::epsilon());
  const Interval<Real> cosine(1 - most * most / 2 - std::numeric_limits<Real>::epsilon(), 1);
  const Interval<Real> sine(-most, most);
  const auto clipped = [](const Interval<Real>& x) -> Interval<Real> {
    return {std::max(x.low, Real(-1)), std::min(x.high, Real(1))};
  };
  return {clipped(from.cosine * cosine + from.sine * sine),
          clipped(from.sine * cosine + from.cosine * sine)};
}

template <class Real>
std::pair<Real, Real> cosine_and_sine(const Real& angle) {
  return {std::cos(angle), std::sin(angle)};
}

/// The directions of the angles in an interval.
template <class Real>
Direction<Real> direction(const Interval<Real>& angle) {
  const Real middle = angle.middle();
  const auto [c, s] = cosine_and_sine(middle);
  return turned<Real>({Interval<Real>::widened(c, c), Interval<Real>::widened(s, s)},
                      std::max(angle.high - middle, middle - angle.low));
}

/// cos(φ + ω t) over an interval of times whose directions are given.
template <class Real>
Jet<Real> cosine(const Direction<Real>& over, const Interval<Real>& omega) {
  return {over.cosine, Real(-1) * (omega * over.sine), Real(-1) * (square(omega) * over.cosine)};
}
/// sin(φ + ω t).
template <class Real>
Jet<Real> sine(const Direction<Real>& over, const Interval<Real>& omega) {
  return {over.sine, omega * over.cosine, Real(-1) * (square(omega) * over.sine)};
}

}  // namespace vitrel::bench

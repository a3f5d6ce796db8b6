#pragma once

#include <Eigen/Core>
#include <cmath>
#include <compare>
#include <limits>
#include <type_traits>
#include <utility>

/// @file
/// `Extended` is the number type of the exact check (core/state/check.h): long double where it has at least 64 bits
/// (x86: 64; Linux on ARM: 113, emulated), otherwise the sum of two doubles. The build option VITREL_PORTABLE_EXTENDED
/// chooses the sum of two doubles everywhere.
namespace vitrel {

/// The unevaluated sum high + low of two doubles with |low| ≤ ½ ulp(high): 106 bits.
///
/// The rounding errors of sums and products of two doubles are doubles themselves (Dekker 1971; factors are split into
/// halves of 26 bits, without fused multiply-add). The operations are algorithms 6, 10 and 17 of Joldes, Muller &
/// Popescu (2017), and the square root is that of Lefèvre et al. (2023). Their relative errors, in units of u² = 2⁻¹⁰⁶,
/// are at most
///
///     sum, difference 3     product 5     quotient 15     square root 25/8
///
/// The bound of sum and difference holds even if the operands cancel. The bound of the product is due to Muller &
/// Rideau (2022). `epsilon` is 16 u².
///
/// Sources: dekker1971, joldes2017, muller2022, lefevre2023.
///
/// Measured on x86, the overlap criterion of a pair (exact_pair.h) takes 4 to 6 times as long as in long double, and
/// the gap 5 times. With the binary floating-point types of Boost.Multiprecision the criterion takes 20 times (64 bits)
/// or 40 times (80 bits) as long, and the gap 40 or 115 times.
///
/// The bounds are valid where no product of the doubles exceeds 2⁹⁹⁶ or is below 2⁻⁹⁶⁹ (0 excepted). Infinities can be
/// compared and negated, but their products are not numbers.
class DoubleDouble {
 public:
  constexpr DoubleDouble() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): mixed expressions read like those of long double
  constexpr DoubleDouble(double x) : high_(x) {}

  constexpr explicit operator double() const { return high_; }
  constexpr explicit operator long double() const { return static_cast<long double>(high_) + low_; }

  constexpr DoubleDouble operator-() const { return {-high_, -low_}; }
  friend constexpr DoubleDouble operator+(DoubleDouble x, DoubleDouble y) {
    const DoubleDouble high = sum(x.high_, y.high_), low = sum(x.low_, y.low_);
    const DoubleDouble part = ordered_sum(high.high_, high.low_ + low.high_);
    return ordered_sum(part.high_, low.low_ + part.low_);
  }
  friend constexpr DoubleDouble operator-(DoubleDouble x, DoubleDouble y) { return x + -y; }
  friend constexpr DoubleDouble operator*(DoubleDouble x, DoubleDouble y) {
    const DoubleDouble high = product(x.high_, y.high_);
    return ordered_sum(high.high_, high.low_ + (x.high_ * y.low_ + x.low_ * y.high_));
  }
  friend constexpr DoubleDouble operator/(DoubleDouble x, DoubleDouble y) {
    const double quotient = x.high_ / y.high_;
    const DoubleDouble high = product(y.high_, quotient);
    const DoubleDouble part = ordered_sum(high.high_, y.low_ * quotient);
    const DoubleDouble near = ordered_sum(part.high_, part.low_ + high.low_);
    return ordered_sum(quotient, ((x.high_ - near.high_) + (x.low_ - near.low_)) / y.high_);
  }
  constexpr DoubleDouble& operator+=(DoubleDouble x) { return *this = *this + x; }
  constexpr DoubleDouble& operator-=(DoubleDouble x) { return *this = *this - x; }
  constexpr DoubleDouble& operator*=(DoubleDouble x) { return *this = *this * x; }
  constexpr DoubleDouble& operator/=(DoubleDouble x) { return *this = *this / x; }

  friend constexpr auto operator<=>(const DoubleDouble&, const DoubleDouble&) = default;
  friend constexpr DoubleDouble abs(DoubleDouble x) { return x < 0 ? -x : x; }
  friend DoubleDouble sqrt(DoubleDouble x) {
    const double root = std::sqrt(x.high_);
    if (root == 0) return root;
    const DoubleDouble square = product(root, root);
    return ordered_sum(root, ((x.high_ - square.high_) - square.low_ + x.low_) / (2 * root));
  }

  /// The exact product of two doubles.
  static constexpr DoubleDouble product(double x, double y) {
    const double high = x * y, x1 = upper_half(x), x2 = x - x1, y1 = upper_half(y), y2 = y - y1;
    return {high, ((x1 * y1 - high) + x1 * y2 + x2 * y1) + x2 * y2};
  }

 private:
  constexpr DoubleDouble(double high, double low) : high_(high), low_(low) {}

  static constexpr double upper_half(double x) {
    const double shifted = (0x1p27 + 1) * x;
    return shifted - (shifted - x);
  }
  /// The exact sum of two doubles. `ordered_sum` requires |x| ≥ |y|.
  static constexpr DoubleDouble sum(double x, double y) {
    const double high = x + y, part = high - x;
    return {high, (x - (high - part)) + (y - part)};
  }
  static constexpr DoubleDouble ordered_sum(double x, double y) {
    const double high = x + y;
    return {high, y - (high - x)};
  }

  double high_ = 0, low_ = 0;
};

#ifdef VITREL_PORTABLE_EXTENDED
using Extended = DoubleDouble;
#else
using Extended =
    std::conditional_t<(std::numeric_limits<long double>::digits >= 64), long double, DoubleDouble>;
#endif

/// Cosine and sine to within 2⁻¹⁰⁰, identical on every platform. Beyond |angle| = 2⁵³, where neighbouring doubles are
/// radians apart, they are those of double precision.
std::pair<DoubleDouble, DoubleDouble> extended_cosine_and_sine(double angle);

}  // namespace vitrel

template <>
struct std::numeric_limits<vitrel::DoubleDouble> : std::numeric_limits<double> {
  static constexpr int digits = 103;
  static constexpr vitrel::DoubleDouble epsilon() { return 0x1p-102; }
};

/// @cond EIGEN
template <>
struct Eigen::NumTraits<vitrel::DoubleDouble> : Eigen::NumTraits<double> {
  using Real = vitrel::DoubleDouble;
  using NonInteger = Real;
  using Nested = Real;
};
/// @endcond

static_assert(std::numeric_limits<vitrel::Extended>::digits >= 64);

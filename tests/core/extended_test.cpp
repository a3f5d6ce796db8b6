#include "core/extended.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <numbers>

#include "core/elementary.h"
#include "core/random/stream.h"
#include "core/special_values.h"

/// The sum of two doubles against binary numbers of 500 bits, in which sums and products of its values are exact.
namespace vitrel {
namespace {

using Exact = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<500, boost::multiprecision::digit_base_2>,
    boost::multiprecision::et_off>;

Exact exact(const DoubleDouble& x) {
  const auto high = static_cast<double>(x);
  return Exact(high) + Exact(static_cast<double>(x - high));
}

/// |x − truth| in units of u² |scale|, u = 2⁻⁵³.
double error(const Exact& x, const Exact& truth, const Exact& scale) {
  const Exact off = abs(x - truth);
  if (off == 0) return 0;
  return static_cast<double>(ldexp(Exact(off / abs(scale)), 106));
}

/// A lower part of any size that the type allows.
DoubleDouble random_number(Stream& draw) {
  const int exponent = static_cast<int>(draw.below(60)), lower = static_cast<int>(draw.below(60));
  const double high = std::ldexp(draw.uniform(-1, 1), exponent - 30);
  const double ulp = std::nextafter(std::abs(high), infinity) - std::abs(high);
  const double low = std::ldexp(ulp * draw.uniform(-0.49, 0.49), -lower);
  return draw.uniform() < 0.1 ? DoubleDouble(high) : high + DoubleDouble(low);
}

/// Every third pair cancels but for a part between 1 and 2⁻¹¹⁰.
DoubleDouble partner_of(const DoubleDouble& x, Stream& draw) {
  if (draw.below(3) != 0) return random_number(draw);
  const int exponent = static_cast<int>(draw.below(110));
  const double part = std::ldexp(draw.uniform(-1, 1), -exponent);
  return -x * (1 + DoubleDouble(part));
}

TEST(DoubleDouble, OperationsKeepTheirErrorBounds) {
  Stream draw(1, Purpose::tests);
  double sum = 0, product = 0, quotient = 0, root = 0;
  for (int k = 0; k < 250'000; ++k) {  // four operations each
    const DoubleDouble x = random_number(draw), y = partner_of(x, draw);
    const Exact a = exact(x), b = exact(y);
    const Exact truth = k % 2 == 0 ? Exact(a + b) : Exact(a - b);
    sum = std::max(sum, error(exact(k % 2 == 0 ? x + y : x - y), truth, truth));
    product = std::max(product, error(exact(x * y), a * b, a * b));
    quotient = std::max(quotient, error(exact(x / y) * b, a, a));
    // The square is off by twice as much as the root.
    const Exact r = exact(sqrt(abs(x)));
    root = std::max(root, error(r * r, abs(a), abs(a)) / 2);
  }
  EXPECT_LT(sum, 3);
  EXPECT_LT(product, 5);
  EXPECT_LT(quotient, 15);
  EXPECT_LT(root, 25. / 8);
  // The bounds are not far above what occurs.
  EXPECT_GT(sum, 1);
  EXPECT_GT(product, 2.5);
  EXPECT_GT(quotient, 4);
  EXPECT_GT(root, 1.5);
}

/// The area of a triangle with sides a, b and c (Heron).
template <class Real>
Real area(Real a, Real b, Real c) {
  using std::sqrt;
  const Real s = (a + b + c) / 2;
  return sqrt(s * (s - a) * (s - b) * (s - c));
}

/// To the rounding of long double, whatever its number of bits.
TEST(DoubleDouble, ExpressionsAgreeWithLongDouble) {
  Stream draw(2, Purpose::tests);
  for (int k = 0; k < 100'000; ++k) {
    const double a = draw.uniform(1, 1.5), b = draw.uniform(1, 1.5), c = draw.uniform(1, 1.5);
    const auto found = static_cast<long double>(area<DoubleDouble>(a, b, c));
    constexpr long double unit = std::max(std::numeric_limits<long double>::epsilon(), 0x1p-102L);
    ASSERT_LT(std::abs(found - area<long double>(a, b, c)), 32 * unit);
  }
}

TEST(DoubleDouble, LowerPartsOrderNumbers) {
  const DoubleDouble one = 1, above = 1 + DoubleDouble(0x1p-100),
                     below = 1 - DoubleDouble(0x1p-100);
  EXPECT_TRUE(below < one && one < above && below < above && above > 1 && below < 1);
  EXPECT_TRUE(one == 1 && above != 1 && one <= 1 && one >= 1);
  EXPECT_TRUE(abs(-above) == above && abs(above) == above);
  EXPECT_TRUE(above - below == 0x1p-99);
  EXPECT_TRUE(DoubleDouble(-infinity) < below && above < infinity && -DoubleDouble(infinity) < 0);
  EXPECT_TRUE(sqrt(DoubleDouble(0)) == 0);
  EXPECT_TRUE(std::isnan(static_cast<double>(sqrt(DoubleDouble(-1)))));
  EXPECT_EQ(static_cast<double>(above), 1);
  EXPECT_EQ(static_cast<long double>(1 + DoubleDouble(0x1p-60)), 1 + 0x1p-60L);
}

/// To 2⁻¹⁰⁰, also next to multiples of π/2 and of large angles.
TEST(ExtendedCosineAndSine, AgreeWithSeriesOfFiveHundredBits) {
  Stream draw(3, Purpose::tests);
  const auto expect_close = [](double angle) {
    const auto [cosine, sine] = extended_cosine_and_sine(angle);
    EXPECT_LT(abs(exact(cosine) - cos(Exact(angle))), 0x1p-100) << angle;
    EXPECT_LT(abs(exact(sine) - sin(Exact(angle))), 0x1p-100) << angle;
  };
  for (const double largest : {1e-8, 1.0, 10.0, 1e4, 1e9, 0x1p53})
    for (int k = 0; k < 300; ++k) expect_close(draw.uniform(-largest, largest));
  for (int k = -40; k <= 40; ++k) {
    const double turned = k * (std::numbers::pi / 4);
    for (const double angle :
         {turned, std::nextafter(turned, infinity), std::nextafter(turned, -infinity)})
      expect_close(angle);
  }
  for (const double angle : {0x1p53, -0x1p53, 0x1p53 - 1}) expect_close(angle);
}

TEST(ExtendedCosineAndSine, LieOnTheUnitCircle) {
  Stream draw(4, Purpose::tests);
  for (int k = 0; k < 100'000; ++k) {
    const auto [cosine, sine] = extended_cosine_and_sine(draw.uniform(-100, 100));
    ASSERT_LT(static_cast<double>(abs(cosine * cosine + sine * sine - 1)), 0x1p-100);
  }
}

TEST(ExtendedCosineAndSine, HugeAnglesHaveThoseOfTheEngine) {
  for (const double angle : {1e16, -3e200}) {
    const auto [cosine, sine] = extended_cosine_and_sine(angle);
    const auto [c, s] = cosine_and_sine(angle);
    EXPECT_TRUE(cosine == c && sine == s);
  }
}

}  // namespace
}  // namespace vitrel

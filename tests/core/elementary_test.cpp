// Elementary functions against those of the C library in extended precision.

#include "core/elementary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/random/stream.h"
#include "core/special_values.h"

namespace vitrel {
namespace {

/// The error in units in the last place of the exact value.
double units(double value, long double exact) {
  const auto rounded = static_cast<double>(exact);
  const long double unit = std::nextafter(std::abs(rounded), infinity) - std::abs(rounded);
  return static_cast<double>(std::abs(value - exact) / unit);
}

double of_any_size(Stream& draw, double smallest, double largest) {
  return std::pow(10, draw.uniform(smallest, largest));
}
double of_any_sign(Stream& draw, double smallest, double largest) {
  const double size = of_any_size(draw, smallest, largest);
  return draw.uniform(-size, size);
}

TEST(Elementary, CosineAndSine) {
  Stream draw(1, Purpose::tests);
  for (int trial = 0; trial < 100'000; ++trial) {
    const double size = of_any_size(draw, -10, 15.9), angle = draw.uniform(-size, size);
    const auto [cosine, sine] = cosine_and_sine(angle);
    ASSERT_NEAR(cosine, std::cos(static_cast<long double>(angle)), 9e-16L) << angle;
    ASSERT_NEAR(sine, std::sin(static_cast<long double>(angle)), 9e-16L) << angle;
  }
}

TEST(Elementary, CosineAndSineOfAnyNumber) {
  for (const double angle : {0x1p53, -1e17, 1e300, std::numeric_limits<double>::max()}) {
    const auto [cosine, sine] = cosine_and_sine(angle);
    EXPECT_NEAR(cosine * cosine + sine * sine, 1, 1e-15) << angle;
  }
  EXPECT_TRUE(std::isnan(cosine_and_sine(infinity).sine));
}

TEST(Elementary, Logarithm) {
  Stream draw(2, Purpose::tests);
  double largest = 0, largest_plus = 0;
  for (int trial = 0; trial < 200'000; ++trial) {
    const double x = trial % 2 ? of_any_size(draw, -320, 308) : 1 + of_any_sign(draw, -15, 0);
    largest = std::max(largest, units(logarithm(x), std::log(static_cast<long double>(x))));
    const double y = x - 1;
    if (y > -1)
      largest_plus = std::max(
          largest_plus, units(logarithm_of_one_plus(y), std::log1p(static_cast<long double>(y))));
  }
  EXPECT_LT(largest, 1);
  EXPECT_LT(largest_plus, 3);
  EXPECT_EQ(logarithm(1), 0);
  EXPECT_EQ(logarithm(0), -infinity);
  EXPECT_EQ(logarithm(infinity), infinity);
  EXPECT_TRUE(std::isnan(logarithm(-1)));
}

TEST(Elementary, Exponential) {
  Stream draw(3, Purpose::tests);
  double largest = 0, largest_minus = 0;
  for (int trial = 0; trial < 200'000; ++trial) {
    const double size = of_any_size(draw, -10, 2.84), x = draw.uniform(-size, size);
    largest = std::max(largest, units(exponential(x), std::exp(static_cast<long double>(x))));
    largest_minus = std::max(
        largest_minus, units(exponential_minus_one(x), std::expm1(static_cast<long double>(x))));
  }
  EXPECT_LT(largest, 1);
  EXPECT_LT(largest_minus, 4);
  EXPECT_EQ(exponential(0), 1);
  EXPECT_EQ(exponential(-infinity), 0);
  EXPECT_EQ(exponential(infinity), infinity);
  EXPECT_NEAR(exponential(-745) / std::numeric_limits<double>::denorm_min(), 1, 0.1);
}

TEST(Elementary, PolarAngle) {
  Stream draw(4, Purpose::tests);
  double largest = 0;
  for (int trial = 0; trial < 200'000; ++trial) {
    const double x = of_any_sign(draw, -8, 8), y = of_any_sign(draw, -8, 8);
    largest = std::max(largest, units(polar_angle(y, x), std::atan2(static_cast<long double>(y),
                                                                    static_cast<long double>(x))));
  }
  EXPECT_LT(largest, 3);
  EXPECT_EQ(polar_angle(0, 0), 0);
  EXPECT_EQ(polar_angle(0, 1), 0);
  EXPECT_DOUBLE_EQ(polar_angle(0, -1), std::atan2(0, -1));
  EXPECT_DOUBLE_EQ(polar_angle(1, 0), std::atan2(1, 0));
  EXPECT_DOUBLE_EQ(polar_angle(-1, 0), std::atan2(-1, 0));
}

// Against the distribution function, and its symmetry.
TEST(Elementary, QuantilesOfTheNormalDistribution) {
  for (const double u : {1e-300, 1e-20, 1e-9, 1e-3, 0.01, 0.074, 0.076, 0.2, 0.4, 0.499}) {
    const long double below = 0.5L * std::erfc(-static_cast<long double>(normal_quantile(u)) /
                                               std::numbers::sqrt2_v<long double>);
    // d ln u = x dx, and the error is relative to x.
    EXPECT_NEAR(static_cast<double>(below / u), 1,
                1e-15 * (3 + 4 * std::pow(normal_quantile(u), 2)));
  }
  EXPECT_EQ(normal_quantile(0.5), 0);
  EXPECT_EQ(normal_quantile(0.75), -normal_quantile(0.25));
  EXPECT_DOUBLE_EQ(normal_quantile(0.975), 1.9599639845400542);
}

TEST(Elementary, RootsAndPowers) {
  Stream draw(5, Purpose::tests);
  double largest = 0;
  for (int trial = 0; trial < 100'000; ++trial) {
    const double x = of_any_size(draw, trial % 2 ? -20 : -323, trial % 2 ? 20 : 308);
    largest = std::max(largest, units(root(x, 3), std::cbrt(static_cast<long double>(x))));
    ASSERT_EQ(root(-x, 3), -root(x, 3));
    const double y = trial % 2 ? x : 1;  // far from the ends of the range
    ASSERT_EQ(root(0x1p-30 * y, 3), 0x1p-10 * root(y, 3));
  }
  EXPECT_LT(largest, 1);
  EXPECT_EQ(root(9, 2), 3);
  for (int n = 0; n < 1000; ++n) ASSERT_EQ(root(power(n, 3), 3), n);
  EXPECT_EQ(root(infinity, 3), infinity);
  EXPECT_TRUE(std::isnan(root(std::numeric_limits<double>::quiet_NaN(), 3)));
  EXPECT_EQ(power(3, 4), 81);
  EXPECT_EQ(power(3, 0), 1);
}

}  // namespace
}  // namespace vitrel

#include "analysis/bessel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random/stream.h"

namespace vitrel {
namespace {

/// J₀(x) = (1/π) ∫₀^π cos(x sin τ) dτ in extended precision. The trapezoidal rule with n intervals is
/// off by about 2 J_2n(x), far below rounding for 2n > x + 100.
double by_quadrature(double x) {
  const int n = 100 + static_cast<int>(x);
  long double sum = 1;  // both ends, half each
  for (int k = 1; k < n; ++k)
    sum += std::cos(x * std::sin(std::numbers::pi_v<long double> * k / n));
  return static_cast<double>(sum / n);
}

TEST(BesselJ0, EqualsTheIntegralWithinTheStatedError) {
  const BesselJ0 j0;
  EXPECT_EQ(j0(0), 1);
  Stream draw(1, Purpose::tests);
  for (int k = 0; k < 4000; ++k) {
    const double x = draw.uniform(0, k % 2 == 0 ? 3 : 200);
    EXPECT_NEAR(j0(x), by_quadrature(x), 1e-10) << x;
  }
  for (const double x : {1.0 / 128, 63.9999999, 64.0, 64.0000001, 3000.0})
    EXPECT_NEAR(j0(x), by_quadrature(x), 1e-10) << x;
}

// Abramowitz & Stegun, table 9.5: the first zero of J₀.
TEST(BesselJ0, VanishesAtItsFirstZero) {
  EXPECT_NEAR(BesselJ0()(2.4048255576957728), 0, 1e-10);
}

}  // namespace
}  // namespace vitrel

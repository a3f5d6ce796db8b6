#include "analysis/dynamics/bessel_j0.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vitrel {
namespace {

// The bound of the header against the series and asymptotic forms of the C++ library, which share
// nothing with the nodes (from ::j0) but the mathematics; that bound is reached, so the test can fail.
TEST(BesselJ0, IsTrueWithinTheStatedError) {
  const BesselJ0 bessel;
  double largest = 0;
  for (int k = 0; k < 70000; ++k) {
    const double x = 0.001 * k + 0.0003;
    largest = std::max(largest, std::abs(bessel(x) - std::cyl_bessel_j(0.0, x)));
  }
  EXPECT_LE(largest, 5.9e-11);
  EXPECT_GE(largest, 5e-11);
}

// Abramowitz & Stegun, table 9.1 and 9.5.
TEST(BesselJ0, ValuesOfTheTables) {
  const BesselJ0 bessel;
  EXPECT_EQ(bessel(0), 1);
  EXPECT_NEAR(bessel(1), 0.765197686557966, 1e-10);
  EXPECT_NEAR(bessel(10), -0.245935764451348, 1e-10);
  EXPECT_NEAR(bessel(2.404825557695773), 0, 1e-10);
}

}  // namespace
}  // namespace vitrel

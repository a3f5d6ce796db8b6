// The contact pressure of two particles, where everything is known in closed form.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "mc/contact_pressure.h"
#include "mc/insertion.h"
#include "mc/sampler.h"
#include "tests/support/equal_bodies.h"
#include "tests/support/statistics.h"

namespace vitrel {
namespace {

Configuration2 two_particles(const Ellipse& shape) {
  return equal_bodies<2>(2, shape, Vec2::Constant(5 * shape.a));
}

// In a box longer than four semi-axes Q = V² (1 − 2B₂/V), so Z = 1 + (B₂/V)/(1 − 2B₂/V), B₂ = A +
// P²/(4π). 4 standard errors, false alarm 6e-5.
void expect_exact_compressibility(const std::vector<double>& values, const Configuration2& pair) {
  const Ellipse& shape = pair.shape[0];
  const double volume = pair.box.volume();
  const double b2 = shape.volume() + std::pow(perimeter(shape), 2) / (4 * std::numbers::pi);
  const double exact = 1 + b2 / volume / (1 - 2 * b2 / volume);
  const Estimate z = estimate(values);
  EXPECT_LT(z.error, 0.03 * (exact - 1));
  EXPECT_NEAR(z.mean, exact, 4 * z.error);
}

class PairPressure : public testing::TestWithParam<double> {};

// States drawn independently of each other.
TEST_P(PairPressure, OfRandomInsertionsIsExact) {
  const Ellipse shape = of_aspect_ratio(GetParam());
  const Configuration2 empty = two_particles(shape);
  std::vector<double> values;
  ContactPressure pressure;
  for (int k = 0; k < 300'000; ++k) {
    Configuration2 c = empty;
    insert_particles(c, {packing_fraction(empty), 1'000'000, false}, k, {});
    pressure.add(c);
    values.push_back(pressure.compressibility());
    pressure.clear();
  }
  expect_exact_compressibility(values, empty);
}

// The same from the Markov chain, which so is shown to visit all hard states equally. Values are
// block averages of 400 sweeps.
TEST_P(PairPressure, OfTheSamplerIsExact) {
  const Ellipse shape = of_aspect_ratio(GetParam());
  Configuration2 c = two_particles(shape);
  insert_particles(c, {packing_fraction(c), 1'000'000, false}, 1, {});
  Sampler sampler(c, 3);
  sampler.set_steps(2.5 * shape.a, 1.5);
  std::vector<double> values;
  ContactPressure pressure;
  for (int block = 0; block < 1500; ++block) {
    for (int k = 0; k < 200; ++k) {
      sampler.sweep();
      sampler.sweep();
      pressure.add(c);
    }
    values.push_back(pressure.compressibility());
    pressure.clear();
  }
  expect_exact_compressibility(values, c);
}

INSTANTIATE_TEST_SUITE_P(AspectRatios, PairPressure, testing::Values(1.0, 2.0, 6.0));

}  // namespace
}  // namespace vitrel

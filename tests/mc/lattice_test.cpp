#include "mc/lattice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/state/check.h"
#include "tests/support/scenes.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;

Configuration2 equal_particles(std::size_t n, double aspect_ratio, double packing_fraction) {
  Configuration2 c;
  c.resize(n);
  for (Ellipse& shape : c.shape) shape = of_aspect_ratio(aspect_ratio);
  const double side = std::sqrt(static_cast<double>(n) * pi / packing_fraction);
  c.box = PeriodicBox<2>(Vec2(side, side));
  return c;
}

// Disks fill π/4 of a square lattice; κ = √3 at 45° reaches the triangular lattice's π/(2√3), and
// θ and −θ are mirror images (thesis, figure 4.5).
TEST(SquareLattice, DensestPackingFractions) {
  EXPECT_NEAR(densest_square_lattice({1, 1}, 0.3), pi / 4, 1e-14);
  EXPECT_NEAR(densest_square_lattice(of_aspect_ratio(std::sqrt(3.0)), pi / 4),
              pi / (2 * std::sqrt(3.0)), 1e-14);
  EXPECT_NEAR(densest_square_lattice(of_aspect_ratio(2), 0), pi / 8, 1e-14);
  for (double angle : {0.1, 0.5, 0.7})
    EXPECT_NEAR(densest_square_lattice(of_aspect_ratio(3), angle),
                densest_square_lattice(of_aspect_ratio(3), -angle), 1e-13);
}

TEST(SquareLattice, ThesisSceneIsPlacedAndHard) {
  Configuration2 c = equal_particles(100, 2, 0.5);
  place_on_lattice(c, {Arrangement::square, pi / 4});
  EXPECT_TRUE(exact_check(c).clean());
  EXPECT_EQ(c.angle[99], pi / 4);
  // 10 × 10 square cells: the nearest neighbour is one cell away.
  EXPECT_NEAR((c.position[1] - c.position[0]).norm(), c.box.lengths().x() / 10, 1e-12);
}

TEST(SquareLattice, SaysHowDenseItCanBe) {
  Configuration2 c = equal_particles(100, 2, 0.6);
  try {
    place_on_lattice(c, {Arrangement::square, 0});
    FAIL() << "an overlapping lattice was accepted";
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find("reaches 0.392699"), std::string::npos)
        << error.what();
  }
}

// 101 is a prime: a chain of 101 would be exact, but 8 × 13 sites with 3 of them empty make a box
// that is fit for use; 150 = 10 × 15 wastes nothing. Cells stay square, the area is kept.
TEST(SquareLattice, ChoosesAFitBoxForAnyNumber) {
  Configuration2 prime = equal_particles(101, 2, 0.35);
  const double area = prime.box.volume();
  EXPECT_NE(place_on_lattice(prime, {}).reason.find("3 sites empty"), std::string::npos);
  EXPECT_NEAR(prime.box.volume(), area, 1e-12 * area);
  EXPECT_TRUE(exact_check(prime).clean());
  Configuration2 c = equal_particles(150, 2, 0.35);
  EXPECT_NE(place_on_lattice(c, {}).reason.find(" 0 sites empty"), std::string::npos);
  const Vec2 lengths = c.box.lengths();
  EXPECT_NEAR(lengths.maxCoeff() / lengths.minCoeff(), 1.5, 1e-12);
}

// Circles of radius a fit the cells while φ ≤ π/(4κ), whatever the angles.
TEST(SquareLattice, RandomAnglesWhileTheyAreDisjoint) {
  Configuration2 c = equal_particles(400, 2, 0.99 * pi / 8);
  place_on_lattice(c, {Arrangement::square, 0, true}, 5);
  EXPECT_TRUE(exact_check(c).clean());
  // Mean of cos 2θ of 400 uniform angles: standard error 1/√800; 4 of them, false alarm 6e-5.
  double order = 0;
  for (double angle : c.angle) order += std::cos(2 * angle) / 400;
  EXPECT_LT(std::abs(order), 4 / std::sqrt(800.0));
  Configuration2 dense = equal_particles(400, 2, 0.6);
  EXPECT_THROW(place_on_lattice(dense, {Arrangement::square, 0, true}, 5), UserError);
}

class TriangularLattice : public testing::TestWithParam<double> {};

// Just below π/√12 at any aspect ratio, and never beyond.
TEST_P(TriangularLattice, ReachesTheDensestPacking) {
  const double densest = pi / std::sqrt(12.0);
  Configuration2 c = equal_particles(120, GetParam(), densest * (1 - 1e-9));
  const double area = c.box.volume();
  place_on_lattice(c, {Arrangement::triangular, 0});
  EXPECT_NEAR(c.box.volume(), area, 1e-9);
  EXPECT_TRUE(exact_check(c).clean());
  Configuration2 beyond = equal_particles(120, GetParam(), densest * (1 + 1e-6));
  EXPECT_THROW(place_on_lattice(beyond, {Arrangement::triangular, 0}), UserError);
}

INSTANTIATE_TEST_SUITE_P(AspectRatios, TriangularLattice, testing::Values(1, 2, 6, 20));

TEST(TriangularLatticeAngle, OtherThanZeroIsRefused) {
  Configuration2 c = equal_particles(16, 2, 0.5);
  EXPECT_THROW(place_on_lattice(c, {Arrangement::triangular, 0.3}), UserError);
}

}  // namespace
}  // namespace vitrel

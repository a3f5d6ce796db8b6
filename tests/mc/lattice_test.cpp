#include "mc/lattice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/neighbors/pairs.h"
#include "core/state/check.h"
#include "mc/hard_core.h"
#include "tests/support/equal_bodies.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;

Configuration2 equal_particles(std::size_t n, double aspect_ratio, double packing_fraction) {
  const double side = std::sqrt(static_cast<double>(n) * pi / packing_fraction);
  return equal_bodies(n, of_aspect_ratio(aspect_ratio), Vec2(side, side));
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
  EXPECT_THAT(
      [&] {
        place_on_lattice(c, {Arrangement::square, 0});
      },
      testing::ThrowsMessage<UserError>(testing::HasSubstr("reaches 0.392699")));
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

Configuration3 equal_solids(std::size_t n, const Vec3& semi_axes, double packing_fraction,
                            const Vec3& proportions = Vec3::Ones()) {
  Configuration3 c = equal_bodies(n, {semi_axes}, proportions);
  scale_to_packing_fraction(c, packing_fraction);
  return c;
}

struct Crystal {
  Arrangement arrangement;
  std::size_t particles;  ///< of whole cells, as many along each direction
  double densest;         ///< of spheres
  int neighbours;         ///< that touch a sphere there
};
void PrintTo(const Crystal& crystal, std::ostream* out) {
  *out << "arrangement " << static_cast<int>(crystal.arrangement);
}

class CubicLattice : public testing::TestWithParam<Crystal> {};

// Just below the density at which spheres touch, in the stretched crystal of ellipsoids too, and never beyond; the
// touching neighbours tell which lattice it is.
TEST_P(CubicLattice, ReachesItsDensestPacking) {
  const auto& [arrangement, particles, densest, neighbours] = GetParam();
  for (const Vec3& axes : {Vec3(1, 1, 1), Vec3(3, 1, 1), Vec3(0.5, 1.3, 2)}) {
    // The box of whole cells is as long as the bodies are.
    Configuration3 c = equal_solids(particles, axes, densest * (1 - 1e-9), axes);
    const Vec3 given = c.box.lengths();
    const StageReport report = place_on_lattice(c, {arrangement});
    EXPECT_NE(report.reason.find(" 0 sites empty"), std::string::npos) << report.reason;
    EXPECT_LT((c.box.lengths() - given).norm(), 1e-12 * given.norm());
    EXPECT_TRUE(exact_check(c).clean());
    int close = 0;
    for_each_pair(c, 1 + 1e-6, [&](std::size_t i, std::size_t j, const Vec3& d) {
      close += (i == 0) != (j == 0) && d.cwiseQuotient(axes).norm() < 2 * (1 + 1e-6);
    });
    EXPECT_EQ(close, neighbours);
    Configuration3 beyond = equal_solids(particles, axes, densest * (1 + 1e-6), axes);
    EXPECT_THROW(place_on_lattice(beyond, {arrangement}), UserError);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Arrangements, CubicLattice,
    testing::Values(Crystal{Arrangement::cubic, 216, pi / 6, 6},
                    Crystal{Arrangement::face_centred, 256, pi / std::sqrt(18.0), 12},
                    Crystal{Arrangement::body_centred, 250, pi* std::sqrt(3.0) / 8, 8}));

// A slab of 8 × 8 × 2 cells stays one; 500 spheres in a long box have no empty sites.
TEST(CubicLatticeBox, KeepsCloseToTheGivenOne) {
  Configuration3 slab = equal_solids(512, Vec3::Ones(), 0.5, Vec3(1, 1.02, 0.24));
  const double volume = slab.box.volume();
  place_on_lattice(slab, {Arrangement::face_centred});
  EXPECT_NEAR(slab.box.volume(), volume, 1e-12 * volume);
  const Vec3 lengths = slab.box.lengths();
  EXPECT_NEAR(lengths.y() / lengths.x(), 1, 1e-12);
  EXPECT_NEAR(lengths.z() / lengths.x(), 0.25, 1e-12);
  EXPECT_TRUE(exact_check(slab).clean());
}

TEST(CubicLatticeBox, SpreadsEmptySites) {
  Configuration3 c = equal_solids(101, Vec3(2, 1, 1), 0.3);
  place_on_lattice(c, {Arrangement::body_centred});
  EXPECT_TRUE(exact_check(c).clean());
  // Columns are twice as far apart as rows.
  EXPECT_LT(c.box.lengths().maxCoeff(), 2.1 * c.box.lengths().minCoeff());
}

}  // namespace
}  // namespace vitrel

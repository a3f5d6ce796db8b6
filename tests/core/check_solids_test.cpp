#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/contact/ellipsoid_gap.h"
#include "core/error.h"
#include "core/special_values.h"
#include "tests/support/exact_checks.h"
#include "tests/support/solids.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;
const Quaternion upright = Quaternion::Identity();

Quaternion turned(double angle, const Vec3& axis) {
  return Quaternion(Eigen::AngleAxisd(angle, axis.normalized()));
}

void add(Configuration3& configuration, const Ellipsoid& shape, const Vec3& position,
         const Quaternion& orientation) {
  const std::size_t i = configuration.size();
  configuration.resize(i + 1);
  configuration.shape[i] = shape;
  configuration.position[i] = position;
  configuration.orientation[i] = orientation;
}

Configuration3 pair_in_a_box(double length, const Ellipsoid& one, const Vec3& position1,
                             const Quaternion& orientation1, const Ellipsoid& two,
                             const Vec3& position2, const Quaternion& orientation2) {
  Configuration3 configuration = empty_box<3>(Vec3::Constant(length));
  add(configuration, one, position1, orientation1);
  add(configuration, two, position2, orientation2);
  return configuration;
}

TEST(ExactCheckOfSolids, EmptyAndLonelyStatesAreClean) {
  EXPECT_TRUE(exact_check(empty_box<3>({5, 5, 5})).clean());
  Configuration3 one = empty_box<3>({20, 20, 20});
  add(one, {{2, 1, 0.5}}, {0, 0, 0}, turned(0.3, {1, 2, 3}));
  const ExactCheck<3> check = exact_check(one);
  EXPECT_TRUE(check.clean());
  EXPECT_EQ(check.smallest_gap, infinity);
  EXPECT_EQ(check.pairs_examined, 0u);
}

// Parallel flat sides, 2b = 2 apart less 0.1: the depth is the way back.
TEST(ExactCheckOfSolids, OrdinaryOverlap) {
  Configuration3 configuration = empty_box<3>({40, 40, 40});
  add(configuration, {{3, 1, 2}}, {-10, -10, -10}, upright);
  add(configuration, {{3, 1, 2}}, {5, 5, 5}, upright);
  add(configuration, {{3, 1, 2}}, {5, 6.9, 5}, upright);
  expect_one_overlap(configuration, 1, 2, {0, 0, 0});
  EXPECT_NEAR(exact_check(configuration).smallest_gap, -0.1, 1e-15);
}

// Concentric disc-like bodies on edge to each other, h₁ + h₂ = 6 along the axis of either disc, and more
// in any other direction.
TEST(ExactCheckOfSolids, DepthOfACrossIsTheShortestWayOut) {
  const Ellipsoid disc{{5, 5, 1}};
  const Configuration3 cross =
      pair_in_a_box(40, disc, {0, 0, 0}, upright, disc, {0, 0, 0}, turned(pi / 2, {1, 0, 0}));
  expect_one_overlap(cross, 0, 1, {0, 0, 0});
  EXPECT_NEAR(exact_check(cross).smallest_gap, -6, 1e-12);
}

TEST(ExactCheckOfSolids, CrossedAndContainedOverlaps) {
  const Ellipsoid needle{{8, 0.5, 0.4}}, lump{{8, 7, 6}}, seed{{1, 0.5, 0.2}};
  expect_one_overlap(pair_in_a_box(40, needle, {1, 2, 3}, upright, needle, {1.5, 1.8, 3.3},
                                   turned(pi / 2, {0, 0.1, 1})),
                     0, 1, {0, 0, 0});
  expect_one_overlap(pair_in_a_box(40, lump, {3, 3, 3}, turned(1, {1, 1, 0}), seed, {5, 2, 1},
                                   turned(2, {0, 1, 1})),
                     0, 1, {0, 0, 0});
  expect_one_overlap(pair_in_a_box(40, seed, {5, 2, 1}, turned(2, {0, 1, 1}), lump, {3, 3, 3},
                                   turned(1, {1, 1, 0})),
                     0, 1, {0, 0, 0});
}

TEST(ExactCheckOfSolids, OverlapAcrossFaceEdgeAndCorner) {
  const Ellipsoid body{{2, 1, 1}};
  expect_one_overlap(pair_in_a_box(20, body, {9.5, 0, 0}, upright, body, {-8, 0, 0}, upright), 0, 1,
                     {1, 0, 0});
  expect_one_overlap(
      pair_in_a_box(20, body, {0, -9.5, 9.5}, upright, body, {0, 9.5, -9.5}, upright), 0, 1,
      {0, -1, 1});
  expect_one_overlap(
      pair_in_a_box(20, body, {9.5, 9.5, -9.5}, upright, body, {-9.5, -9.5, 9.5}, upright), 0, 1,
      {1, 1, -1});
}

// A needle of length 10 along a diagonal of the box, 8.6 long, meets its own image along it, and no other;
// turned to the side it does not, and is 5 − 2 · 0.3 from the next image.
TEST(ExactCheckOfSolids, OwnImages) {
  Configuration3 configuration = empty_box<3>({5, 7, 20});
  add(configuration, {{5, 0.3, 0.3}}, {1, 2, 3},
      Quaternion::FromTwoVectors(Vec3::UnitX(), Vec3(5, -7, 0)));
  expect_one_overlap(configuration, 0, 0, {1, -1, 0});
  configuration.orientation[0] = turned(pi / 2, {0, 1, 0});
  EXPECT_TRUE(exact_check(configuration).clean());
  EXPECT_NEAR(exact_check(configuration).smallest_gap, 4.4, 1e-14);
}

// In a box 6 high, j is seen from i 2.9 above and, a little farther, 3.1 below. Needles along (1, 0, −1)
// meet only in the second place, which a nearest-image search never looks at; a long needle in a cube
// shorter than itself meets through several images at once.
TEST(ExactCheckOfSolids, OverlapThroughFartherImages) {
  Configuration3 configuration = empty_box<3>({30, 30, 6});
  const Quaternion slanted = Quaternion::FromTwoVectors(Vec3::UnitX(), Vec3(1, 0, -1));
  add(configuration, {{3, 0.2, 0.2}}, {-1, 0, -1.5}, slanted);
  add(configuration, {{3, 0.2, 0.2}}, {2, 0, 1.4}, slanted);
  expect_one_overlap(configuration, 0, 1, {0, 0, -1});

  Configuration3 cube = empty_box<3>({4, 4, 4});
  add(cube, {{6.5, 0.1, 0.1}}, {0, 0, 0}, turned(0.15, {0, 0, 1}));
  add(cube, {{0.4, 0.4, 0.4}}, {0, 0, 0}, upright);
  const ExactCheck<3> check = exact_check(cube);
  // The sphere's images at 4, −4 along x, moved by 4 sin 0.15 ≈ 0.6 from the needle, are clear of it;
  // with the needle level they are not: at −1, 0, 1 box lengths, as is its own image.
  ASSERT_EQ(check.overlaps.size(), 1u);
  cube.orientation[0] = upright;
  const ExactCheck<3> level = exact_check(cube);
  ASSERT_EQ(level.overlaps.size(), 6u);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(level.overlaps[k].j, 0u);
    EXPECT_EQ(level.overlaps[k].shift, Shift<3>(k + 1, 0, 0));
    EXPECT_EQ(level.overlaps[3 + k].j, 1u);
    EXPECT_EQ(level.overlaps[3 + k].shift, Shift<3>(k - 1, 0, 0));
  }
}

/// n³ parallel ellipsoids in a box whose sides are n times the touching distances along x, y and z,
/// 2/√(A_kk), plus n times `gap`.
Configuration3 touching_lattice(int n, const Ellipsoid& shape, const Quaternion& turn, double gap) {
  const Vec3 inverse = shape_matrix({shape.semi_axes.cwiseInverse()}, turn).diagonal();
  const Vec3 spacing = 2 * inverse.cwiseSqrt().cwiseInverse() + Vec3::Constant(gap);
  Configuration3 configuration = empty_box<3>(n * spacing);
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y)
      for (int z = 0; z < n; ++z)
        add(configuration, shape,
            (Vec3(x, y, z) + Vec3::Constant(0.5 - 0.5 * n)).cwiseProduct(spacing), turn);
  return configuration;
}

// Separated by 1e-13 nothing overlaps; short of touching by 1e-13 each particle overlaps with its six
// neighbours. Parallel and congruent: η₁ vanishes for all pairs. Positions are stored to 1e-15 here, so
// both are facts about the stored doubles.
TEST(ExactCheckOfSolids, TouchingLatticeIsResolvedTo1em13) {
  const int n = 4;
  for (const Ellipsoid& shape : {Ellipsoid{{1, 1, 1}}, Ellipsoid{{1.1, 1, 0.9}}}) {
    for (const Quaternion& turn : {upright, turned(0.2, {1, 2, 3})}) {
      const ExactCheck<3> apart = exact_check(touching_lattice(n, shape, turn, 1e-13));
      EXPECT_TRUE(apart.clean());
      EXPECT_GT(apart.smallest_gap, 0.5e-13);
      EXPECT_LT(apart.smallest_gap, 1.1e-13);
      const ExactCheck<3> hit = exact_check(touching_lattice(n, shape, turn, -1e-13));
      EXPECT_EQ(hit.overlaps.size(), 3u * n * n * n);
      EXPECT_LT(hit.smallest_gap, -0.5e-13);
      EXPECT_GT(hit.smallest_gap, -1.1e-13);
    }
  }
}

// Tolerance zero: one unit in the last place of a coordinate is the difference between an overlap
// and none; touching exactly is none.
TEST(ExactCheckOfSolids, OneUnitInTheLastPlaceDecides) {
  const Ellipsoid ball{{1, 1, 1}};
  for (const Quaternion& turn : {upright, turned(1, {0, 0, 1}), turned(2, {3, 2, 1})}) {
    Configuration3 configuration =
        pair_in_a_box(16, ball, {0, 0, 0}, turn, ball, {std::nextafter(2, 0), 0, 0}, upright);
    expect_one_overlap(configuration, 0, 1, {0, 0, 0});
    configuration.position[1].x() = std::nextafter(2, 3);
    EXPECT_TRUE(exact_check(configuration).clean());
  }
  Configuration3 touching = empty_box<3>({16, 16, 16});
  add(touching, {{3, 1, 2}}, {-1, 0, 0}, upright);
  add(touching, {{3, 1, 2}}, {5, 0, 0}, upright);
  add(touching, {{3, 1, 2}}, {-1, 2, 0}, upright);
  add(touching, {{3, 1, 2}}, {-1, 0, -4}, upright);
  EXPECT_TRUE(exact_check(touching).clean());
  EXPECT_NEAR(exact_check(touching).smallest_gap, 0, 1e-18);
}

/// Random positions, so that there are overlaps of every kind, also through several images.
Configuration3 random_state(int n, const Vec3& lengths, double aspect, std::uint64_t seed) {
  Stream draw(seed, Purpose::tests);
  Configuration3 configuration = empty_box<3>(lengths);
  for (int i = 0; i < n; ++i) {
    const Vec3 place{draw.uniform(-0.5, 0.5), draw.uniform(-0.5, 0.5), draw.uniform(-0.5, 0.5)};
    const double size = draw.uniform(0.3, 1);
    const Ellipsoid shape = scaled(random_ellipsoid(draw, aspect), size);
    add(configuration, shape, place.cwiseProduct(lengths), random_orientation(draw));
  }
  return configuration;
}

TEST(ExactCheckOfSolids, CellsFindWhatAllPairsFind) {
  const Configuration3 states[] = {
      random_state(1000, {40, 30, 20}, 2, 1),  // many cells
      random_state(200, {60, 12, 7}, 4, 2),    // one or two cells across
      random_state(20, {6, 7, 5}, 20, 3),      // several images of each pair
      random_state(600, {60, 70, 80}, 20, 4),  // dilute
  };
  for (const Configuration3& state : states) {
    const ExactCheck<3> all_pairs = exact_check(state);
    EXPECT_GT(all_pairs.overlaps.size(), 0u);
    expect_equal(all_pairs, exact_check(state, 0));
  }
}

// Against the support gap in double precision over a plain scan of images: other code, other
// formula. The longest particles are longer than the box.
TEST(ExactCheckOfSolids, EqualsAScanWithTheSupportGap) {
  const Configuration3 state = random_state(30, {5, 4.5, 4}, 40, 5);
  const auto gap = [&](std::size_t i, std::size_t j, const Vec3& d) {
    return support_gap(state.shape[i], state.orientation[i], state.shape[j], state.orientation[j],
                       d)
        .gap;
  };
  EXPECT_GT(2 * largest_circumradius(state), 5);
  EXPECT_GT(expect_overlaps_of_a_scan(state, exact_check(state), 3, gap), 100u);
}

// Pair by pair in a wide box, the smallest gap is the support gap of the pair.
TEST(ExactCheckOfSolids, SmallestGapIsTheSupportGapOfDisjointPairs) {
  Stream draw(6, Purpose::tests);
  int compared = 0;
  for (int k = 0; k < 3000; ++k) {
    const Ellipsoid one = random_ellipsoid(draw, 20);
    const Ellipsoid two = scaled(random_ellipsoid(draw, 20), 0.1);
    const double reach = one.circumradius() + two.circumradius();
    const Quaternion turn1 = random_orientation(draw), turn2 = random_orientation(draw);
    const Vec3 d = random_vector(draw, 0, 1.5 * reach);
    const double gap = support_gap(one, turn1, two, turn2, d).gap;
    if (gap <= 0 || gap >= one.circumradius()) continue;
    ++compared;
    EXPECT_NEAR(exact_check(pair_in_a_box(200, one, {0, 0, 0}, turn1, two, d, turn2)).smallest_gap,
                gap, 1e-14 * reach);
  }
  EXPECT_GT(compared, 1000);
}

TEST(ExactCheckOfSolids, ImpossibleNumbersAreRefused) {
  const Configuration3 good = random_state(3, {20, 20, 20}, 3, 7);
  EXPECT_NO_THROW(exact_check(good));
  const auto expect_refused = [&](auto&& spoil) {
    Configuration3 bad = good;
    spoil(bad);
    EXPECT_THROW(exact_check(bad), InvariantError);
  };
  expect_refused([](Configuration3& bad) { bad.position[1].z() = std::nan(""); });
  expect_refused([](Configuration3& bad) { bad.position[1].y() = 1e9; });
  expect_refused([](Configuration3& bad) { bad.orientation[2].x() = infinity; });
  expect_refused([](Configuration3& bad) { bad.orientation[2].coeffs() *= 1.01; });
  expect_refused([](Configuration3& bad) { bad.shape[0].semi_axes[2] = 0; });
  expect_refused([](Configuration3& bad) { bad.shape[0].semi_axes[1] = std::nan(""); });
  expect_refused([](Configuration3& bad) { bad.shape[0].semi_axes[0] = 1e6; });
}

}  // namespace
}  // namespace vitrel

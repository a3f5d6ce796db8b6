// The exact check of states of ellipses and ellipsoids. check_reference_test.cpp compares it with a plain scan.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <type_traits>
#include <vector>

#include "core/contact/contact_queries.h"
#include "core/error.h"
#include "core/random/stream.h"
#include "core/special_values.h"
#include "tests/support/exact_checks.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;
const Quaternion upright = Quaternion::Identity();

Quaternion turned(double angle, const Vec3& axis) {
  return Quaternion(Eigen::AngleAxisd(angle, axis.normalized()));
}

template <int Dim>
void add(Configuration<Dim>& state, const std::type_identity_t<ParticleShape<Dim>>& shape,
         const std::type_identity_t<Vec<Dim>>& position,
         const std::type_identity_t<Orientation<Dim>>& orientation) {
  const std::size_t i = state.size();
  state.resize(i + 1);
  state.shape[i] = shape;
  state.position[i] = position;
  turn(state, i, orientation);
}

template <int Dim>
Configuration<Dim> pair_in_a_box(double length, const ParticleShape<Dim>& one,
                                 const Vec<Dim>& position1, const Orientation<Dim>& turn1,
                                 const ParticleShape<Dim>& two, const Vec<Dim>& position2,
                                 const Orientation<Dim>& turn2) {
  Configuration<Dim> state = empty_box<Dim>(Vec<Dim>::Constant(length));
  add(state, one, position1, turn1);
  add(state, two, position2, turn2);
  return state;
}

template <int Dim>
void expect_clean_when_alone(const ParticleShape<Dim>& shape, const Orientation<Dim>& turn) {
  EXPECT_TRUE(exact_check(empty_box<Dim>(Vec<Dim>::Constant(5))).clean());
  Configuration<Dim> one = empty_box<Dim>(Vec<Dim>::Constant(20));
  add(one, shape, Vec<Dim>::Zero(), turn);
  const ExactCheck<Dim> check = exact_check(one);
  EXPECT_TRUE(check.clean());
  EXPECT_EQ(check.smallest_gap, infinity);
  EXPECT_EQ(check.pairs_examined, 0u);
}

TEST(ExactCheck, EmptyAndLonelyStatesAreClean) {
  expect_clean_when_alone<2>({2, 1}, 0.3);
  expect_clean_when_alone<3>({{2, 1, 0.5}}, turned(0.3, {1, 2, 3}));
}

// Parallel flat sides, 2b = 2 apart less 0.1: the depth is the way back.
TEST(ExactCheck, OrdinaryOverlap) {
  Configuration2 flat = empty_box<2>({40, 40});
  add(flat, {3, 1}, {-10, -10}, 0);
  add(flat, {3, 1}, {5, 5}, 0);
  add(flat, {3, 1}, {5, 6.9}, 0);
  expect_one_overlap(flat, 1, 2, {0, 0});
  EXPECT_NEAR(exact_check(flat).smallest_gap, -0.1, 1e-15);
  Configuration3 solid = empty_box<3>({40, 40, 40});
  add(solid, {{3, 1, 2}}, {-10, -10, -10}, upright);
  add(solid, {{3, 1, 2}}, {5, 5, 5}, upright);
  add(solid, {{3, 1, 2}}, {5, 6.9, 5}, upright);
  expect_one_overlap(solid, 1, 2, {0, 0, 0});
  EXPECT_NEAR(exact_check(solid).smallest_gap, -0.1, 1e-15);
}

// The bodies are concentric and perpendicular. Along n ellipses are h₁ + h₂ deep: a + b along the
// axes and more in between (2 √((a² + b²)/2) at 45°). Disc-like bodies on edge to each other have
// h₁ + h₂ = 6 along the axis of either disc, and more in any other direction.
TEST(ExactCheck, DepthOfACrossIsTheShortestWayOut) {
  const Configuration2 flat = pair_in_a_box<2>(40, {6, 1}, {0, 0}, 0, {6, 1}, {0, 0}, pi / 2);
  EXPECT_NEAR(exact_check(flat).smallest_gap, -7, 1e-12);
  const Ellipsoid disc{{5, 5, 1}};
  const Configuration3 cross =
      pair_in_a_box<3>(40, disc, {0, 0, 0}, upright, disc, {0, 0, 0}, turned(pi / 2, {1, 0, 0}));
  expect_one_overlap(cross, 0, 1, {0, 0, 0});
  EXPECT_NEAR(exact_check(cross).smallest_gap, -6, 1e-12);
}

TEST(ExactCheck, CrossedAndContainedOverlaps) {
  for (const Configuration2& state :
       {pair_in_a_box<2>(40, {6, 1}, {1, 2}, 0.2, {6, 1}, {1.5, 1.8}, 0.2 + pi / 2),
        pair_in_a_box<2>(40, {8, 6}, {3, 3}, 0.5, {1, 0.5}, {4, 2}, 2)})
    expect_one_overlap(state, 0, 1, {0, 0});
  const Ellipsoid needle{{8, 0.5, 0.4}}, lump{{8, 7, 6}}, seed{{1, 0.5, 0.2}};
  const Quaternion across = turned(pi / 2, {0, 0.1, 1}), turn1 = turned(1, {1, 1, 0}),
                   turn2 = turned(2, {0, 1, 1});
  for (const Configuration3& state :
       {pair_in_a_box<3>(40, needle, {1, 2, 3}, upright, needle, {1.5, 1.8, 3.3}, across),
        pair_in_a_box<3>(40, lump, {3, 3, 3}, turn1, seed, {5, 2, 1}, turn2),
        pair_in_a_box<3>(40, seed, {5, 2, 1}, turn2, lump, {3, 3, 3}, turn1)})
    expect_one_overlap(state, 0, 1, {0, 0, 0});
}

TEST(ExactCheck, OverlapAcrossFaceEdgeAndCorner) {
  expect_one_overlap(pair_in_a_box<2>(20, {2, 1}, {9.5, 0}, 0, {2, 1}, {-8, 0}, 0), 0, 1, {1, 0});
  const auto expect_overlap = [](const Vec3& one, const Vec3& two, const Shift<3>& shift) {
    const Ellipsoid body{{2, 1, 1}};
    expect_one_overlap(pair_in_a_box<3>(20, body, one, upright, body, two, upright), 0, 1, shift);
  };
  expect_overlap({9.5, 0, 0}, {-8, 0, 0}, {1, 0, 0});
  expect_overlap({0, -9.5, 9.5}, {0, 9.5, -9.5}, {0, -1, 1});
  expect_overlap({9.5, 9.5, -9.5}, {-9.5, -9.5, 9.5}, {1, 1, -1});
}

// An ellipse of length 4 in a box of 3.9 by 20 runs into its own image; standing upright it does
// not, and is 2b = 2 between its flat sides. A needle of length 10 along a diagonal of the box, 8.6
// long, meets its own image along it, and no other; turned to the side it does not, and is
// 5 − 2 · 0.3 from the next image.
TEST(ExactCheck, OwnImages) {
  Configuration2 flat = empty_box<2>({3.9, 20});
  add(flat, {2, 1}, {1, 0}, 0);
  expect_one_overlap(flat, 0, 0, {1, 0});
  flat.angle[0] = pi / 2;
  EXPECT_TRUE(exact_check(flat).clean());
  EXPECT_NEAR(exact_check(flat).smallest_gap, 1.9, 1e-15);
  Configuration3 solid = empty_box<3>({5, 7, 20});
  add(solid, {{5, 0.3, 0.3}}, {1, 2, 3}, Quaternion::FromTwoVectors(Vec3::UnitX(), Vec3(5, -7, 0)));
  expect_one_overlap(solid, 0, 0, {1, -1, 0});
  solid.orientation[0] = turned(pi / 2, {0, 1, 0});
  EXPECT_TRUE(exact_check(solid).clean());
  EXPECT_NEAR(exact_check(solid).smallest_gap, 4.4, 1e-14);
}

// In a box 6 high, j is seen from i 2.9 above and, a little farther, 3.1 below. Needles along
// (1, −1) or (1, 0, −1) meet only in the second place, which a nearest-image search never looks at.
TEST(ExactCheck, OverlapThroughTheSecondNearestImage) {
  Configuration2 flat = empty_box<2>({30, 6});
  add(flat, {3, 0.2}, {-1, -1.5}, -pi / 4);
  add(flat, {3, 0.2}, {2, 1.4}, -pi / 4);
  expect_one_overlap(flat, 0, 1, {0, -1});
  Configuration3 solid = empty_box<3>({30, 30, 6});
  const Quaternion slanted = Quaternion::FromTwoVectors(Vec3::UnitX(), Vec3(1, 0, -1));
  add(solid, {{3, 0.2, 0.2}}, {-1, 0, -1.5}, slanted);
  add(solid, {{3, 0.2, 0.2}}, {2, 0, 1.4}, slanted);
  expect_one_overlap(solid, 0, 1, {0, 0, -1});
}

// A long needle in a cube shorter than itself meets through several images at once.
TEST(ExactCheck, OverlapsThroughSeveralImages) {
  Configuration3 cube = empty_box<3>({4, 4, 4});
  add(cube, {{6.5, 0.1, 0.1}}, {0, 0, 0}, turned(0.15, {0, 0, 1}));
  add(cube, {{0.4, 0.4, 0.4}}, {0, 0, 0}, upright);
  // The sphere's images at 4, −4 along x, moved by 4 sin 0.15 ≈ 0.6 from the needle, are clear of it;
  // with the needle level they are not: at −1, 0, 1 box lengths, as is its own image.
  ASSERT_EQ(exact_check(cube).overlaps.size(), 1u);
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

/// Returns how far apart parallel bodies touch along the axes: 2/√(A_kk).
Vec2 touching_distances(const Ellipse& shape, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {2 / std::hypot(c / shape.a, s / shape.b), 2 / std::hypot(s / shape.a, c / shape.b)};
}
Vec3 touching_distances(const Ellipsoid& shape, const Quaternion& turn) {
  const Vec3 inverse = shape_matrix({shape.semi_axes.cwiseInverse()}, turn).diagonal();
  return 2 * inverse.cwiseSqrt().cwiseInverse();
}

/// Places n × n (× n) parallel bodies `gap` farther apart along the axes than where they touch.
template <int Dim>
Configuration<Dim> touching_lattice(int n, const ParticleShape<Dim>& shape,
                                    const Orientation<Dim>& turn, double gap) {
  const Vec<Dim> spacing = touching_distances(shape, turn) + Vec<Dim>::Constant(gap);
  Configuration<Dim> state = empty_box<Dim>(n * spacing);
  const int particles = Dim == 2 ? n * n : n * n * n;
  for (int k = 0; k < particles; ++k) {
    Vec<Dim> cell;
    for (int axis = 0, rest = k; axis < Dim; ++axis, rest /= n) cell[axis] = rest % n;
    const Vec<Dim> site = cell + Vec<Dim>::Constant(0.5 - 0.5 * n);
    add(state, shape, site.cwiseProduct(spacing), turn);
  }
  return state;
}

/// Separated by 1e-13 nothing overlaps; short of touching by 1e-13 each particle overlaps with its
/// four or six neighbours. Positions are stored to 2e-15 here, so both are facts about the stored
/// doubles.
template <int Dim>
void expect_lattice_resolved(int n, const ParticleShape<Dim>& shape, const Orientation<Dim>& turn) {
  const ExactCheck<Dim> apart = exact_check(touching_lattice<Dim>(n, shape, turn, 1e-13));
  EXPECT_TRUE(apart.clean());
  EXPECT_GT(apart.smallest_gap, 0.5e-13);
  EXPECT_LT(apart.smallest_gap, 1.1e-13);
  const Configuration<Dim> closer = touching_lattice<Dim>(n, shape, turn, -1e-13);
  const ExactCheck<Dim> hit = exact_check(closer);
  EXPECT_EQ(hit.overlaps.size(), Dim * closer.size());
  EXPECT_LT(hit.smallest_gap, -0.5e-13);
  EXPECT_GT(hit.smallest_gap, -1.1e-13);
}

// The bodies are parallel and congruent, so η₁ of ellipsoids vanishes for all pairs.
TEST(ExactCheck, TouchingLatticeIsResolvedTo1em13) {
  for (const Ellipse& shape : {Ellipse{1, 1}, Ellipse{1.3, 1}})
    for (double angle : {0.0, pi / 6, 7.3}) expect_lattice_resolved<2>(6, shape, angle);
  for (const Ellipsoid& shape : {Ellipsoid{{1, 1, 1}}, Ellipsoid{{1.1, 1, 0.9}}})
    for (const Quaternion& turn : {upright, turned(0.2, {1, 2, 3})})
      expect_lattice_resolved<3>(4, shape, turn);
}

/// The tolerance is zero: one unit in the last place of a coordinate is the difference between an
/// overlap and none.
template <int Dim>
void expect_last_place_to_decide(const ParticleShape<Dim>& ball, const Orientation<Dim>& turn1,
                                 const Orientation<Dim>& turn2) {
  const Vec<Dim> below = Vec<Dim>::UnitX() * std::nextafter(2, 0);
  Configuration<Dim> state =
      pair_in_a_box<Dim>(16, ball, Vec<Dim>::Zero(), turn1, ball, below, turn2);
  expect_one_overlap<Dim>(state, 0, 1, Shift<Dim>::Zero());
  state.position[1].x() = std::nextafter(2, 3);
  EXPECT_TRUE(exact_check(state).clean());
}

TEST(ExactCheck, OneUnitInTheLastPlaceDecides) {
  for (double angle : {0.0, pi, 100.0}) expect_last_place_to_decide<2>({1, 1}, angle, 0);
  for (const Quaternion& turn : {upright, turned(1, {0, 0, 1}), turned(2, {3, 2, 1})})
    expect_last_place_to_decide<3>({{1, 1, 1}}, turn, upright);
}

TEST(ExactCheck, TouchingExactlyIsNoOverlap) {
  Configuration2 flat = empty_box<2>({16, 16});
  for (const Vec2& position : {Vec2(-1, 0), Vec2(5, 0), Vec2(-1, 2)})
    add(flat, {3, 1}, position, 0);
  EXPECT_TRUE(exact_check(flat).clean());
  EXPECT_NEAR(exact_check(flat).smallest_gap, 0, 1e-18);
  Configuration3 solid = empty_box<3>({16, 16, 16});
  for (const Vec3& position : {Vec3(-1, 0, 0), Vec3(5, 0, 0), Vec3(-1, 2, 0), Vec3(-1, 0, -4)})
    add(solid, {{3, 1, 2}}, position, upright);
  EXPECT_TRUE(exact_check(solid).clean());
  EXPECT_NEAR(exact_check(solid).smallest_gap, 0, 1e-18);
}

/// Random positions, so that there are overlaps of every kind, also through several images.
Configuration2 random_state(int n, double x, double y, std::uint64_t seed) {
  Stream draw(seed, Purpose::tests);
  Configuration2 state = empty_box<2>({x, y});
  for (int i = 0; i < n; ++i) {
    const double b = draw.uniform(0.2, 1);
    const Ellipse shape{b * draw.uniform(1, 5), b};
    const Vec2 place{draw.uniform(-0.5, 0.5) * x, draw.uniform(-0.5, 0.5) * y};
    add(state, shape, place, draw.uniform(-9, 9));
  }
  return state;
}
Configuration3 random_state(int n, const Vec3& lengths, double aspect, std::uint64_t seed) {
  Stream draw(seed, Purpose::tests);
  Configuration3 state = empty_box<3>(lengths);
  for (int i = 0; i < n; ++i) {
    const Vec3 place{draw.uniform(-0.5, 0.5), draw.uniform(-0.5, 0.5), draw.uniform(-0.5, 0.5)};
    const double size = draw.uniform(0.3, 1);
    const Ellipsoid shape = scaled(random_ellipsoid(draw, aspect), size);
    add(state, shape, place.cwiseProduct(lengths), random_orientation(draw));
  }
  return state;
}

template <int Dim>
void expect_cells_to_find_all(const std::vector<Configuration<Dim>>& states) {
  for (const Configuration<Dim>& state : states) {
    const ExactCheck<Dim> all_pairs = exact_check(state);
    EXPECT_GT(all_pairs.overlaps.size(), 0u);
    expect_equal(all_pairs, exact_check(state, 0));
  }
}

TEST(ExactCheck, CellsFindWhatAllPairsFind) {
  expect_cells_to_find_all<2>({
      random_state(3000, 110, 90, 1),  // dense, many cells
      random_state(400, 200, 12, 2),   // one or two cells across
      random_state(60, 6, 7, 3),       // several images of each pair
      random_state(200, 600, 500, 4),  // dilute
  });
  expect_cells_to_find_all<3>({
      random_state(1000, {40, 30, 20}, 2, 1),  // many cells
      random_state(200, {60, 12, 7}, 4, 2),    // one or two cells across
      random_state(20, {6, 7, 5}, 20, 3),      // several images of each pair
      random_state(600, {60, 70, 80}, 20, 4),  // dilute
  });
}

/// Compares with the support gap in double precision over a plain scan of images, which has other
/// code and another formula.
template <int Dim>
void expect_overlaps_by_the_support_gap(const Configuration<Dim>& state) {
  const auto gap = [&](std::size_t i, std::size_t j, const Vec<Dim>& d) {
    return support_gap(state.shape[i], state.pose(i), state.shape[j], state.pose(j), d).gap;
  };
  EXPECT_GT(expect_overlaps_of_a_scan(state, exact_check(state), 3, gap), 100u);
}

// The longest ellipsoids are longer than the box.
TEST(ExactCheck, EqualsAScanWithTheSupportGap) {
  expect_overlaps_by_the_support_gap(random_state(150, 25, 9, 5));
  const Configuration3 state = random_state(30, {5, 4.5, 4}, 40, 5);
  EXPECT_GT(2 * largest_circumradius(state), 5);
  expect_overlaps_by_the_support_gap(state);
}

/// In a wide box the smallest gap is the support gap of the pair. Returns whether this was
/// compared, as the pair is disjoint and near.
template <int Dim>
bool compare_smallest_gap(const ParticleShape<Dim>& one, const Orientation<Dim>& turn1,
                          const ParticleShape<Dim>& two, const Orientation<Dim>& turn2,
                          const Vec<Dim>& d) {
  const double gap = support_gap(one, turn1, two, turn2, d).gap;
  if (gap <= 0 || gap >= one.circumradius()) return false;
  const Configuration<Dim> state =
      pair_in_a_box<Dim>(200, one, Vec<Dim>::Zero(), turn1, two, d, turn2);
  const double reach = one.circumradius() + two.circumradius();
  EXPECT_NEAR(exact_check(state).smallest_gap, gap, 1e-14 * reach);
  return true;
}

TEST(ExactCheck, SmallestGapIsTheSupportGapOfDisjointPairs) {
  Stream draw(6, Purpose::tests);
  int compared = 0;
  for (int k = 0; k < 3000; ++k) {
    const Ellipse one{draw.uniform(1, 20), 1}, two{draw.uniform(0.1, 5), 0.1};
    const double angle1 = draw.uniform(-pi, pi), angle2 = draw.uniform(-pi, pi);
    const Vec2 d = (one.a + two.a) * Vec2{draw.uniform(-1, 1), draw.uniform(-1, 1)};
    compared += compare_smallest_gap<2>(one, angle1, two, angle2, d);
  }
  EXPECT_GT(compared, 1000);
}

TEST(ExactCheckOfSolids, SmallestGapIsTheSupportGapOfDisjointPairs) {
  Stream draw(6, Purpose::tests);
  int compared = 0;
  for (int k = 0; k < 3000; ++k) {
    const Ellipsoid one = random_ellipsoid(draw, 20);
    const Ellipsoid two = scaled(random_ellipsoid(draw, 20), 0.1);
    const Quaternion turn1 = random_orientation(draw), turn2 = random_orientation(draw);
    const Vec3 d = random_vector(draw, 0, 1.5 * (one.circumradius() + two.circumradius()));
    compared += compare_smallest_gap<3>(one, turn1, two, turn2, d);
  }
  EXPECT_GT(compared, 1000);
}

template <int Dim, class Spoil>
void expect_refused(Configuration<Dim> state, Spoil&& spoil) {
  spoil(state);
  EXPECT_THROW(exact_check(state), InvariantError);
}

TEST(ExactCheck, ImpossibleNumbersAreRefused) {
  const Configuration2 good = random_state(3, 20, 20, 7);
  expect_refused(good, [](auto& bad) { bad.position[1].x() = std::nan(""); });
  expect_refused(good, [](auto& bad) { bad.position[1].y() = 1e9; });
  expect_refused(good, [](auto& bad) { bad.angle[2] = infinity; });
  expect_refused(good, [](auto& bad) { bad.shape[0] = {1, 2}; });
  expect_refused(good, [](auto& bad) { bad.shape[0] = {1, 0}; });
  expect_refused(good, [](auto& bad) { bad.shape[0] = {1e6, 1}; });
}

TEST(ExactCheckOfSolids, ImpossibleNumbersAreRefused) {
  const Configuration3 good = random_state(3, {20, 20, 20}, 3, 7);
  EXPECT_NO_THROW(exact_check(good));
  expect_refused(good, [](auto& bad) { bad.position[1].z() = std::nan(""); });
  expect_refused(good, [](auto& bad) { bad.position[1].y() = 1e9; });
  expect_refused(good, [](auto& bad) { bad.orientation[2].x() = infinity; });
  expect_refused(good, [](auto& bad) { bad.orientation[2].coeffs() *= 1.01; });
  expect_refused(good, [](auto& bad) { bad.shape[0].semi_axes[2] = 0; });
  expect_refused(good, [](auto& bad) { bad.shape[0].semi_axes[1] = std::nan(""); });
  expect_refused(good, [](auto& bad) { bad.shape[0].semi_axes[0] = 1e6; });
}

}  // namespace
}  // namespace vitrel

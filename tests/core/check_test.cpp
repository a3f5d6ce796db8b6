#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/contact/ellipse_gap.h"
#include "core/error.h"
#include "core/random/stream.h"
#include "core/special_values.h"
#include "tests/support/exact_checks.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;

void add(Configuration2& configuration, const Ellipse& shape, const Vec2& position, double angle) {
  const std::size_t i = configuration.size();
  configuration.resize(i + 1);
  configuration.shape[i] = shape;
  configuration.position[i] = position;
  configuration.angle[i] = angle;
}

TEST(ExactCheck, EmptyAndLonelyStatesAreClean) {
  EXPECT_TRUE(exact_check(empty_box<2>({5, 5})).clean());
  Configuration2 one = empty_box<2>({20, 20});
  add(one, {2, 1}, {0, 0}, 0.3);
  const ExactCheck<2> check = exact_check(one);
  EXPECT_TRUE(check.clean());
  EXPECT_EQ(check.smallest_gap, infinity);
  EXPECT_EQ(check.pairs_examined, 0u);
}

// Parallel flat sides, 2b = 2 apart less 0.1: the depth is the way back.
TEST(ExactCheck, OrdinaryOverlap) {
  Configuration2 configuration = empty_box<2>({40, 40});
  add(configuration, {3, 1}, {-10, -10}, 0);
  add(configuration, {3, 1}, {5, 5}, 0);
  add(configuration, {3, 1}, {5, 6.9}, 0);
  expect_one_overlap(configuration, 1, 2, {0, 0});
  EXPECT_NEAR(exact_check(configuration).smallest_gap, -0.1, 1e-15);
}

TEST(ExactCheck, CrossedOverlap) {
  Configuration2 configuration = empty_box<2>({40, 40});
  add(configuration, {6, 1}, {1, 2}, 0.2);
  add(configuration, {6, 1}, {1.5, 1.8}, 0.2 + pi / 2);
  expect_one_overlap(configuration, 0, 1, {0, 0});
}

// Concentric perpendicular ellipses: along n they are h₁ + h₂ deep, a + b along the axes and more
// in between (2 √((a² + b²)/2) at 45°).
TEST(ExactCheck, DepthOfACrossIsTheShortestWayOut) {
  Configuration2 configuration = empty_box<2>({40, 40});
  add(configuration, {6, 1}, {0, 0}, 0);
  add(configuration, {6, 1}, {0, 0}, pi / 2);
  EXPECT_NEAR(exact_check(configuration).smallest_gap, -7, 1e-12);
}

TEST(ExactCheck, ContainedOverlap) {
  Configuration2 configuration = empty_box<2>({40, 40});
  add(configuration, {8, 6}, {3, 3}, 0.5);
  add(configuration, {1, 0.5}, {4, 2}, 2);
  expect_one_overlap(configuration, 0, 1, {0, 0});
}

TEST(ExactCheck, OverlapAcrossTheFace) {
  Configuration2 configuration = empty_box<2>({20, 20});
  add(configuration, {2, 1}, {9.5, 0}, 0);
  add(configuration, {2, 1}, {-8, 0}, 0);
  expect_one_overlap(configuration, 0, 1, {1, 0});
}

// A particle of length 4 in a box of 3.9 by 20 runs into its own image; standing upright it does
// not.
TEST(ExactCheck, OwnImageInABoxShorterThanOneParticle) {
  Configuration2 configuration = empty_box<2>({3.9, 20});
  add(configuration, {2, 1}, {1, 0}, 0);
  expect_one_overlap(configuration, 0, 0, {1, 0});
  configuration.angle[0] = pi / 2;
  EXPECT_TRUE(exact_check(configuration).clean());
  // 2b = 2 between its flat sides.
  EXPECT_NEAR(exact_check(configuration).smallest_gap, 1.9, 1e-15);
}

// In a box 6 high, j is seen from i at (3, 2.9) and, a little farther, at (3, −3.1). Needles along
// (1, −1) meet only in the second place, which a nearest-image search never looks at.
TEST(ExactCheck, OverlapThroughTheSecondNearestImage) {
  Configuration2 configuration = empty_box<2>({30, 6});
  add(configuration, {3, 0.2}, {-1, -1.5}, -pi / 4);
  add(configuration, {3, 0.2}, {2, 1.4}, -pi / 4);
  expect_one_overlap(configuration, 0, 1, {0, -1});
}

/// n × n parallel ellipses at `angle` in a box whose sides are n times the touching distances along
/// x and y, 2/√(A_xx) and 2/√(A_yy), plus n times `gap`.
Configuration2 touching_lattice(int n, const Ellipse& shape, double angle, double gap) {
  const double c = std::cos(angle), s = std::sin(angle);
  const double x = 2 / std::hypot(c / shape.a, s / shape.b) + gap;
  const double y = 2 / std::hypot(s / shape.a, c / shape.b) + gap;
  Configuration2 configuration = empty_box<2>({n * x, n * y});
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      add(configuration, shape, {(i + 0.5) * x - 0.5 * n * x, (j + 0.5) * y - 0.5 * n * y}, angle);
  return configuration;
}

// Separated by 1e-13 nothing overlaps; short of touching by 1e-13 each particle overlaps with its
// four neighbours. Positions are stored to 2e-15 here, so both are facts about the stored doubles.
TEST(ExactCheck, TouchingLatticeIsResolvedTo1em13) {
  const int n = 6;
  for (const Ellipse& shape : {Ellipse{1, 1}, Ellipse{1.3, 1}}) {
    for (double angle : {0.0, pi / 6, 7.3}) {
      const ExactCheck<2> apart = exact_check(touching_lattice(n, shape, angle, 1e-13));
      EXPECT_TRUE(apart.clean());
      EXPECT_GT(apart.smallest_gap, 0.5e-13);
      EXPECT_LT(apart.smallest_gap, 1.1e-13);
      const ExactCheck<2> hit = exact_check(touching_lattice(n, shape, angle, -1e-13));
      EXPECT_EQ(hit.overlaps.size(), 2u * n * n);
      EXPECT_LT(hit.smallest_gap, -0.5e-13);
      EXPECT_GT(hit.smallest_gap, -1.1e-13);
    }
  }
}

// Tolerance zero: one unit in the last place of a coordinate is the difference between an overlap
// and none; touching exactly is none.
TEST(ExactCheck, OneUnitInTheLastPlaceDecides) {
  for (double angle : {0.0, pi, 100.0}) {
    const Ellipse disk{1, 1};
    Configuration2 configuration = empty_box<2>({16, 16});
    add(configuration, disk, {0, 0}, angle);
    add(configuration, disk, {std::nextafter(2, 0), 0}, 0);
    expect_one_overlap(configuration, 0, 1, {0, 0});
    configuration.position[1].x() = std::nextafter(2, 3);
    EXPECT_TRUE(exact_check(configuration).clean());
  }
  Configuration2 touching = empty_box<2>({16, 16});
  add(touching, {3, 1}, {-1, 0}, 0);
  add(touching, {3, 1}, {5, 0}, 0);
  add(touching, {3, 1}, {-1, 2}, 0);
  EXPECT_TRUE(exact_check(touching).clean());
  EXPECT_NEAR(exact_check(touching).smallest_gap, 0, 1e-18);
}

/// Random positions, so that there are overlaps of every kind, also through several images.
Configuration2 random_state(int n, double x, double y, std::uint64_t seed) {
  Stream draw(seed, Purpose::tests);
  Configuration2 configuration = empty_box<2>({x, y});
  for (int i = 0; i < n; ++i) {
    const double b = draw.uniform(0.2, 1);
    const Ellipse shape{b * draw.uniform(1, 5), b};
    const Vec2 place{draw.uniform(-0.5, 0.5) * x, draw.uniform(-0.5, 0.5) * y};
    add(configuration, shape, place, draw.uniform(-9, 9));
  }
  return configuration;
}

TEST(ExactCheck, CellsFindWhatAllPairsFind) {
  const Configuration2 states[] = {
      random_state(3000, 110, 90, 1),  // dense, many cells
      random_state(400, 200, 12, 2),   // one or two cells across
      random_state(60, 6, 7, 3),       // several images of each pair
      random_state(200, 600, 500, 4),  // dilute
  };
  for (const Configuration2& state : states) {
    const ExactCheck<2> all_pairs = exact_check(state);
    EXPECT_GT(all_pairs.overlaps.size(), 0u);
    expect_equal(all_pairs, exact_check(state, 0));
  }
}

// Against the support gap in double precision over a plain scan of images: other code, other
// formula.
TEST(ExactCheck, EqualsAScanWithTheSupportGap) {
  const Configuration2 state = random_state(150, 25, 9, 5);
  const auto gap = [&](std::size_t i, std::size_t j, const Vec2& d) {
    return support_gap(state.shape[i], state.angle[i], state.shape[j], state.angle[j], d).gap;
  };
  EXPECT_GT(expect_overlaps_of_a_scan(state, exact_check(state), 3, gap), 100u);
}

// Pair by pair in a wide box, the smallest gap is the support gap of the pair.
TEST(ExactCheck, SmallestGapIsTheSupportGapOfDisjointPairs) {
  Stream draw(6, Purpose::tests);
  int compared = 0;
  for (int k = 0; k < 3000; ++k) {
    const Ellipse one{draw.uniform(1, 20), 1}, two{draw.uniform(0.1, 5), 0.1};
    const double reach = one.a + two.a;
    const double angle1 = draw.uniform(-pi, pi), angle2 = draw.uniform(-pi, pi);
    const Vec2 d = reach * Vec2{draw.uniform(-1, 1), draw.uniform(-1, 1)};
    const double gap = support_gap(one, angle1, two, angle2, d).gap;
    if (gap <= 0 || gap >= one.a) continue;
    ++compared;
    Configuration2 configuration = empty_box<2>({200, 200});
    add(configuration, one, {0, 0}, angle1);
    add(configuration, two, d, angle2);
    EXPECT_NEAR(exact_check(configuration).smallest_gap, gap, 1e-14 * reach);
  }
  EXPECT_GT(compared, 1000);
}

TEST(ExactCheck, ImpossibleNumbersAreRefused) {
  const Configuration2 good = random_state(3, 20, 20, 7);
  Configuration2 bad = good;
  bad.position[1].x() = std::nan("");
  EXPECT_THROW(exact_check(bad), InvariantError);
  bad = good;
  bad.position[1].y() = 1e9;
  EXPECT_THROW(exact_check(bad), InvariantError);
  bad = good;
  bad.angle[2] = infinity;
  EXPECT_THROW(exact_check(bad), InvariantError);
  bad = good;
  bad.shape[0] = {1, 2};
  EXPECT_THROW(exact_check(bad), InvariantError);
  bad = good;
  bad.shape[0] = {1, 0};
  EXPECT_THROW(exact_check(bad), InvariantError);
  bad = good;
  bad.shape[0] = {1e6, 1};
  EXPECT_THROW(exact_check(bad), InvariantError);
}

}  // namespace
}  // namespace vitrel

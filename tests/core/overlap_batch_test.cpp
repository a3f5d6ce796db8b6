// The overlap batches of ellipses and ellipsoids agree with the exact criterion in 80-bit
// arithmetic and the support gap.

#include "core/contact/ellipse_overlap_batch.h"
#include "core/contact/ellipsoid_overlap_batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/random/stream.h"
#include "core/tolerances.h"
#include "tests/support/overlap_criteria.h"
#include "tests/support/resting_bodies.h"
#include "tests/support/solids.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;

/// The pairs of a test have ratios of semi-axes, and of the sizes √(ab) or (abc)^⅓, from 1 up to
/// these.
using Class = FreePathClass;

/// A third each: anywhere within the circumcircles, around the contact distance, and at the contact
/// distance times 1 ± 10⁻¹ … 10⁻¹⁶. One axis in eight is along x or y.
PosedPair random_pair(Stream& draw, const Class& at) {
  const auto ellipse = [&](double size) -> Ellipse {
    const double root = std::sqrt(std::pow(at.largest_aspect_ratio, draw.uniform()));
    return {size * root, size / root};
  };
  const auto angle = [&] {
    return draw.below(8) == 0 ? 0.5 * pi * static_cast<double>(draw.below(4))
                              : draw.uniform(-20, 20);
  };
  const double ratio = std::pow(at.largest_size_ratio, draw.uniform());
  const bool larger_first = draw.below(2) == 0;
  PosedPair pair{ellipse(larger_first ? ratio : 1), ellipse(larger_first ? 1 : ratio), angle(),
                 angle(), Vec2::Zero()};
  const Vec2 e = direction(draw.uniform(-pi, pi));
  const std::uint64_t kind = draw.below(3);
  const double contact = contact_distance_of(pair.with(e));
  const double sign = draw.below(2) == 0 ? 1 : -1;
  const double offset = sign * std::pow(10, -draw.uniform(1, 16));
  pair.d = kind == 0   ? draw.uniform() * pair.extent() * e
           : kind == 1 ? draw.uniform(0, 2) * contact * e
                       : contact * (1 + offset) * e;
  return pair;
}

/// In space one pair in eight is parallel.
PosedSolids random_solids(Stream& draw, const Class& at) {
  const double ratio = std::pow(at.largest_size_ratio, draw.uniform(-1, 1));
  PosedSolids pair{scaled(random_ellipsoid(draw, at.largest_aspect_ratio), ratio),
                   random_ellipsoid(draw, at.largest_aspect_ratio), random_orientation(draw),
                   random_orientation(draw), Vec3::Zero()};
  if (draw.below(8) == 0) pair.turn2 = pair.turn1;
  const Vec3 e = random_direction(draw);
  const double contact = contact_distance_of(pair.with(e));
  const double sign = draw.below(2) == 0 ? 1 : -1;
  const double offset = sign * std::pow(10, -draw.uniform(1, 16));
  const std::uint64_t kind = draw.below(3);
  pair.d = kind == 0   ? draw.uniform() * pair.extent() * e
           : kind == 1 ? draw.uniform(0, 2) * contact * e
                       : contact * (1 + offset) * e;
  return pair;
}

bool disjoint(const PosedPair& pair) {
  using Real = long double;
  const auto axes = [](const Ellipse& shape, double angle) -> EllipseAxes<Real> {
    return {shape.a, shape.b, std::cos(Real(angle)), std::sin(Real(angle))};
  };
  return vieillard_baron<Real>(axes(pair.one, pair.turn1), axes(pair.two, pair.turn2), pair.d.x(),
                               pair.d.y())
      .disjoint_or_touching();
}
bool disjoint(const PosedSolids& pair) {
  using Real = long double;
  return ellipsoid_eta<Real>({pair.one, pair.turn1}, {pair.two, pair.turn2}, pair.d.cast<Real>())
      .disjoint_or_touching();
}

double margin(const PosedPair& pair) {
  return tolerance::contact_gap(std::max({pair.one.a, pair.two.a, pair.d.cwiseAbs().maxCoeff()}));
}
double margin(const PosedSolids& pair) {
  return tolerance::contact_gap(pair.extent());
}

/// What the coordinates' rounding may do to a gap.
double rounding(const PosedPair& pair) {
  return 1e-14 * (pair.extent() + pair.d.norm());
}
double rounding(const PosedSolids& pair) {
  return 1e-14 * pair.extent();
}

template <class Shape, int Dim>
bool looks_clear(const PosedBodies<Dim>& pair, int lane, std::uint64_t& scalar_tests) {
  using Bodies = RestingBodies<Shape>;
  return all_look_clear<Bodies>(Bodies::body(Shape(pair.one), pair.turn1),
                                {Bodies::body(Shape(pair.two), pair.turn2)}, std::vector{pair.d},
                                margin(pair), lane, scalar_tests);
}

/// Clear is never said of a pair that overlaps, with tolerance zero; and overlap never of a pair
/// farther apart than the margin, but for rounding. Neither exchanging the bodies nor the general
/// algorithm, which runs for the plain shape, changes an answer, but within that rounding of the
/// margin. Returns how many pairs were decided alone.
template <class Plain, class RandomPair>
std::uint64_t expect_right_about_every_pair(int pairs, RandomPair&& random_pair) {
  using Shape = ParticleShape<Plain::dimension>;
  int clear = 0, near = 0;
  std::uint64_t scalar_tests = 0;
  for (int k = 0; k < pairs; ++k) {
    const PosedBodies<Plain::dimension> pair = random_pair();
    const bool answer = looks_clear<Shape>(pair, k % simd_width, scalar_tests);
    clear += answer;
    const double gap = gap_of(pair).gap;
    near += std::abs(gap) < 1e-9;
    if (answer) {
      EXPECT_TRUE(disjoint(pair)) << pair;
      EXPECT_GT(gap, margin(pair) - rounding(pair)) << pair;
    } else {
      EXPECT_LT(gap, margin(pair) + rounding(pair)) << pair;
    }
    std::uint64_t uncounted = 0;
    if (looks_clear<Shape>(pair.swapped(), k % simd_width, scalar_tests) != answer ||
        looks_clear<Plain>(pair, k % simd_width, uncounted) != answer) {
      EXPECT_NEAR(gap, margin(pair), rounding(pair)) << pair;
    }
    if (testing::Test::HasFailure()) break;
  }
  // The comparison means something: both answers are frequent, and many pairs touch.
  EXPECT_GT(clear, pairs / 4);
  EXPECT_LT(clear, 3 * pairs / 4);
  EXPECT_GT(near, pairs / 10);
  return scalar_tests;
}

class OverlapBatchOfEllipses : public testing::TestWithParam<Class> {};

TEST_P(OverlapBatchOfEllipses, IsRightAboutEveryPair) {
  Stream draw(61, Purpose::tests);
  const std::uint64_t scalar_tests = expect_right_about_every_pair<PlainEllipse>(
      100'000, [&] { return random_pair(draw, GetParam()); });
  if (GetParam().largest_aspect_ratio > 1) {
    EXPECT_GT(scalar_tests, 1'000u);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, OverlapBatchOfEllipses,
                         testing::Values(Class{1, 1}, Class{1, 100}, Class{2, 1}, Class{6, 1},
                                         Class{10, 3}, Class{100, 1}, Class{100, 100},
                                         Class{1000, 1}));

class OverlapBatchOfEllipsoids : public testing::TestWithParam<Class> {};

TEST_P(OverlapBatchOfEllipsoids, IsRightAboutEveryPair) {
  Stream draw(71, Purpose::tests);
  expect_right_about_every_pair<PlainEllipsoid>(30'000,
                                                [&] { return random_solids(draw, GetParam()); });
}

INSTANTIATE_TEST_SUITE_P(Shapes, OverlapBatchOfEllipsoids,
                         testing::Values(Class{1, 1}, Class{1, 100}, Class{2, 1}, Class{6, 1},
                                         Class{10, 3}, Class{100, 1}, Class{100, 100}));

// The same pair in another lane, beside others and beside nobody.
TEST(EllipseOverlapBatch, AnswersOfAGroupAreThoseOfItsPairs) {
  Stream draw(62, Purpose::tests);
  int clear = 0;
  constexpr int groups = 20'000;
  for (int k = 0; k < groups; ++k) {
    const PosedPair first = random_pair(draw, {6, 3});
    const EllipseOverlapBatch batch({first.one, direction(first.turn1)}, nullptr, 1e-12);
    EllipseBatch group;
    bool each_clear = true;
    std::uint64_t alone_in_group = 0, scalar_tests = 0;
    for (int lane = 0; lane < simd_width; ++lane) {
      if (draw.below(3) == 0) continue;
      const PosedPair other = random_pair(draw, {6, 3});
      const Vec2 place = other.d * (1.2 * (first.one.a + other.two.a) / other.extent());
      group.set(lane, other.two, place, direction(other.turn2));
      EllipseBatch single;
      single.set((lane + k) % simd_width, other.two, place, direction(other.turn2));
      each_clear =
          each_clear &&
          batch.may_be_clear_of(single, Vec2::Zero(), EllipseOverlapBatch::all_lanes, scalar_tests);
    }
    const bool answer =
        batch.may_be_clear_of(group, Vec2::Zero(), EllipseOverlapBatch::all_lanes, alone_in_group);
    ASSERT_EQ(answer, each_clear);
    if (answer) {
      ASSERT_EQ(alone_in_group, scalar_tests);
    }
    clear += answer;
  }
  EXPECT_GT(clear, groups / 10);
  EXPECT_LT(clear, groups * 9 / 10);
}

// Nearly all pairs at random places within the circumcircles are decided in batches: what the speed
// rests on.
TEST(EllipseOverlapBatch, FewPairsAreLeftToBeDecidedAlone) {
  for (const double kappa : {1.5, 2., 6., 100.}) {
    Stream draw(63, Purpose::tests);
    const Ellipse shape{std::sqrt(kappa), 1 / std::sqrt(kappa)};
    constexpr int pairs = 100'000;
    std::uint64_t scalar_tests = 0;
    for (int k = 0; k < pairs; ++k) {
      const double distance = 2 * shape.a * std::sqrt(draw.uniform());
      const PosedPair pair{shape, shape, draw.uniform(0, pi), draw.uniform(0, pi),
                           distance * direction(draw.uniform(-pi, pi))};
      looks_clear<Ellipse>(pair, 0, scalar_tests);
    }
    EXPECT_LT(static_cast<double>(scalar_tests), 1e-4 * pairs) << "κ = " << kappa;
  }
}

// Two disks are settled by their circles.
TEST(EllipseOverlapBatch, DisksAreNeverLeft) {
  Stream draw(64, Purpose::tests);
  std::uint64_t scalar_tests = 0;
  for (int k = 0; k < 10'000; ++k) {
    const Ellipse one{draw.uniform(0.1, 3), 0}, two{draw.uniform(0.1, 3), 0};
    const PosedPair pair{{one.a, one.a}, {two.a, two.a}, 0.3, 1, Vec2(draw.uniform(0, 5), 0.1)};
    const bool answer = looks_clear<Ellipse>(pair, 1, scalar_tests);
    EXPECT_EQ(answer, pair.d.norm() > one.a + two.a);
  }
  EXPECT_EQ(scalar_tests, 0u);
}

// Many others at once: the answer is that of all pairs.
TEST(EllipsoidOverlapBatch, AnswersForManyAreThoseOfTheirPairs) {
  Stream draw(72, Purpose::tests);
  int clear = 0;
  constexpr int rounds = 5'000;
  for (int k = 0; k < rounds; ++k) {
    const PosedSolids first = random_solids(draw, {6, 3});
    std::vector<OrientedEllipsoid> others;
    std::vector<Vec3> places;
    bool each_clear = true;
    std::uint64_t scalar_tests = 0;
    for (int m = 0; m < 7; ++m) {
      const PosedSolids other = random_solids(draw, {6, 3});
      others.emplace_back(other.two, other.turn2);
      places.push_back(1.5 * other.d);
      each_clear = each_clear && all_look_clear<RestingBodies<Ellipsoid>>(
                                     {first.one, first.turn1}, {others.back()},
                                     std::vector{places.back()}, 1e-12, m, scalar_tests);
    }
    const bool answer = all_look_clear<RestingBodies<Ellipsoid>>({first.one, first.turn1}, others,
                                                                 places, 1e-12, k, scalar_tests);
    ASSERT_EQ(answer, each_clear);
    clear += answer;
  }
  EXPECT_GT(clear, rounds / 20);
  EXPECT_LT(clear, rounds * 9 / 10);
}

// Nearly all pairs at random places within the circumspheres are decided in batches: what the speed rests on.
TEST(EllipsoidOverlapBatch, FewPairsAreLeftToBeDecidedAlone) {
  for (const Ellipsoid& shape : {prolate(1.5), prolate(3), oblate(3), prolate(10)}) {
    Stream draw(73, Purpose::tests);
    constexpr int pairs = 30'000;
    std::uint64_t scalar_tests = 0;
    for (int k = 0; k < pairs; ++k) {
      const double distance = 2 * shape.circumradius() * std::cbrt(draw.uniform());
      looks_clear<Ellipsoid>(
          PosedSolids{shape, shape, random_orientation(draw), random_orientation(draw),
                      distance * random_direction(draw)},
          0, scalar_tests);
    }
    EXPECT_LT(static_cast<double>(scalar_tests), 2e-3 * pairs) << shape.semi_axes.transpose();
  }
}

}  // namespace
}  // namespace vitrel

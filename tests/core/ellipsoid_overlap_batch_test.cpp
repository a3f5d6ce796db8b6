// The overlap batch in space against the exact criterion in 80-bit arithmetic and the support gap.

#include "core/contact/ellipsoid_overlap_batch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/contact/ellipsoid_eta.h"
#include "core/contact/perram_wertheim.h"
#include "core/tolerances.h"
#include "tests/support/posed_solids.h"
#include "tests/support/resting_bodies.h"
#include "tests/support/solids.h"

namespace vitrel {
namespace {

/// The longest ratio of semi-axes, and of the sizes (a b c)^⅓.
struct Class {
  double largest_aspect_ratio, largest_size_ratio;
};
void PrintTo(const Class& at, std::ostream* out) {
  *out << "aspect ratios to " << at.largest_aspect_ratio
       << ", sizes to 1:" << at.largest_size_ratio;
}

double margin(const PosedSolids& pair) {
  return tolerance::contact_gap(pair.extent());
}

/// A third each: anywhere within the circumspheres, around the contact distance, and at the contact distance times
/// 1 ± 10⁻¹ … 10⁻¹⁶. One pair in eight is parallel.
PosedSolids random_pair(Stream& draw, const Class& at) {
  const double ratio = std::pow(at.largest_size_ratio, draw.uniform(-1, 1));
  PosedSolids pair{scaled(random_ellipsoid(draw, at.largest_aspect_ratio), ratio),
                   random_ellipsoid(draw, at.largest_aspect_ratio), random_orientation(draw),
                   random_orientation(draw), Vec3::Zero()};
  if (draw.below(8) == 0) pair.turn2 = pair.turn1;
  const Vec3 e = random_direction(draw);
  const double contact = contact_distance(pair.one, pair.turn1, pair.two, pair.turn2, e);
  const double sign = draw.below(2) == 0 ? 1 : -1;
  const double offset = sign * std::pow(10, -draw.uniform(1, 16));
  const std::uint64_t kind = draw.below(3);
  pair.d = kind == 0   ? draw.uniform() * pair.extent() * e
           : kind == 1 ? draw.uniform(0, 2) * contact * e
                       : contact * (1 + offset) * e;
  return pair;
}

bool disjoint(const PosedSolids& pair) {
  using Real = long double;
  return ellipsoid_eta<Real>({pair.one, pair.turn1}, {pair.two, pair.turn2}, pair.d.cast<Real>())
      .disjoint_or_touching();
}

template <class Shape>
bool looks_clear(const PosedSolids& pair, int lane, std::uint64_t& scalar_tests) {
  using Bodies = RestingBodies<Shape>;
  return all_look_clear<Bodies>(Bodies::body(Shape(pair.one), pair.turn1),
                                {Bodies::body(Shape(pair.two), pair.turn2)}, std::vector{pair.d},
                                margin(pair), lane, scalar_tests);
}
bool looks_clear(const PosedSolids& pair, int lane, std::uint64_t& scalar_tests) {
  return looks_clear<Ellipsoid>(pair, lane, scalar_tests);
}

/// What the coordinates' rounding may do to a gap.
double rounding(const PosedSolids& pair) {
  return 1e-14 * pair.extent();
}

class EllipsoidOverlapBatchOf : public testing::TestWithParam<Class> {};

// Clear is never said of a pair that overlaps, with tolerance zero; and overlap never of a pair farther apart than the
// margin, but for rounding. Changing places changes nothing, but within that rounding of the margin.
TEST_P(EllipsoidOverlapBatchOf, IsRightAboutEveryPair) {
  Stream draw(71, Purpose::tests);
  constexpr int pairs = 30'000;
  int clear = 0, near = 0;
  std::uint64_t scalar_tests = 0;
  for (int k = 0; k < pairs; ++k) {
    const PosedSolids pair = random_pair(draw, GetParam());
    const bool answer = looks_clear(pair, k % simd_width, scalar_tests);
    clear += answer;
    const double gap = support_gap(pair.one, pair.turn1, pair.two, pair.turn2, pair.d).gap;
    near += std::abs(gap) < 1e-9;
    if (answer) {
      ASSERT_TRUE(disjoint(pair)) << pair;
      ASSERT_GT(gap, margin(pair) - rounding(pair)) << pair;
    } else {
      ASSERT_LT(gap, margin(pair) + rounding(pair)) << pair;
    }
    if (looks_clear(pair.swapped(), k % simd_width, scalar_tests) != answer ||
        looks_clear<PlainEllipsoid>(pair, k % simd_width, scalar_tests) != answer) {
      ASSERT_NEAR(gap, margin(pair), rounding(pair)) << pair;
    }
  }
  // The comparison means something: both answers are frequent, and many pairs touch.
  EXPECT_GT(clear, pairs / 4);
  EXPECT_LT(clear, 3 * pairs / 4);
  EXPECT_GT(near, pairs / 10);
}

INSTANTIATE_TEST_SUITE_P(Shapes, EllipsoidOverlapBatchOf,
                         testing::Values(Class{1, 1}, Class{1, 100}, Class{2, 1}, Class{6, 1},
                                         Class{10, 3}, Class{100, 1}, Class{100, 100}));

// Many others at once: the answer is that of all pairs.
TEST(EllipsoidOverlapBatch, AnswersForManyAreThoseOfTheirPairs) {
  Stream draw(72, Purpose::tests);
  int clear = 0;
  constexpr int rounds = 5'000;
  for (int k = 0; k < rounds; ++k) {
    const PosedSolids first = random_pair(draw, {6, 3});
    std::vector<OrientedEllipsoid> others;
    std::vector<Vec3> places;
    bool each_clear = true;
    std::uint64_t scalar_tests = 0;
    for (int m = 0; m < 7; ++m) {
      const PosedSolids other = random_pair(draw, {6, 3});
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
      looks_clear(PosedSolids{shape, shape, random_orientation(draw), random_orientation(draw),
                              distance * random_direction(draw)},
                  0, scalar_tests);
    }
    EXPECT_LT(static_cast<double>(scalar_tests), 2e-3 * pairs) << shape.semi_axes.transpose();
  }
}

}  // namespace
}  // namespace vitrel

// The overlap batch against the exact criterion in 80-bit arithmetic and the support gap.

#include "core/contact/ellipse_overlap_batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/contact/ellipse_vieillard_baron.h"
#include "core/contact/perram_wertheim.h"
#include "core/random/stream.h"
#include "core/tolerances.h"
#include "tests/support/posed_pair.h"
#include "tests/support/resting_bodies.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;

double extent(const PosedPair& pair) {
  return std::max({pair.one.a, pair.two.a, pair.d.cwiseAbs().maxCoeff()});
}
double margin(const PosedPair& pair) {
  return tolerance::contact_gap(extent(pair));
}

/// What the pairs of a test are like: aspect ratios from 1 and ratios of the sizes √(ab) from 1.
struct Class {
  double largest_aspect_ratio, largest_size_ratio;
};
void PrintTo(const Class& at, std::ostream* out) {
  *out << "aspect ratios to " << at.largest_aspect_ratio
       << ", sizes to 1:" << at.largest_size_ratio;
}

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
  const double contact = contact_distance(pair.one, pair.angle1, pair.two, pair.angle2, e);
  const double sign = draw.below(2) == 0 ? 1 : -1;
  const double offset = sign * std::pow(10, -draw.uniform(1, 16));
  pair.d = kind == 0   ? draw.uniform() * (pair.one.a + pair.two.a) * e
           : kind == 1 ? draw.uniform(0, 2) * contact * e
                       : contact * (1 + offset) * e;
  return pair;
}

bool disjoint(const PosedPair& pair) {
  using Real = long double;
  const auto axes = [](const Ellipse& shape, double angle) -> EllipseAxes<Real> {
    return {shape.a, shape.b, std::cos(Real(angle)), std::sin(Real(angle))};
  };
  return vieillard_baron<Real>(axes(pair.one, pair.angle1), axes(pair.two, pair.angle2), pair.d.x(),
                               pair.d.y())
      .disjoint_or_touching();
}

template <class Shape>
bool looks_clear(const PosedPair& pair, int lane, std::uint64_t& scalar_tests) {
  using Bodies = RestingBodies<Shape>;
  return all_look_clear<Bodies>(Bodies::body(Shape(pair.one), pair.angle1),
                                {Bodies::body(Shape(pair.two), pair.angle2)}, std::vector{pair.d},
                                margin(pair), lane, scalar_tests);
}
bool looks_clear(const PosedPair& pair, int lane, std::uint64_t& scalar_tests) {
  return looks_clear<Ellipse>(pair, lane, scalar_tests);
}

/// What the coordinates' rounding may do to a gap.
double rounding(const PosedPair& pair) {
  return 1e-14 * (pair.one.a + pair.two.a + pair.d.norm());
}

class OverlapBatchOfEllipses : public testing::TestWithParam<Class> {};

// Clear is never said of a pair that overlaps, with tolerance zero; and overlap never of a pair
// farther apart than the margin, but for rounding. Changing places changes nothing, but within that
// rounding of the margin.
TEST_P(OverlapBatchOfEllipses, IsRightAboutEveryPair) {
  Stream draw(61, Purpose::tests);
  constexpr int pairs = 100'000;
  int clear = 0, near = 0;
  std::uint64_t scalar_tests = 0;
  for (int k = 0; k < pairs; ++k) {
    const PosedPair pair = random_pair(draw, GetParam());
    const bool answer = looks_clear(pair, k % simd_width, scalar_tests);
    clear += answer;
    const double gap = support_gap(pair.one, pair.angle1, pair.two, pair.angle2, pair.d).gap;
    near += std::abs(gap) < 1e-9;
    if (answer) {
      ASSERT_TRUE(disjoint(pair)) << pair;
      ASSERT_GT(gap, margin(pair) - rounding(pair)) << pair;
    } else {
      ASSERT_LT(gap, margin(pair) + rounding(pair)) << pair;
    }
    std::uint64_t uncounted = 0;
    if (looks_clear(pair.swapped(), k % simd_width, scalar_tests) != answer ||
        looks_clear<PlainEllipse>(pair, k % simd_width, uncounted) != answer) {
      ASSERT_NEAR(gap, margin(pair), rounding(pair)) << pair;
    }
  }
  // The comparison means something: both answers are frequent, and many pairs touch.
  EXPECT_GT(clear, pairs / 4);
  EXPECT_LT(clear, 3 * pairs / 4);
  EXPECT_GT(near, pairs / 10);
  if (GetParam().largest_aspect_ratio > 1) {
    EXPECT_GT(scalar_tests, pairs / 100u);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, OverlapBatchOfEllipses,
                         testing::Values(Class{1, 1}, Class{1, 100}, Class{2, 1}, Class{6, 1},
                                         Class{10, 3}, Class{100, 1}, Class{100, 100},
                                         Class{1000, 1}));

// The same pair in another lane, beside others and beside nobody.
TEST(EllipseOverlapBatch, AnswersOfAGroupAreThoseOfItsPairs) {
  Stream draw(62, Purpose::tests);
  int clear = 0;
  constexpr int groups = 20'000;
  for (int k = 0; k < groups; ++k) {
    const PosedPair first = random_pair(draw, {6, 3});
    const EllipseOverlapBatch batch({first.one, direction(first.angle1)}, nullptr, 1e-12);
    EllipseBatch group;
    bool each_clear = true;
    std::uint64_t alone_in_group = 0, scalar_tests = 0;
    for (int lane = 0; lane < simd_width; ++lane) {
      if (draw.below(3) == 0) continue;
      const PosedPair other = random_pair(draw, {6, 3});
      const Vec2 place =
          other.d * (1.2 * (first.one.a + other.two.a) / (other.one.a + other.two.a));
      group.set(lane, other.two, place, direction(other.angle2));
      EllipseBatch single;
      single.set((lane + k) % simd_width, other.two, place, direction(other.angle2));
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
      looks_clear(pair, 0, scalar_tests);
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
    const bool answer = looks_clear(pair, 1, scalar_tests);
    EXPECT_EQ(answer, pair.d.norm() > one.a + two.a);
  }
  EXPECT_EQ(scalar_tests, 0u);
}

}  // namespace
}  // namespace vitrel

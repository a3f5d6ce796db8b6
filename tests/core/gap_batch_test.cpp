// Gaps of several bodies at once against the gap of two, found slowly.

#include "core/contact/ellipse_gap_batch.h"
#include "core/contact/ellipsoid_gap_batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/random/stream.h"
#include "core/special_values.h"
#include "tests/support/overlap_criteria.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;

Ellipse random_ellipse(Stream& draw, double largest_aspect_ratio) {
  const double b = draw.uniform(0.3, 1.5);
  return {b * std::pow(largest_aspect_ratio, draw.uniform()), b};
}

/// n·d − h₁ − h₂ with h = √(b² + (a² − b²)(u·n)²), in extended precision for the axis as it is.
double gap_along(const PosedPair& pair, const Vec2& n) {
  using Real = long double;
  const auto height = [&](const Ellipse& shape, double angle) {
    const Real along = std::cos(Real(angle)) * n.x() + std::sin(Real(angle)) * n.y();
    const Real bb = Real(shape.b) * shape.b;
    return std::sqrt(bb + (Real(shape.a) * shape.a - bb) * along * along);
  };
  const Real projected = Real(n.x()) * pair.d.x() + Real(n.y()) * pair.d.y();
  return static_cast<double>(projected - height(pair.one, pair.turn1) -
                             height(pair.two, pair.turn2));
}

struct Class {
  double largest_aspect_ratio;
  double nearest, farthest;  // distance of the centres in units of a₁ + a₂
};
void PrintTo(const Class& at, std::ostream* out) {
  *out << "aspect ratios to " << at.largest_aspect_ratio << ", distances from " << at.nearest
       << " to " << at.farthest;
}

class GapBatchOfEllipses : public testing::TestWithParam<Class> {};

// Never larger than the distance of a disjoint pair, and not positive for an overlapping one, to
// rounding; the gap is that along the axis told. One in ten at most falls short of the distance by
// more than a twentieth, up to the largest aspect ratios: each such makes a list longer than need be.
TEST_P(GapBatchOfEllipses, IsALowerBoundAndSeldomALooseOne) {
  const Class& at = GetParam();
  Stream draw(51, Purpose::tests);
  int disjoint = 0, overlapping = 0, loose = 0;
  for (int trial = 0; trial < 5'000; ++trial) {
    const Ellipse one = random_ellipse(draw, at.largest_aspect_ratio);
    const double angle = draw.uniform(-20, 20);
    GapBatch<Ellipse> batch(one, angle, infinity);
    std::array<PosedPair, GapBatch<Ellipse>::lanes> pairs;
    for (int k = 0; k < GapBatch<Ellipse>::lanes; ++k) {
      const Ellipse shape = random_ellipse(draw, at.largest_aspect_ratio);
      const double distance = draw.uniform(at.nearest, at.farthest) * (one.a + shape.a);
      pairs[k] = {one, shape, angle, draw.uniform(-20, 20),
                  distance * direction(draw.uniform(0, 2 * pi))};
      batch.set(k, shape, pairs[k].turn2, pairs[k].d);
    }
    batch.evaluate();
    for (int k = 0; k < GapBatch<Ellipse>::lanes; ++k) {
      const double best = gap_of(pairs[k]).gap;
      const double rounding = 1e-14 * (pairs[k].extent() + pairs[k].d.norm());
      EXPECT_NEAR(batch.axis(k).norm(), 1, 1e-15);
      EXPECT_NEAR(batch.gap(k), gap_along(pairs[k], batch.axis(k)), rounding);
      (best > 0 ? disjoint : overlapping) += 1;
      EXPECT_LE(batch.gap(k), std::max(best, 0.0) + rounding);
      loose += best > 0 && batch.gap(k) < 0.95 * best - 1e-3 * (one.b + pairs[k].two.b);
    }
  }
  RecordProperty("loose", loose);
  RecordProperty("disjoint", disjoint);
  EXPECT_GT(disjoint, 2'000);
  EXPECT_LT(loose, 0.1 * disjoint);
}

INSTANTIATE_TEST_SUITE_P(Classes, GapBatchOfEllipses,
                         testing::Values(Class{1, 0.5, 1.5}, Class{2, 0.5, 1.5}, Class{6, 0.3, 1.2},
                                         Class{20, 0.3, 1.2}, Class{6, 1, 5}));

// Two neighbourhoods may have one centre; there is no direction from one to the other then.
TEST(GapBatchOfEllipses, IsALowerBoundWhereTheCentresCoincide) {
  Stream draw(53, Purpose::tests);
  const Ellipse one = random_ellipse(draw, 6);
  GapBatch<Ellipse> batch(one, 0.3, infinity);
  std::array<PosedPair, GapBatch<Ellipse>::lanes> pairs;
  for (int k = 0; k < GapBatch<Ellipse>::lanes; ++k) {
    pairs[k] = {one, random_ellipse(draw, 6), 0.3, draw.uniform(-9, 9), Vec2::Zero()};
    batch.set(k, pairs[k].two, pairs[k].turn2, pairs[k].d);
  }
  batch.evaluate();
  for (int k = 0; k < GapBatch<Ellipse>::lanes; ++k) {
    EXPECT_NEAR(batch.axis(k).norm(), 1, 1e-15);
    EXPECT_NEAR(batch.gap(k), gap_along(pairs[k], batch.axis(k)), 1e-14);
  }
}

// The same in space: between −(a₁ + a₂) and −(c₁ + c₂) along any axis.
TEST(GapBatchOfEllipsoids, IsALowerBoundWhereTheCentresCoincide) {
  const Ellipsoid one{{2, 1, 0.5}};
  GapBatch<Ellipsoid> batch(one, Quaternion::Identity(), 4);
  for (int k = 0; k < GapBatch<Ellipsoid>::lanes; ++k)
    batch.set(k, one, Quaternion(Eigen::AngleAxisd(0.1 * k, Vec3::UnitX())), Vec3::Zero());
  batch.evaluate();
  for (int k = 0; k < GapBatch<Ellipsoid>::lanes; ++k) {
    EXPECT_NEAR(batch.axis(k).norm(), 1, 1e-15);
    EXPECT_GE(batch.gap(k), -4 - 1e-14);
    EXPECT_LE(batch.gap(k), -1 + 1e-14);
  }
}

// Distances of circles: |d| − r₁ − r₂.
TEST(GapBatchOfDisks, IsTheDistance) {
  constexpr int lanes = GapBatch<Disk>::lanes;
  Stream draw(52, Purpose::tests);
  for (int trial = 0; trial < 1'000; ++trial) {
    const Disk one{draw.uniform(0.5, 2)};
    GapBatch<Disk> batch(one, draw.uniform(0, 7), infinity);
    double wanted[lanes];
    for (int k = 0; k < lanes; ++k) {
      const Disk other{draw.uniform(0.1, 3)};
      const double distance = draw.uniform(0, 8), angle = draw.uniform(0, 7);
      batch.set(k, other, angle, distance * direction(draw.uniform(0, 2 * pi)));
      wanted[k] = distance - one.radius - other.radius;
    }
    batch.evaluate();
    for (int k = 0; k < lanes; ++k) EXPECT_NEAR(batch.gap(k), wanted[k], 1e-14);
  }
}

}  // namespace
}  // namespace vitrel

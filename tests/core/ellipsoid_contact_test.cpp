#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/contact/ellipsoid_contact_screen.h"
#include "core/contact/ellipsoid_gap_batch.h"
#include "core/contact/ellipsoid_pair_in_flight.h"
#include "core/contact/first_contact.h"
#include "core/geometry/capsule.h"
#include "core/geometry/free_flight.h"
#include "core/tolerances.h"
#include "tests/support/overlap_criteria.h"
#include "tests/support/solids.h"

namespace vitrel {
namespace {

constexpr double forever = std::numeric_limits<double>::infinity();

double gap_along(const Vec3& n, const PosedSolids& pair) {
  return n.dot(pair.d) - support_function(pair.one, pair.turn1, n) -
         support_function(pair.two, pair.turn2, n);
}

// The largest gap by a search that knows nothing of derivatives: ever smaller random turns.
double gap_by_trial(const PosedSolids& pair, Stream& draw) {
  const auto gap = [&](const Vec3& n) { return gap_along(n, pair); };
  Vec3 best = pair.d.normalized();
  for (int k = 0; k < 2000; ++k)
    if (const Vec3 n = random_direction(draw); gap(n) > gap(best)) best = n;
  for (double width = 0.1; width > 1e-9; width *= 0.9)
    for (int k = 0; k < 20; ++k)
      if (const Vec3 n = (best + width * random_direction(draw)).normalized(); gap(n) > gap(best))
        best = n;
  return gap(best);
}

TEST(EllipsoidGap, IsTheLargestOverAllDirections) {
  Stream draw(1, Purpose::tests);
  int disjoint = 0;
  for (int k = 0; k < 300; ++k) {
    PosedSolids pair{random_ellipsoid(draw, 10), random_ellipsoid(draw, 10),
                     random_orientation(draw), random_orientation(draw), Vec3::Zero()};
    pair.d = pair.extent() * random_vector(draw, 0, 1.2);
    const SupportGap3 found = gap_of(pair);
    const double sought = gap_by_trial(pair, draw);
    EXPECT_EQ(found.gap > 0, sought > 0);
    if (!(sought > 0)) continue;
    ++disjoint;
    EXPECT_GE(found.gap, sought - 1e-13);
    EXPECT_NEAR(found.gap, sought, 1e-8);
    EXPECT_NEAR(gap_along(found.normal, pair), found.gap, 1e-13);
    const auto separate = [&](double gap) {
      return separated(pair.one, pair.turn1, pair.two, pair.turn2, pair.d, gap);
    };
    EXPECT_TRUE(separate(0.5 * found.gap));
    EXPECT_FALSE(separate(found.gap + 1e-9));
  }
  EXPECT_GT(disjoint, 50);
}

TEST(EllipsoidGap, OfSpheresAndAlongAxesInClosedForm) {
  Stream draw(2, Purpose::tests);
  const Quaternion none = Quaternion::Identity();
  for (int k = 0; k < 100; ++k) {
    const Vec3 d = random_vector(draw, 1, 5);
    const Ellipsoid small{Vec3::Constant(0.3)}, large{Vec3::Constant(0.6)};
    const Quaternion q1 = random_orientation(draw), q2 = random_orientation(draw);
    EXPECT_NEAR(support_gap(small, q1, large, q2, d).gap, d.norm() - 0.9, 4e-15);
  }
  const Ellipsoid body{Vec3(3, 2, 0.5)};
  for (int k = 0; k < 3; ++k) {
    const Vec3 d = 10 * Vec3::Unit(k);
    EXPECT_NEAR(support_gap(body, none, body, none, d).gap, 10 - 2 * body.semi_axes[k], 1e-14);
  }
}

// As a random growing or a tumbling body in the same state.
template <class B>
B body_of(const Ellipsoid& shape, double growth_rate) {
  if constexpr (grows<B>)
    return {shape, 1, growth_rate};
  else
    return {shape};
}
Ellipsoid shape_at(const GrowingEllipsoid& body, double time) {
  return body.at(time);
}
Ellipsoid shape_at(const TumblingEllipsoid& body, double) {
  return body.shape;
}

template <class B>
class EllipsoidsInFlight : public testing::Test {};
using FlyingBodies = testing::Types<GrowingEllipsoid, TumblingEllipsoid>;
TYPED_TEST_SUITE(EllipsoidsInFlight, FlyingBodies);

// Along a fixed axis, over a whole turn: the bound is never too low, and not idle.
TEST(EllipsoidPairInFlight, AccelerationBoundHoldsAndIsTight) {
  Stream draw(3, Purpose::tests);
  double tightest = 0;
  for (int k = 0; k < 400; ++k) {
    const bool turns_across = k % 2 == 0;
    const Ellipsoid shape =
        turns_across ? prolate(draw.uniform(1, 20)) : random_ellipsoid(draw, 20);
    const auto flight = [&] {
      const Quaternion q = random_orientation(draw);
      Vec3 omega = random_vector(draw, 0, 3);
      if (turns_across) omega -= (q * Vec3::UnitX()).dot(omega) * (q * Vec3::UnitX());
      return Flight<GrowingEllipsoid>{{shape, 1, draw.uniform(-0.1, 0.3)},
                                      {random_vector(draw, 0, 5), q},
                                      {random_direction(draw), omega}};
    };
    EllipsoidPairInFlight<GrowingEllipsoid> pair{flight(), flight()};
    const Axis3 n = completed(components(random_direction(draw)));
    pair.go_to(1);
    const auto then = pair.evaluate(n);
    const double rate = pair.gap_rate(n, then);
    for (const double reach : {-1.0, -0.1, 0.01, 0.1, 0.5, 1.0, 3.0}) {
      pair.go_to(1);
      const double bound = pair.acceleration_bound(then, reach);
      const double shortly = std::clamp(reach, -pair.short_time(), pair.short_time());
      EXPECT_LE(pair.acceleration_bound(then, shortly), pair.largest_acceleration() * (1 + 1e-12));
      for (int step = 1; step <= 50; ++step) {
        const double s = reach * step / 50;
        pair.go_to(1 + s);
        const double loss = then.gap + rate * s - pair.evaluate(n).gap;
        EXPECT_LE(loss, 0.5 * bound * s * s + 1e-12);
        if (bound > 1e-3) tightest = std::max(tightest, loss / (0.5 * bound * s * s));
      }
    }
  }
  EXPECT_GT(tightest, 0.9);
}

// Over times in which a tumbling body turns a few times: its bound is of all times.
TEST(EllipsoidPairInFlight, AccelerationBoundOfTumblingBodiesHoldsAndIsTight) {
  Stream draw(7, Purpose::tests);
  double tightest = 0;
  for (int k = 0; k < 2000; ++k) {
    const auto flight = [&] {
      return Flight<TumblingEllipsoid>{{random_ellipsoid(draw, 20)},
                                       {Vec3::Zero(), random_orientation(draw)},
                                       {Vec3::Zero(), random_direction(draw)}};
    };
    EllipsoidPairInFlight<TumblingEllipsoid> pair{flight(), flight()};
    const Axis3 n = completed(components(random_direction(draw)));
    for (int step = 0; step < 100; ++step) {
      pair.go_to(0.1 * step);
      const auto gap = pair.evaluate(n);
      const double bound = pair.acceleration_bound(gap, forever);
      EXPECT_LE(pair.acceleration(gap), bound * (1 + 1e-12));
      tightest = std::max(tightest, pair.acceleration(gap) / bound);
    }
  }
  EXPECT_GT(tightest, 0.5);
}

TYPED_TEST(EllipsoidsInFlight, RatesAreDerivatives) {
  Stream draw(4, Purpose::tests);
  constexpr double h = 1e-5;
  for (int k = 0; k < 100; ++k) {
    const auto flight = [&] {
      const Ellipsoid shape = random_ellipsoid(draw, 5);
      return Flight<TypeParam>{body_of<TypeParam>(shape, draw.uniform(-0.1, 0.3)),
                               {random_vector(draw, 0, 5), random_orientation(draw)},
                               {random_direction(draw), 2 * random_direction(draw)}};
    };
    EllipsoidPairInFlight<TypeParam> pair{flight(), flight()};
    const Axis3 n = completed(components(random_direction(draw)));
    const auto gap = [&](double later, double x, double y) {
      pair.go_to(0.3 + later);
      return pair.evaluate(detail::turned(n, Tangent(x, y))).gap;
    };
    pair.go_to(0.3);
    const auto g = pair.evaluate(n);
    const double rate = pair.gap_rate(n, g), acceleration = pair.acceleration(g);
    const Tangent mixed = pair.slope_rate(n, g);
    const auto first = [](auto&& f) { return (f(h) - f(-h)) / (2 * h); };
    const auto second = [&](auto&& f) { return (f(h) - 2 * g.gap + f(-h)) / (h * h); };
    const auto cross = [](auto&& f) {
      return (f(h, h) - f(h, -h) - f(-h, h) + f(-h, -h)) / (4 * h * h);
    };
    const auto of_time = [&](double t) { return gap(t, 0, 0); };
    const auto of_x = [&](double x) { return gap(0, x, 0); };
    const auto of_y = [&](double y) { return gap(0, 0, y); };
    EXPECT_NEAR(rate, first(of_time), 1e-7);
    EXPECT_NEAR(acceleration, -second(of_time), 1e-3);
    EXPECT_NEAR(g.slope[0], first(of_x), 1e-7);
    EXPECT_NEAR(g.slope[1], first(of_y), 1e-7);
    EXPECT_NEAR(g.c11, -second(of_x), 1e-3);
    EXPECT_NEAR(g.c22, -second(of_y), 1e-3);
    EXPECT_NEAR(g.c12, -cross([&](double x, double y) { return gap(0, x, y); }), 1e-3);
    EXPECT_NEAR(mixed[0], cross([&](double t, double x) { return gap(t, x, 0); }), 1e-3);
    EXPECT_NEAR(mixed[1], cross([&](double t, double y) { return gap(t, 0, y); }), 1e-3);
  }
}

// The gap batch gives a lower bound of the gap, mostly a tight one; and no ellipsoid closer than
// the limit is said to be far by the capsules.
TEST(GapBatchOfEllipsoids, BoundsTheGapFromBelow) {
  Stream draw(6, Purpose::tests);
  constexpr int lanes = GapBatch<Ellipsoid>::lanes;
  int disjoint = 0, loose = 0, far = 0;
  for (const double aspect : {1.5, 5.0, 30.0})
    for (int trial = 0; trial < 500; ++trial) {
      const Ellipsoid one = trial % 2 ? prolate(aspect) : random_ellipsoid(draw, aspect);
      const Quaternion q1 = random_orientation(draw);
      const double limit = draw.uniform(0, 0.3) * one.circumradius();
      GapBatch<Ellipsoid> batch(one, q1, limit);
      PosedSolids pairs[lanes];
      for (int count = 0; count < lanes;) {
        PosedSolids& pair = pairs[count];
        pair.one = one;
        pair.turn1 = q1;
        pair.two = trial % 2 ? prolate(aspect) : random_ellipsoid(draw, aspect);
        pair.turn2 = random_orientation(draw);
        pair.d = pair.extent() * random_vector(draw, 0.1, 1.2);
        if (farther_apart(CapsuleOf(one).at(q1, 1), CapsuleOf(pair.two).at(pair.turn2, 1), pair.d,
                          limit)) {
          ++far;
          EXPECT_GT(gap_of(pair).gap, limit);
        } else {
          batch.set(count++, pair.two, pair.turn2, pair.d);
        }
      }
      batch.evaluate();
      for (int k = 0; k < lanes; ++k) {
        const double best = gap_of(pairs[k]).gap;
        EXPECT_NEAR(batch.gap(k), gap_along(batch.axis(k), pairs[k]), 1e-13);
        EXPECT_LE(batch.gap(k), std::max(best, 0.0) + 1e-13);
        if (!(best > 0 && best < limit)) continue;
        ++disjoint;
        loose += batch.gap(k) < 0.9 * best - 1e-2 * one.inradius();
      }
    }
  EXPECT_GT(disjoint, 200);
  EXPECT_LT(loose, 0.3 * disjoint);
  EXPECT_GT(far, 1000);
}

template <class B>
double gap_at(const Flight<B>& one, const Flight<B>& two, double time) {
  const Pose3 p1 = pose_at(one, time), p2 = pose_at(two, time);
  return support_gap(shape_at(one.body, time), p1.orientation, shape_at(two.body, time),
                     p2.orientation, p2.position - p1.position)
      .gap;
}

// The first contact by small steps in time, refined by halving.
template <class B>
double contact_by_steps(const Flight<B>& one, const Flight<B>& two, double horizon) {
  constexpr int steps = 4000;
  for (int k = 1; k <= steps; ++k) {
    double late = horizon * k / steps, early = horizon * (k - 1) / steps;
    if (gap_at(one, two, late) > 0) continue;
    for (int halving = 0; halving < 60; ++halving) {
      const double middle = 0.5 * (early + late);
      (gap_at(one, two, middle) > 0 ? early : late) = middle;
    }
    return early;
  }
  return forever;
}

TYPED_TEST(EllipsoidsInFlight, FirstTouchWhereAScanInSmallStepsSaysSo) {
  constexpr double horizon = 2;
  int contacts = 0;
  for (const double aspect : {1.001, 2.0, 10.0, 40.0}) {
    Stream draw(5, Purpose::tests, static_cast<std::uint64_t>(1000 * aspect));
    for (int k = 0; k < 200; ++k) {
      const Ellipsoid shape = k % 3 == 0   ? prolate(aspect)
                              : k % 3 == 1 ? oblate(aspect)
                                           : random_ellipsoid(draw, aspect);
      const double reach = 2 * shape.circumradius();
      const auto flight = [&](const Vec3& position) {
        return Flight<TypeParam>{
            body_of<TypeParam>(shape, k % 2 == 0 ? 0 : draw.uniform(-0.1, 0.3)),
            {position, random_orientation(draw)},
            {0.3 * reach * random_direction(draw), random_vector(draw, 0, 4)}};
      };
      const auto one = flight({0, 0, 0});
      const auto two = flight(reach * random_vector(draw, 0.3, 1));
      const double contact_gap = tolerance::contact_gap(reach);
      const Prediction3 found = first_contact(one, two, horizon, contact_gap);
      if (!(gap_at(one, two, 0) > 0)) {
        EXPECT_EQ(found.outcome, Outcome::overlap);
        continue;
      }
      const double truth = contact_by_steps(one, two, horizon);
      if (truth == forever) {
        // A graze between two steps may be found; it must then be one.
        if (found.outcome == Outcome::contact) {
          EXPECT_LE(gap_at(one, two, found.time), 2 * contact_gap);
        }
        continue;
      }
      ++contacts;
      ASSERT_EQ(found.outcome, Outcome::contact);
      EXPECT_LE(found.time, truth);
      EXPECT_NEAR(found.time, truth, 1e-9 * aspect) << aspect << " " << k;
      EXPECT_NEAR(gap_at(one, two, found.time), contact_gap, 0.6 * contact_gap + 2e-15 * reach);
      const Vec3 arm = found.point - one.pose.position - one.motion.velocity * found.time;
      const Ellipsoid touching = shape_at(one.body, found.time);
      const Quaternion q1 = pose_at(one, found.time).orientation;
      EXPECT_NEAR((arm - surface_point(touching, q1, found.normal)).norm(), 0, 1e-12 * reach);
    }
  }
  EXPECT_GT(contacts, 50);
}

TEST(EllipsoidFirstContact, SpheresInClosedForm) {
  const Flight<Sphere> one{{1}, {{0, 0, 0}}, {{0.5, 0, 0}}};
  const Flight<Sphere> two{{2}, {{7, 0.6, 0.8}}, {{-1.5, 0, 0}}};
  const Prediction3 touch = first_contact(one, two, forever, 0);
  ASSERT_EQ(touch.outcome, Outcome::contact);
  EXPECT_NEAR(touch.time, (7 - std::sqrt(8.0)) / 2, 1e-14);
  const Flight<Ellipsoid> round1{{Vec3::Constant(1)}, one.pose, {one.motion.velocity, {1, 2, 3}}};
  const Flight<Ellipsoid> round2{{Vec3::Constant(2)}, two.pose, {two.motion.velocity, {3, 0, 1}}};
  EXPECT_EQ(first_contact(round1, round2, forever, 0).time, touch.time);
}

}  // namespace
}  // namespace vitrel

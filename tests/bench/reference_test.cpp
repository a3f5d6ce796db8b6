// The reference itself: closed forms with growth, another criterion in a wider arithmetic, the gap it leads to.

#include <gtest/gtest.h>

#include <cmath>

#include "bench/surveys/stability_suite.h"
#include "bench/surveys/verdict.h"
#include "core/extended.h"
#include "core/state/exact_pair.h"

namespace vitrel::bench {
namespace {

using Truth = TrueContact::Outcome;

Flight<GrowingEllipse> growing(const Ellipse& shape, double size, double rate, const Vec2& position,
                               const Vec2& velocity, double omega = 0) {
  return {{shape, size, rate}, {position, 0}, {velocity, omega}};
}

// |d + v t| = (γ₁ + γ₂) t with d = (10, 4), v = (−1, 0), γ₁ + γ₂ = 3: 8 t² + 20 t − 116 = 0.
TEST(TrueFirstContactWithGrowth, DisksFromPointsInClosedForm) {
  const auto one = growing({1, 1}, 0, 2, {0, 0}, {0, 0}, 3);
  const auto two = growing({0.5, 0.5}, 0, 2, {10, 4}, {-1, 0});
  const auto truth = true_first_contact(one, two, 5);
  ASSERT_EQ(truth.outcome, Truth::contact);
  const long double time = (-20 + std::sqrt(4112.0L)) / 16;
  EXPECT_NEAR(static_cast<double>(truth.time - time), 0, 1e-18);
  EXPECT_LE(truth.uncertainty, 1e-16L);
  // The normal points along d + v t; the gap closes by growth and by v.
  const Vec2 there(10 - static_cast<double>(time), 4);
  EXPECT_NEAR((truth.normal - there.normalized()).norm(), 0, 1e-15);
  EXPECT_NEAR(truth.approach_speed, 3 + there.normalized().x(), 1e-14);
}

// Semi-axes 2 (1 + t/4) and 1.5 at rest, 6 apart: they meet at t = 5, closing at 1/2.
TEST(TrueFirstContactWithGrowth, GrowingEllipseAgainstARestingOne) {
  const auto one = growing({2, 1}, 1, 0.25, {0, 0}, {0, 0});
  const auto two = growing({1.5, 0.5}, 1, 0, {6, 0}, {0, 0});
  const auto truth = true_first_contact(one, two, 8);
  ASSERT_EQ(truth.outcome, Truth::contact);
  EXPECT_NEAR(static_cast<double>(truth.time - 5), 0, 1e-17);
  EXPECT_NEAR((truth.normal - Vec2(1, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR(truth.approach_speed, 0.5, 1e-14);
  EXPECT_EQ(true_first_contact(one, two, 4.99).outcome, Truth::none);
  EXPECT_EQ(true_first_contact(one, growing({1.5, 0.5}, 1, -0.4, {6, 0}, {0, 0}), 2).outcome,
            Truth::none);
}

// A point beside a resting ellipse grows into it; a point inside it is an overlap.
TEST(TrueFirstContactWithGrowth, PointBesideAndInsideAnEllipse) {
  const auto one = growing({3, 1}, 1, 0, {0, 0}, {0, 0});
  const auto beside = true_first_contact(one, growing({2, 1}, 0, 1, {0, 1.5}, {0, 0}), 2);
  ASSERT_EQ(beside.outcome, Truth::contact);
  EXPECT_NEAR(static_cast<double>(beside.time), 0.5, 1e-17);
  const auto inside = true_first_contact(one, growing({2, 1}, 0, 1, {0, 0.5}, {0, 0}), 2);
  EXPECT_EQ(inside.outcome, Truth::overlap_at_start);
}

class EveryClass : public testing::TestWithParam<CaseClass> {};

using Wide = DoubleDouble;

/// To all its digits.
Wide wide(long double x) {
  const auto high = static_cast<double>(x);
  return Wide(high) + Wide(static_cast<double>(x - high));
}

/// An ellipse at a time in 106 bits, in the plane.
exact::Particle<2, Wide> placed(const Flight<GrowingEllipse>& flight, long double time) {
  const Wide t = wide(time), turn = Wide(flight.motion.angular_velocity) * t;
  const auto turned = static_cast<double>(turn);
  const auto [c0, s0] = extended_cosine_and_sine(flight.pose.angle);
  const auto [c1, s1] = extended_cosine_and_sine(turned);
  const Wide rest = turn - Wide(turned), c2 = Wide(1) - rest * rest / Wide(2), s2 = rest;
  const Wide c = c0 * c1 - s0 * s1, s = s0 * c1 + c0 * s1;
  const Wide size = Wide(flight.body.size) + Wide(flight.body.growth_rate) * t;
  const auto along = [&](int k) {
    return Wide(flight.pose.position[k]) + Wide(flight.motion.velocity[k]) * t;
  };
  const Wide a = size * Wide(flight.body.shape.a), b = size * Wide(flight.body.shape.b);
  return {{along(0), along(1)}, {a, b, c * c2 - s * s2, s * c2 + c * s2}, a, a == b};
}

bool overlap(const CollisionCase& pair, long double time) {
  const auto one = placed(pair.one, time), two = placed(pair.two, time);
  const exact::Point<2, Wide> d = two.centre - one.centre;
  if (one.is_round && two.is_round) return exact::examine(one, two, d, Wide(0)).overlap;
  return !vieillard_baron<Wide>(one.axes, two.axes, d.x(), d.y()).disjoint_or_touching();
}

// The criterion of Vieillard-Baron in 106 bits sees the surfaces cross within the uncertainty.
TEST_P(EveryClass, IsWhereAnOverlapBeginsInAWiderArithmetic) {
  for (int index = 0; index < 30; ++index) {
    const CollisionCase pair = make_case(GetParam(), 7, index);
    const auto truth = truth_of(pair);
    ASSERT_NE(truth.outcome, Truth::undecided) << index;
    if (truth.outcome == Truth::overlap_at_start) {
      EXPECT_TRUE(overlap(pair, 0)) << index;
    }
    if (truth.outcome != Truth::contact) continue;
    const long double off = truth.uncertainty + 1e-19L * truth.time;
    EXPECT_FALSE(overlap(pair, std::max(truth.time - off, 0.0L))) << index;
    EXPECT_TRUE(overlap(pair, truth.time + off)) << index;
    // What the contact is uncertain by, as a gap.
    EXPECT_LE(truth.uncertainty * truth.approach_speed, 1e-14 * pair.gap_unit()) << index;
  }
}

// Disjoint at a fine series of times before the contact, touching there, disjoint before the
// horizon if there is none. The gap at the contact closes at the speed given.
TEST_P(EveryClass, IsTheFirstTimeThatTheGapVanishes) {
  int contacts = 0;
  for (int index = 0; index < 20; ++index) {
    const CollisionCase pair = make_case(GetParam(), 8, index);
    const auto gap = [&](long double time) { return gap_at(pair, time); };
    const auto truth = truth_of(pair);
    if (truth.outcome == Truth::overlap_at_start) {
      EXPECT_LT(gap(0), 0) << index;
      continue;
    }
    const bool contact = truth.outcome == Truth::contact;
    const long double end = contact ? truth.time : static_cast<long double>(pair.horizon);
    for (int k = 0; k < 200; ++k) ASSERT_GT(gap(end * k / 200), 0) << index << ' ' << k;
    if (!contact) continue;
    ++contacts;
    const long double reach = pair.one.body.shape.a + pair.two.body.shape.a;
    EXPECT_LE(std::abs(gap(truth.time)), 1e-17L * reach + truth.uncertainty * 100) << index;
    EXPECT_GE(truth.approach_speed, 0) << index;
    const long double step = 1e-7L * pair.horizon;
    const long double speed = (gap(end - step) - gap(end + step)) / (2 * step);
    EXPECT_NEAR(truth.approach_speed, static_cast<double>(speed), 1e-6 * (1 + truth.approach_speed))
        << index;
  }
  if (GetParam().name != "crossed_at_start") {
    EXPECT_GT(contacts, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Suite, EveryClass, testing::ValuesIn(stability_suite()),
                         [](const auto& of) {
                           return of.param.name + "_" +
                                  std::to_string(static_cast<int>(of.param.aspect_ratio));
                         });

}  // namespace
}  // namespace vitrel::bench

#include "bench/surveys/true_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random/stream.h"

namespace vitrel::bench {
namespace {

using Body = Flight<GrowingEllipse>;

Body at_rest(const Ellipse& shape, const Vec2& position, double angle = 0) {
  return {{shape, 1, 0}, {position, angle}, {{0, 0}, 0}};
}

TEST(TrueGap, DisksInClosedForm) {
  const Body one = at_rest({2, 2}, {0, 0}), two = at_rest({0.5, 0.5}, {3, 4});
  EXPECT_NEAR(static_cast<double>(true_gap(one, two, 0) - 2.5L), 0, 1e-18);
  EXPECT_NEAR(static_cast<double>(true_gap(one, at_rest({4, 4}, {3, 4}), 0) + 1), 0, 1e-18);
  EXPECT_LT(true_gap(one, at_rest({1, 1}, {0, 0}), 0), 0);  // one inside the other
}

TEST(TrueGap, MovingAndGrowing) {
  Body one = at_rest({2, 1}, {0, 0}), two = at_rest({1, 0.5}, {0, 9});
  two.motion.velocity = {0, -1};
  two.body.growth_rate = 0.5;
  // At t = 4: centres 5 apart, semi-minor axes 1 and 0.5 · 3.
  EXPECT_NEAR(static_cast<double>(true_gap(one, two, 4) - 2.5L), 0, 1e-18);
  // 9 − t = 1 + 0.5 (1 + t/2)
  const TrueContact contact = true_first_contact(one, two, 8);
  EXPECT_NEAR(static_cast<double>(contact.time - 6), 0, 1e-18);
  EXPECT_NEAR((contact.normal - Vec2(0, 1)).norm(), 0, 1e-15);
  EXPECT_NEAR(contact.approach_speed, 1.25, 1e-15);
}

// Turned by π/2 at the time asked: tip against flat side, 6 − 2 − 0.25.
TEST(TrueGap, TipAgainstSide) {
  Body one = at_rest({2, 0.02}, {0, 0}), two = at_rest({5, 0.25}, {6, 0});
  two.motion.angular_velocity = std::numbers::pi / 4;
  EXPECT_NEAR(static_cast<double>(true_gap(one, two, 2)), 3.75, 1e-14);
}

// To first order in a − b, h = b + (a − b) cos²(φ − θ); then dg/dφ = 0 turns the normal from the line
// of centres by Σ (a − b) sin 2(φ − θ)/|d|.
TEST(TrueGap, NormalOfNearlyRoundBodies) {
  constexpr double excess = 1e-12, distance = 2, phi = std::numbers::pi / 2;
  for (int k = 0; k < 100; ++k) {
    const double first = 0.1 * k, second = 0.3 * k + 1;
    const Body one = at_rest({1 + excess, 1}, {0, 0}, first);
    Body two = at_rest({1 + excess, 1}, {0, distance + 1}, second);
    two.motion.velocity = {0, -1};
    const double turn =
        excess * (std::sin(2 * (phi - first)) + std::sin(2 * (phi - second))) / distance;
    // The normal's x is −turn; a − b is off by the rounding of 1 + 1e-12.
    EXPECT_NEAR(true_first_contact(one, two, 2).normal.x(), -turn, 3e-16);
  }
}

// The support gap on a scan of all directions, then on ever finer scans around the best.
long double scanned_gap(const Body& one, const Body& two) {
  const auto gap = [&](long double angle) {
    const auto support = [&](const Body& body) {
      const long double x = std::cos(angle - body.pose.angle),
                        y = std::sin(angle - body.pose.angle);
      const long double ax = body.body.shape.a * x, by = body.body.shape.b * y;
      return std::sqrt(ax * ax + by * by);
    };
    const Vec2 d = two.pose.position - one.pose.position;
    return d.x() * std::cos(angle) + d.y() * std::sin(angle) - support(one) - support(two);
  };
  constexpr int directions = 5'000;
  long double best = 0, highest = gap(0), width = std::numbers::pi_v<long double>;
  for (int level = 0; level < 7; ++level) {
    const long double centre = best;
    const int count = level == 0 ? directions : 50;
    for (int k = -count; k <= count; ++k) {
      const long double angle = centre + k * width / count;
      const long double here = gap(angle);
      if (here <= highest) continue;
      highest = here;
      best = angle;
    }
    width *= 2.0L / count;
  }
  return highest;
}

// Aspect ratios to 100, sizes to 1 : 1000, apart and overlapping.
TEST(TrueGap, MatchesAScan) {
  Stream draw(3, Purpose::tests);
  int apart = 0, overlapping = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const auto shape = [&](double b) { return Ellipse{b * std::pow(100, draw.uniform()), b}; };
    const Ellipse e1 = shape(1), e2 = shape(std::pow(1e-3, draw.uniform()));
    const double distance = draw.uniform(0.1, 1.2) * (e1.a + e2.a), angle = draw.uniform(0, 7);
    const Body one = at_rest(e1, {0, 0}, draw.uniform(0, 7));
    const Body two =
        at_rest(e2, distance * Vec2(std::cos(angle), std::sin(angle)), draw.uniform(0, 7));
    const long double gap = true_gap(one, two, 0), scanned = scanned_gap(one, two);
    const long double reach = e1.a + e2.a;
    EXPECT_GE(gap, scanned - 1e-18L * reach) << trial;  // the largest gap of all
    EXPECT_LE(gap, scanned + 1e-12L * reach) << trial;
    (gap > 0 ? apart : overlapping) += 1;
  }
  EXPECT_GT(apart, 30);
  EXPECT_GT(overlapping, 30);
}

}  // namespace
}  // namespace vitrel::bench

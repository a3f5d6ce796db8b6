#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/contact/first_contact.h"
#include "core/contact/support_gap.h"
#include "core/random/stream.h"
#include "core/tolerances.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double forever = std::numeric_limits<double>::infinity();

Prediction predict(const Flight<Ellipse>& one, const Flight<Ellipse>& two,
                   double horizon = forever) {
  return first_contact(one, two, horizon, tolerance::contact_gap(one.body.a + two.body.a));
}

double gap_at(const Flight<Ellipse>& one, const Flight<Ellipse>& two, double time) {
  const Pose2 p1 = advanced(one.pose, one.motion, time);
  const Pose2 p2 = advanced(two.pose, two.motion, time);
  return support_gap(one.body, p1.angle, two.body, p2.angle, p2.position - p1.position).gap;
}

// Reference values in extended precision; a sign change of the contact function.
TEST(FirstContact, TwoBodyCollisionOfOneMovingEllipse) {
  const Flight<Ellipse> one{{2, 1}, {{0, 0}, 0}, {{0, 0}, 0}};
  const Flight<Ellipse> two{{2, 1}, {{6, 0.5}, pi / 2}, {{-1, 0}, 0.7}};
  const Prediction touch = predict(one, two);
  ASSERT_EQ(touch.outcome, Outcome::contact);
  EXPECT_NEAR(touch.time, 2.170137851790125, 1e-12);
  EXPECT_NEAR(touch.normal.x(), 0.860699250292, 1e-12);
  EXPECT_NEAR(touch.normal.y(), 0.509113740284, 1e-12);
  EXPECT_NEAR(touch.point.x(), 1.917878297555, 1e-12);
  EXPECT_NEAR(touch.point.y(), 0.283611898450, 1e-12);
}

TEST(FirstContact, TwoBodyCollisionOfTwoSpinningEllipses) {
  const Flight<Ellipse> one{{2, 1}, {{0, 0}, 0.3}, {{0.2, -0.1}, 1.5}};
  const Flight<Ellipse> two{{2, 1}, {{3, 2.5}, -0.4}, {{-0.5, -0.6}, -0.8}};
  const Prediction touch = predict(one, two);
  ASSERT_EQ(touch.outcome, Outcome::contact);
  EXPECT_NEAR(touch.time, 1.495639195538086, 1e-12);
}

// Touches at 0.0847 and, from inside the overlap, again at 1: local optimisers find the second.
TEST(FirstContact, SceneOfAppendixB1) {
  const Flight<Ellipse> one{{1, 0.5}, {{0, 0}, 0}, {{0, 0}, 0}};
  const Flight<Ellipse> two{{1, 0.5}, {{1, 1}, 0}, {{-1, 0}, pi}};
  const Prediction touch = predict(one, two);
  ASSERT_EQ(touch.outcome, Outcome::contact);
  EXPECT_NEAR(touch.time, 0.08472238582199765, 1e-12);
  EXPECT_NEAR(touch.point.x(), 0.3428630757205, 1e-12);
  EXPECT_NEAR(touch.point.y(), 0.4696926950964, 1e-12);
  EXPECT_NEAR(touch.normal.x(), 0.179528294643, 1e-12);
  EXPECT_NEAR(touch.normal.y(), 0.983752810122, 1e-12);
}

TEST(FirstContact, DisksMeetWhereTheClosedFormSays) {
  const Flight<Disk> one{{1}, {{0, 0}, 0}, {{0.5, 0}, 0}};
  const Flight<Disk> two{{2}, {{7, 1}, 0}, {{-1.5, 0}, 0}};
  const Prediction touch = first_contact(one, two, forever, 0);
  ASSERT_EQ(touch.outcome, Outcome::contact);
  EXPECT_NEAR(touch.time, (7 - std::sqrt(8.0)) / 2, 1e-14);
  EXPECT_EQ(first_contact(one, two, 1.0, 0).outcome, Outcome::none);
}

TEST(FirstContact, RoundEllipsesAreDisks) {
  const Flight<Disk> disk1{{1}, {{0, 0}, 0}, {{0.5, 0.1}, 0}};
  const Flight<Disk> disk2{{2}, {{7, 1}, 0}, {{-1.5, 0}, 0}};
  const Flight<Ellipse> one{{1, 1}, disk1.pose, {disk1.motion.velocity, 3}};
  const Flight<Ellipse> two{{2, 2}, disk2.pose, {disk2.motion.velocity, -5}};
  EXPECT_EQ(first_contact(one, two, forever, 1e-14).time,
            first_contact(disk1, disk2, forever, 1e-14).time);
}

TEST(FirstContact, OverlapAtTheStartIsSaid) {
  const Flight<Ellipse> one{{2, 1}, {{0, 0}, 0}, {{1, 0}, 0}};
  const Flight<Ellipse> crossed{{2, 1}, {{0.1, 0}, pi / 2}, {{0, 0}, 1}};
  EXPECT_EQ(predict(one, crossed).outcome, Outcome::overlap);
}

// The bound is a bound at every moment of the step, and a tight one.
TEST(FirstContact, AccelerationBoundHoldsAndIsTight) {
  Stream draw(3, Purpose::tests);
  double tightest = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Ellipse ellipse{std::pow(10, draw.uniform(0, 1.5)), 1};
    const double angle = draw.uniform(0, 2 * pi);
    const double omega = draw.uniform(-3, 3);
    const double duration = draw.uniform(0, 2);
    const Vec2 n = direction(draw.uniform(0, 2 * pi));
    const double bound = support_acceleration_bound(ellipse, direction(angle), omega, n, duration);
    for (int k = 0; k <= 400; ++k) {
      const double time = duration * k / 400;
      const double h = support(ellipse, direction(angle + omega * time), n);
      const double ab = ellipse.a * ellipse.b;
      const double acceleration = omega * omega * (ab * ab / (h * h * h) - h);
      ASSERT_LE(acceleration, bound * (1 + 1e-12) + 1e-12);
      if (bound > 0) tightest = std::max(tightest, acceleration / bound);
    }
  }
  EXPECT_GT(tightest, 0.99);
}

// Independent slow computation: a fine scan of the support gap. A predicted contact is a contact,
// and the gap is nowhere negative before it (or before the horizon, if there is none).
TEST(FirstContact, NeverLateNeverMissedAgainstAScan) {
  Stream draw(5, Purpose::tests);
  int contacts = 0, misses = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const double b1 = draw.uniform(0.3, 1), b2 = draw.uniform(0.3, 1);
    const Ellipse e1{b1 * std::pow(10, draw.uniform(0, 1.3)), b1};
    const Ellipse e2{b2 * std::pow(10, draw.uniform(0, 1.3)), b2};
    const double reach = e1.a + e2.a;
    const Vec2 d = draw.uniform(0.2, 1.2) * reach * direction(draw.uniform(0, 2 * pi));
    const Flight<Ellipse> one{
        e1, {{0, 0}, draw.uniform(0, 2 * pi)}, {{draw.normal(), draw.normal()}, 2 * draw.normal()}};
    const Flight<Ellipse> two{
        e2, {d, draw.uniform(0, 2 * pi)}, {{draw.normal(), draw.normal()}, 2 * draw.normal()}};
    const double horizon = 2;
    const bool overlapping = gap_at(one, two, 0) <= 0;
    const Prediction touch = predict(one, two, horizon);
    ASSERT_EQ(overlapping, touch.outcome == Outcome::overlap);
    if (overlapping) continue;
    ASSERT_NE(touch.outcome, Outcome::not_converged);
    double until = horizon;
    if (touch.outcome == Outcome::contact) {
      ++contacts;
      until = touch.time;
      EXPECT_NEAR(gap_at(one, two, until), 0, 2 * tolerance::contact_gap(reach));
    } else {
      ++misses;
    }
    for (int k = 0; k < 500; ++k) ASSERT_GT(gap_at(one, two, until * k / 500), 0) << trial;
  }
  EXPECT_GT(contacts, 500);
  EXPECT_GT(misses, 500);
}

// Flat sides in contact, at rest but spinning: the normal velocity is zero at first. Time must
// pass, and the gap must not be lost.
TEST(FirstContact, SlidingAtTheContactGapMakesProgress) {
  const double gap = 1e-13;
  const Flight<Ellipse> one{{2, 1}, {{0, 0}, 0}, {{0, 0}, 0.5}};
  const Flight<Ellipse> two{{2, 1}, {{0, 2 + gap}, 0}, {{0.3, 0}, 0}};
  const Prediction touch = first_contact(one, two, 10, gap);
  ASSERT_EQ(touch.outcome, Outcome::contact);
  EXPECT_GT(touch.time, 0);
  EXPECT_GT(gap_at(one, two, touch.time), 0);
}

}  // namespace
}  // namespace vitrel

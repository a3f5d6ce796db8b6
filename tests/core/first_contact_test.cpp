#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/contact/ellipse_gap.h"
#include "core/contact/ellipse_pair_in_flight.h"
#include "core/contact/first_contact.h"
#include "core/geometry/free_flight.h"
#include "core/random/stream.h"
#include "core/tolerances.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double forever = std::numeric_limits<double>::infinity();

Prediction2 predict(const Flight<Ellipse>& one, const Flight<Ellipse>& two,
                    double horizon = forever) {
  return first_contact(one, two, horizon, tolerance::contact_gap(one.body.a + two.body.a));
}

double gap_at(const Flight<Ellipse>& one, const Flight<Ellipse>& two, double time) {
  const Pose2 p1 = advanced(one.pose, one.motion, time);
  const Pose2 p2 = advanced(two.pose, two.motion, time);
  return support_gap(one.body, p1.angle, two.body, p2.angle, p2.position - p1.position).gap;
}

const Flight<Ellipse> spinning_one{{2, 1}, {{0, 0}, 0.3}, {{0.2, -0.1}, 1.5}};
const Flight<Ellipse> spinning_two{{2, 1}, {{3, 2.5}, -0.4}, {{-0.5, -0.6}, -0.8}};

void expect_contact(const Prediction2& touch, double time, double tolerance) {
  ASSERT_EQ(touch.outcome, Outcome::contact);
  EXPECT_NEAR(touch.time, time, tolerance);
}
void expect_contact(const Prediction2& touch, double time, const Vec2& normal, const Vec2& point) {
  expect_contact(touch, time, 1e-12);
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(touch.normal[k], normal[k], 1e-12);
    EXPECT_NEAR(touch.point[k], point[k], 1e-12);
  }
}

// Reference values in extended precision; a sign change of the contact function.
TEST(FirstContact, TwoBodyCollisionOfOneMovingEllipse) {
  const Flight<Ellipse> one{{2, 1}, {{0, 0}, 0}, {{0, 0}, 0}};
  const Flight<Ellipse> two{{2, 1}, {{6, 0.5}, pi / 2}, {{-1, 0}, 0.7}};
  expect_contact(predict(one, two), 2.170137851790125, {0.860699250292, 0.509113740284},
                 {1.917878297555, 0.283611898450});
}

TEST(FirstContact, TwoBodyCollisionOfTwoSpinningEllipses) {
  expect_contact(predict(spinning_one, spinning_two), 1.495639195538086, 1e-12);
}

// Touches at 0.0847 and, from inside the overlap, again at 1: local optimisers find the second.
TEST(FirstContact, SceneOfAppendixB1) {
  const Flight<Ellipse> one{{1, 0.5}, {{0, 0}, 0}, {{0, 0}, 0}};
  const Flight<Ellipse> two{{1, 0.5}, {{1, 1}, 0}, {{-1, 0}, pi}};
  expect_contact(predict(one, two), 0.08472238582199765, {0.179528294643, 0.983752810122},
                 {0.3428630757205, 0.4696926950964});
}

TEST(FirstContact, DisksMeetWhereTheClosedFormSays) {
  const Flight<Disk> one{{1}, {{0, 0}, 0}, {{0.5, 0}, 0}};
  const Flight<Disk> two{{2}, {{7, 1}, 0}, {{-1.5, 0}, 0}};
  expect_contact(first_contact(one, two, forever, 0), (7 - std::sqrt(8.0)) / 2, 1e-14);
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

GrowingEllipse random_growing(Stream& draw) {
  const double b = draw.uniform(0.3, 1);
  return {{b * std::pow(10, draw.uniform(0, 1.5)), b}, draw.uniform(0, 1), draw.uniform(-0.2, 0.4)};
}

// Looking forward and looking back, the parabola is a bound at every moment, and a tight one.
TEST(PairInFlight, AccelerationBoundHoldsAndIsTight) {
  Stream draw(3, Purpose::tests);
  double tightest = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const auto flight = [&] {
      return Flight<GrowingEllipse>{random_growing(draw),
                                    {{draw.normal(), draw.normal()}, draw.uniform(0, 2 * pi)},
                                    {{draw.normal(), draw.normal()}, draw.uniform(-3, 3)}};
    };
    const Flight<GrowingEllipse> one = flight(), two = flight();
    const Vec2 n = direction(draw.uniform(0, 2 * pi));
    const double now = 1, duration = draw.uniform(0, 1);
    EllipsePairInFlight pair(one, two);
    const auto gap = [&](double time) {
      pair.start_at(time);
      return pair.evaluate(n);
    };
    const double smallest =
        std::min({one.body.size_at(now - duration), one.body.size_at(now + duration),
                  two.body.size_at(now - duration), two.body.size_at(now + duration)});
    if (smallest < 0) continue;
    const GapAlongAxis here = gap(now);
    const double rate = pair.gap_rate(n, here);
    for (const double until : {duration, -duration}) {
      const double bound = pair.acceleration_bound(here, until);
      pair.start_at(now);
      const double shortly = std::clamp(until, -pair.short_time(), pair.short_time());
      ASSERT_LE(pair.acceleration_bound(here, shortly), pair.largest_acceleration() * (1 + 1e-12));
      for (int k = 1; k <= 200; ++k) {
        const double s = until * k / 200;
        const double fall = here.gap + rate * s - gap(now + s).gap;  // ≤ ½ M s²
        ASSERT_LE(fall, 0.5 * bound * s * s + 1e-13) << trial;
        if (fall > 1e-6) tightest = std::max(tightest, fall / (0.5 * bound * s * s));
      }
      pair.start_at(now);
    }
  }
  EXPECT_GT(tightest, 0.9);
}

TEST(PairInFlight, RatesAreDerivatives) {
  const Flight<GrowingEllipse> one{{{2, 1}, 0.8, 0.1}, {{0.1, 0}, 0.3}, {{0.2, -0.1}, 1.5}};
  const Flight<GrowingEllipse> two{{{3, 0.5}, 1.1, -0.2}, {{4, 2.5}, -0.4}, {{-0.5, -0.6}, -0.8}};
  EllipsePairInFlight pair(one, two);
  const Vec2 n = direction(0.4);
  const double step = 1e-4;
  const auto along = [&](double time) {
    pair.go_to(time);
    return pair.evaluate(n);
  };
  pair.start_at(0);
  const GapAlongAxis before = along(0.5 - step), after = along(0.5 + step), here = along(0.5);
  EXPECT_NEAR(pair.gap_rate(n, here), (after.gap - before.gap) / (2 * step), 1e-7);
  EXPECT_NEAR(pair.slope_rate(n, here), (after.slope - before.slope) / (2 * step), 1e-6);
  EXPECT_NEAR(-pair.acceleration(here), (after.gap - 2 * here.gap + before.gap) / (step * step),
              1e-6);
}

// BaseShape from points; closed form: |d| − |v| t = (γ₁ + γ₂) t.
TEST(FirstContact, GrowingDisksAndPointsInClosedForm) {
  const Flight<GrowingEllipse> one{{{1, 1}, 0, 0.5}, {{0, 0}, 0}, {{0.5, 0}, 0}};
  const Flight<GrowingEllipse> two{{{2, 2}, 0, 0.25}, {{7, 0}, 0}, {{0, 0}, 0}};
  expect_contact(first_contact(one, two, forever, 1e-14), 7 / 1.5, 1e-13);
  // Receding more slowly than they grow.
  const Flight<GrowingEllipse> receding{two.body, two.pose, {{1, 0}, 0}};
  expect_contact(first_contact(one, receding, forever, 1e-14), 7 / 0.5, 1e-13);
  const Flight<GrowingEllipse> faster{two.body, two.pose, {{2, 0}, 0}};
  EXPECT_EQ(first_contact(one, faster, forever, 1e-14).outcome, Outcome::none);
}

// Two ellipses from points, tip to side along the x axis: 2 γ t + γ t = 6 − t.
TEST(FirstContact, EllipsesGrowingFromPointsInClosedForm) {
  const Flight<GrowingEllipse> one{{{2, 1}, 0, 1}, {{0, 0}, 0}, {{0, 0}, 0}};
  const Flight<GrowingEllipse> two{{{2, 1}, 0, 1}, {{6, 0}, pi / 2}, {{-1, 0}, 0}};
  const Prediction2 touch = first_contact(one, two, 10, tolerance::contact_gap(4));
  expect_contact(touch, 1.5, 1e-13);
  EXPECT_NEAR(touch.point.x(), 3, 1e-12);
  EXPECT_NEAR(touch.normal.x(), 1, 1e-12);
}

// Without growth the general model gives the same answer to the last bit.
TEST(FirstContact, EllipsesThatDoNotGrowAreEllipses) {
  const auto growing = [](const Flight<Ellipse>& flight) {
    return Flight<GrowingEllipse>{{flight.body, 1, 0}, flight.pose, flight.motion};
  };
  const Prediction2 still = predict(spinning_one, spinning_two);
  const Prediction2 touch = first_contact(growing(spinning_one), growing(spinning_two), forever,
                                          tolerance::contact_gap(4));
  EXPECT_EQ(still.time, touch.time);
  EXPECT_EQ(still.normal, touch.normal);
}

struct Flights {
  Flight<Ellipse> one, two;
};
Flights random_flights(Stream& draw) {
  const auto shape = [&] {
    const double b = draw.uniform(0.3, 1);
    return Ellipse{b * std::pow(10, draw.uniform(0, 1.3)), b};
  };
  const auto flight = [&](const Ellipse& body, const Vec2& position) {
    return Flight<Ellipse>{body,
                           {position, draw.uniform(0, 2 * pi)},
                           {{draw.normal(), draw.normal()}, 2 * draw.normal()}};
  };
  const Ellipse one = shape(), two = shape();
  const double distance = draw.uniform(0.2, 1.2) * (one.a + two.a);
  const Vec2 d = distance * direction(draw.uniform(0, 2 * pi));
  return {flight(one, {0, 0}), flight(two, d)};
}

// Independent slow computation: a fine scan of the support gap. A predicted contact is a contact,
// and the gap is nowhere negative before it (or before the horizon, if there is none).
TEST(FirstContact, NeverLateNeverMissedAgainstAScan) {
  Stream draw(5, Purpose::tests);
  int contacts = 0, misses = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const auto [one, two] = random_flights(draw);
    const double reach = one.body.a + two.body.a;
    const double horizon = 2;
    const bool overlapping = gap_at(one, two, 0) <= 0;
    const Prediction2 touch = predict(one, two, horizon);
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

// A search that begins later, up to the contact itself and with an axis that is about right, finds the same.
TEST(FirstContact, MayBeginWhereThePairIsKnownToBeApart) {
  Stream draw(6, Purpose::tests);
  constexpr double horizon = 2;
  int contacts = 0, misses = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const auto [one, two] = random_flights(draw);
    const double gap = tolerance::contact_gap(one.body.a + two.body.a);
    const Prediction2 whole = first_contact(one, two, horizon, gap);
    if (whole.outcome == Outcome::overlap) continue;
    const bool touch = whole.outcome == Outcome::contact;
    ++(touch ? contacts : misses);
    for (const double share : {0.5, 0.99, 1 - 1e-12, 1.0}) {
      const double begin = share * (touch ? whole.time : horizon);
      const Pose2 pose1 = advanced(one.pose, one.motion, begin),
                  pose2 = advanced(two.pose, two.motion, begin);
      const Vec2 best =
          support_gap(one.body, pose1.angle, two.body, pose2.angle, pose2.position - pose1.position)
              .normal;
      const Vec2 axis = detail::turned(best, 0.1 * draw.normal());
      const Prediction2 rest = first_contact(one, two, horizon, gap, {begin, axis});
      ASSERT_EQ(rest.outcome, whole.outcome) << trial << " from " << begin;
      if (!touch) continue;
      EXPECT_NEAR(rest.time, whole.time, 1e-6);
      EXPECT_NEAR(gap_at(one, two, rest.time), gap, 0.5 * gap);
    }
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
  const Prediction2 touch = first_contact(one, two, 10, gap);
  ASSERT_EQ(touch.outcome, Outcome::contact);
  EXPECT_GT(touch.time, 0);
  EXPECT_GT(gap_at(one, two, touch.time), 0);
}

}  // namespace
}  // namespace vitrel

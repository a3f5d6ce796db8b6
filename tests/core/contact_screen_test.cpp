// The contact screen: pairs that have just collided, axes, lanes. That it is
// never late whatever the axis is judged in tests/bench/contact_screen_truth_test.cpp.

#include "core/contact/ellipse_contact_screen.h"
#include "core/geometry/free_flight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/contact/ellipse_gap.h"
#include "core/contact/ellipsoid_contact_screen.h"
#include "core/random/stream.h"
#include "core/special_values.h"
#include "core/tolerances.h"
#include "tests/support/screen_partners.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;

Vec2 random_direction(Stream& draw) {
  return direction(draw.uniform(0, 2 * pi));
}

/// The times of the first `count` lanes, asked for as a run does: the most urgent first.
template <class Screen>
std::vector<double> times_of(Screen screen, int count) {
  std::vector<double> times(count, infinity);
  double last = 0;
  for (int done = 0; done < count; ++done) {
    const auto [time, lane] = screen.earliest();
    if (time == infinity) break;
    EXPECT_LT(lane, count);
    EXPECT_GE(time, last);
    times[lane] = last = time;
    screen.discard(lane);
  }
  EXPECT_EQ(screen.earliest().time, infinity) << "all are closed";
  return times;
}

// ---- Lanes ----

template <class B>
class LanesOfAScreen : public testing::Test {};
using Bodies = testing::Types<Ellipse, GrowingEllipse>;
TYPED_TEST_SUITE(LanesOfAScreen, Bodies);

/// Returns the screen of a disk at rest at the origin.
template <class B>
ContactScreen<B> screen_at_rest() {
  return {ShapeCoefficients<Ellipse>(Ellipse{1, 1}),
          flight_record<B>({Vec2::Zero(), 0}, {Vec2::Zero(), 0}),
          0,
          {},
          1e-12};
}

// Lanes beyond the count, with bodies that touch at once, have no effect.
TYPED_TEST(LanesOfAScreen, BeyondTheCountNeverWin) {
  constexpr int lanes = ContactScreen<TypeParam>::lanes;
  for (int count = 0; count <= lanes; ++count) {
    ContactScreen<TypeParam> screen = screen_at_rest<TypeParam>();
    ScreenPartners<TypeParam> partners;
    for (int k = 0; k < lanes; ++k)
      partners.set(k, {Vec2(k < count ? 3 + k : 2.001, 0), 0}, {Vec2(-1, 0), 0}, Vec2(1, 0));
    partners.load_into(screen, 100);
    screen.evaluate(count);
    const std::vector<double> times = times_of(screen, count);
    for (int k = 0; k < count; ++k) EXPECT_NEAR(times[k], 1 + k, 1e-9);
  }
}

// Contacts that a partner knows itself, or all if it knows everything, do not matter.
TYPED_TEST(LanesOfAScreen, EndAtWhatThePartnerKnows) {
  constexpr int lanes = ContactScreen<TypeParam>::lanes;
  ContactScreen<TypeParam> screen = screen_at_rest<TypeParam>();
  ScreenPartners<TypeParam> partners;
  const double known_until[] = {infinity, 0.9, 1.1, -infinity};
  for (int k = 0; k < lanes; ++k)
    partners.set(k, {Vec2(3, 0), 0}, {Vec2(-1, 0), 0}, Vec2(1, 0), 0, known_until[k % 4]);
  partners.load_into(screen);
  screen.evaluate(lanes);
  const std::vector<double> times = times_of(screen, lanes);
  for (int k = 0; k < lanes; k += 4) {
    EXPECT_NEAR(times[k], 1, 1e-9);
    EXPECT_EQ(times[k + 1], infinity);
    EXPECT_NEAR(times[k + 2], 1, 1e-9);
    EXPECT_EQ(times[k + 3], infinity);
  }
}

template <class B>
class ClocksOfPartners : public testing::Test {};
using AllBodies = testing::Types<Ellipse, GrowingEllipse, Ellipsoid, GrowingEllipsoid>;
TYPED_TEST_SUITE(ClocksOfPartners, AllBodies);

Pose2 random_pose(Stream& draw, double distance, Vec2& n) {
  n = random_direction(draw);
  return {distance * n, draw.uniform(-10, 10)};
}
Pose3 random_pose(Stream& draw, double distance, Vec3& n) {
  n = Vec3{draw.normal(), draw.normal(), draw.normal()}.normalized();
  return {distance * n,
          Quaternion{draw.normal(), draw.normal(), draw.normal(), draw.normal()}.normalized()};
}
Motion2 random_motion(Stream& draw, const Vec2& n) {
  return {-n + 0.3 * random_direction(draw), 2 * draw.normal()};
}
Motion3 random_motion(Stream& draw, const Vec3& n) {
  const Vec3 turn{draw.normal(), draw.normal(), draw.normal()};
  return {-n + 0.3 * turn.normalized(), draw.uniform() < 0.1 ? Vec3(0, 0, 0) : 2 * turn};
}

// Partners with clocks of their own, and with shapes of their own, count as those advanced to the present.
TYPED_TEST(ClocksOfPartners, AreAdvancedToThePresent) {
  constexpr int dim = TypeParam::dimension, lanes = ContactScreen<TypeParam>::lanes;
  using Shape = BaseShape<TypeParam>;
  Stream draw(37, Purpose::tests);
  const auto shape = [&] {
    if constexpr (dim == 2)
      return Shape{draw.uniform(1, 2), draw.uniform(0.5, 1)};
    else
      return Shape{Vec3{draw.uniform(1, 2), draw.uniform(0.5, 1), draw.uniform(0.5, 1)}};
  };
  const CommonSize common = grows<TypeParam> ? CommonSize{0.9, 0.1} : CommonSize{};
  const double now = 2.5;
  int contacts = 0;
  for (int trial = 0; trial < 500; ++trial) {
    Vec<dim> n;
    const ShapeCoefficients<Shape> coefficients(shape());
    const Pose<dim> pose = random_pose(draw, 0, n);
    const Motion<dim> motion = random_motion(draw, n);
    const auto screen_at = [&](double present) {
      return ContactScreen<TypeParam>(coefficients, flight_record<TypeParam>(pose, motion, present),
                                      present, common, 1e-12);
    };
    ContactScreen<TypeParam> late = screen_at(now), early = screen_at(0);
    ScreenPartners<TypeParam> with_clocks, advanced_partners;
    for (int k = 0; k < lanes; ++k) {
      const double ago = draw.uniform(0, 2);
      const Pose<dim> there = random_pose(draw, 5, n);
      const Motion<dim> theirs = random_motion(draw, n);
      const ShapeCoefficients<Shape> other(shape());
      late.set_shape(k, other);
      early.set_shape(k, other);
      with_clocks.set(k, advanced(there, theirs, -ago), theirs, n, now - ago, now + 3);
      advanced_partners.set(k, there, theirs, n, 0, 3);
    }
    with_clocks.load_into(late);
    advanced_partners.load_into(early);
    late.evaluate(lanes);
    early.evaluate(lanes);
    const std::vector<double> times = times_of(late, lanes), expected = times_of(early, lanes);
    for (int k = 0; k < lanes; ++k) {
      EXPECT_LT((late.warm_start(k).axis - early.warm_start(k).axis).norm(), 1e-12);
      if (expected[k] == infinity) continue;
      EXPECT_NEAR(times[k], expected[k], 1e-9);
      ++contacts;
    }
  }
  EXPECT_GT(contacts, 500);
}

// ---- Ellipses ----

struct EllipsePairAt {
  Ellipse one, two;
  Pose2 pose1;
  Motion2 motion1;
  Pose2 pose2;
  Motion2 motion2;
};

/// Disjoint, the surfaces `gap` apart along the normal `n`.
EllipsePairAt random_pair(Stream& draw, double largest_aspect_ratio, double gap, Vec2& n) {
  const auto shape = [&] {
    const double b = draw.uniform(0.5, 1.5);
    return Ellipse{b * std::pow(largest_aspect_ratio, draw.uniform()), b};
  };
  const auto motion = [&] { return Motion2{{draw.normal(), draw.normal()}, 2 * draw.normal()}; };
  EllipsePairAt pair{shape(), shape(), {}, motion(), {}, motion()};
  pair.pose1 = {Vec2::Zero(), draw.uniform(-10, 10)};
  pair.pose2.angle = draw.uniform(-10, 10);
  n = random_direction(draw);
  pair.pose2.position = surface_point(pair.one, direction(pair.pose1.angle), n) + gap * n -
                        surface_point(pair.two, direction(pair.pose2.angle), -n);
  return pair;
}

template <class B>
ContactScreen<B> evaluated(const EllipsePairAt& pair, const CommonSize& common, double contact_gap,
                           const Vec2& axis, double horizon) {
  ContactScreen<B> screen(ShapeCoefficients<Ellipse>(pair.one),
                          flight_record<B>(pair.pose1, pair.motion1), 0, common, contact_gap);
  ScreenPartners<B> partners;
  for (int k = 0; k < ScreenPartners<B>::lanes; ++k)
    partners.set(k, pair.pose2, pair.motion2, axis);
  screen.set_shape(0, ShapeCoefficients<Ellipse>(pair.two));
  partners.load_into(screen, horizon);
  screen.evaluate(1);
  return screen;
}

/// Returns the earliest time that the screen gives of the pair.
template <class B>
double time_of(const EllipsePairAt& pair, const CommonSize& common, double contact_gap,
               const Vec2& axis, double horizon) {
  return evaluated<B>(pair, common, contact_gap, axis, horizon).earliest().time;
}

/// Speed at which the gap along n changes, and the most by which its rate can fall in a unit of time
/// (without growth): ġ = n·v + Σ ω h', h' = (a² − b²)(u·n)(u·dn/dφ)/h; |h''| ≤ (a² − b²)/b.
double gap_rate(const EllipsePairAt& pair, const Vec2& n) {
  const auto turning = [&](const Ellipse& shape, double angle) {
    const Vec2 u = direction(angle);
    return shape.aa_minus_bb() * u.dot(n) * u.dot(perpendicular(n)) / support(shape, u, n);
  };
  return n.dot(pair.motion2.velocity - pair.motion1.velocity) +
         pair.motion1.angular_velocity * turning(pair.one, pair.pose1.angle) +
         pair.motion2.angular_velocity * turning(pair.two, pair.pose2.angle);
}
double largest_fall(const EllipsePairAt& pair) {
  const auto of = [](const Ellipse& shape, const Motion2& motion) {
    return motion.angular_velocity * motion.angular_velocity * shape.aa_minus_bb() / shape.b;
  };
  return of(pair.one, pair.motion1) + of(pair.two, pair.motion2);
}

// A pair that leaves with the rate ġ > 0 from a gap above the floor keeps above it for at least
// 2 ġ/M: that is what a screen must tell of a pair that has just collided, whose gap then is 0.75 to
// 1.25 contact gaps. (So also after 99 % of the speed are lost.)
TEST(ContactScreenOfEllipses, SettlesAPairThatHasJustCollided) {
  Stream draw(32, Purpose::tests);
  int settled = 0;
  for (int trial = 0; trial < 20'000; ++trial) {
    const double contact_gap = tolerance::contact_gap(20);
    const double gap = draw.uniform(0.75, 1.25) * contact_gap;
    Vec2 n;
    EllipsePairAt pair = random_pair(draw, 10, gap, n);
    const double rate = gap_rate(pair, n);
    if (std::abs(rate) < 1e-3) continue;
    if (rate < 0) {  // time turned round
      for (Motion2* motion : {&pair.motion1, &pair.motion2})
        *motion = {-motion->velocity, -motion->angular_velocity};
    }
    const double apart_until = 2 * std::abs(rate) / largest_fall(pair);
    for (const double horizon : {0.5 * apart_until, 10 * apart_until}) {
      for (const double time : {time_of<Ellipse>(pair, {}, contact_gap, n, horizon),
                                time_of<GrowingEllipse>(pair, {1, 0}, contact_gap, n, horizon)})
        if (horizon < apart_until)
          EXPECT_EQ(time, infinity);
        else
          EXPECT_GE(time, (1 - 1e-9) * apart_until);
    }
    ++settled;
  }
  EXPECT_GT(settled, 19'000);
}

// With the best axis the time is no earlier than that of the plainest bound: the rate of the gap and
// the largest fall of it.
TEST(ContactScreenOfEllipses, LooksAtLeastAsFarAsThePlainBound) {
  Stream draw(33, Purpose::tests);
  for (int trial = 0; trial < 20'000; ++trial) {
    const double contact_gap = tolerance::contact_gap(20);
    const double gap = std::pow(10, draw.uniform(-9, 0));
    Vec2 n;
    const EllipsePairAt pair = random_pair(draw, 10, gap, n);
    const double rate = gap_rate(pair, n), fall = largest_fall(pair);
    const double room = gap - contact_gap;
    const double bound = (rate + std::sqrt(rate * rate + 2 * fall * room)) / fall;
    EXPECT_GE(time_of<Ellipse>(pair, {}, contact_gap, n, 1e3), (1 - 1e-6) * bound);
  }
}

// A step of Newton's method takes an axis that is off by δ to within C δ², C ~ 3 κ at most: from 1e-4
// far closer than a hundredth of that.
TEST(ContactScreenOfEllipses, TurnsAxesToTheBest) {
  Stream draw(34, Purpose::tests);
  for (int trial = 0; trial < 5'000; ++trial) {
    Vec2 n;
    const double gap = draw.uniform(0.01, 1);
    const EllipsePairAt pair = random_pair(draw, 3, gap, n);
    const double off = 1e-4;
    const Vec2 axis = detail::turned(n, trial % 2 ? off : -off);
    for (const Vec2& turned :
         {evaluated<Ellipse>(pair, {}, 1e-12, axis, 1).warm_start(0).axis,
          evaluated<GrowingEllipse>(pair, {1, 0.1}, 1e-12, axis, 1).warm_start(0).axis})
      EXPECT_LT(std::abs(cross(n, turned)), 0.01 * off);
  }
}

// An axis that is longer than 1 by δ makes the gap wrong by about δ (b₁²/h₁ + b₂²/h₂), which the floor
// of half a contact gap, 16 ε of the extent of the box, has to cover like all other rounding. Between
// two loads, which find all axes anew, a pair is evaluated at some hundred times; every turn may make the
// axis longer by half a unit in the last place.
TEST(ContactScreenOfEllipses, AxesStayUnitVectors) {
  Stream draw(35, Purpose::tests);
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const ShapeCoefficients<Ellipse> coefficients(Ellipse{2, 0.7});
  constexpr int lanes = ContactScreen<Ellipse>::lanes;
  std::array<Vec2, lanes> axes;
  for (Vec2& axis : axes) axis = random_direction(draw);
  const auto largest_error = [&] {
    double largest = 0;
    for (const Vec2& axis : axes) largest = std::max(largest, std::abs(axis.norm() - 1));
    return largest;
  };
  for (int turn = 1; turn <= 100'000; ++turn) {
    ContactScreen<Ellipse> screen(
        coefficients, flight_record<Ellipse>({Vec2::Zero(), draw.uniform(-3, 3)}, {{0.1, 0}, 1}), 0,
        {}, 1e-12);
    ScreenPartners<Ellipse> partners;
    for (int k = 0; k < lanes; ++k)
      partners.set(k, {2.9 * random_direction(draw), draw.uniform(-3, 3)}, {{0.3, 0.2}, -1},
                   axes[k]);
    partners.load_into(screen, 1);
    screen.evaluate(lanes);
    for (int k = 0; k < lanes; ++k) axes[k] = screen.warm_start(k).axis;
    if (turn == 100) {
      EXPECT_LT(largest_error(), 16 * epsilon);
    }
  }
  EXPECT_LT(largest_error(), 100'000 * 0.5 * epsilon);
}

// Full turns of a body are no change: angles beyond those of which π is taken off by parts, in one
// lane or as the first body's, against the remainder in extended precision.
TEST(ContactScreenOfEllipses, AnglesMayBeLarge) {
  Stream draw(36, Purpose::tests);
  const auto remainder = [](double angle) {
    return static_cast<double>(
        std::remainder(static_cast<long double>(angle), 2 * std::numbers::pi_v<long double>));
  };
  for (int trial = 0; trial < 3'000; ++trial) {
    Vec2 n;
    EllipsePairAt pair = random_pair(draw, 5, 1, n);
    for (double* angle : {&pair.pose1.angle, &pair.pose2.angle}) {
      const double largest = std::pow(10, draw.uniform(3, 9));
      *angle = draw.uniform(-largest, largest);
    }
    EllipsePairAt same = pair;
    same.pose1.angle = remainder(pair.pose1.angle);
    same.pose2.angle = remainder(pair.pose2.angle);
    pair.pose2.position = same.pose2.position = (pair.one.a + pair.two.a) * n;
    const double time = time_of<Ellipse>(pair, {}, 1e-12, n, 3);
    const double wanted = time_of<Ellipse>(same, {}, 1e-12, n, 3);
    if (wanted == infinity)
      EXPECT_EQ(time, infinity);
    else
      EXPECT_NEAR(time, wanted, 1e-6 * wanted);
  }
}

}  // namespace
}  // namespace vitrel

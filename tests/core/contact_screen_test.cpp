// The contact screen: pairs that have just collided, axes, lanes. That it is
// never late whatever the axis is judged in tests/bench/contact_screen_truth_test.cpp.

#include "core/contact/ellipse_contact_screen.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/contact/ellipse_gap.h"
#include "core/random/stream.h"
#include "core/tolerances.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();

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

// Earlier contents of a lane, and empty lanes, have no effect: bodies that touch
// at once stand in all of them.
TYPED_TEST(LanesOfAScreen, BeyondTheCountNeverWin) {
  constexpr int lanes = ContactScreen<TypeParam>::lanes;
  const ShapeCoefficients<Ellipse> coefficients(Ellipse{1, 1});
  for (const bool filled : {true, false})
    for (int count = 0; count <= lanes; ++count) {
      ContactScreen<TypeParam> screen(coefficients, {Vec2::Zero(), 0}, {Vec2::Zero(), 0}, {},
                                      1e-12);
      for (int k = 0; k < (filled ? lanes : count); ++k)
        screen.set(k, {Vec2(k < count ? 3 + k : 2.001, 0), 0}, {Vec2(-1, 0), 0}, coefficients,
                   {Vec2(1, 0)}, 100);
      screen.evaluate(count);
      const std::vector<double> times = times_of(screen, count);
      for (int k = 0; k < count; ++k) EXPECT_NEAR(times[k], 1 + k, 1e-9);
    }
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
  ContactScreen<B> screen(ShapeCoefficients<Ellipse>(pair.one), pair.pose1, pair.motion1, common,
                          contact_gap);
  screen.set(0, pair.pose2, pair.motion2, ShapeCoefficients<Ellipse>(pair.two), {axis}, horizon);
  screen.evaluate(1);
  return screen;
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
    Vec2 n;
    EllipsePairAt pair = random_pair(draw, 10, draw.uniform(0.75, 1.25) * contact_gap, n);
    const double rate = gap_rate(pair, n);
    if (std::abs(rate) < 1e-3) continue;
    if (rate < 0) {  // time turned round
      for (Motion2* motion : {&pair.motion1, &pair.motion2})
        *motion = {-motion->velocity, -motion->angular_velocity};
    }
    const double apart_until = 2 * std::abs(rate) / largest_fall(pair);
    for (const double horizon : {0.5 * apart_until, 10 * apart_until}) {
      const double still = evaluated<Ellipse>(pair, {}, contact_gap, n, horizon).earliest().time;
      const double grows =
          evaluated<GrowingEllipse>(pair, {1, 0}, contact_gap, n, horizon).earliest().time;
      if (horizon < apart_until) {
        EXPECT_EQ(still, infinity);
        EXPECT_EQ(grows, infinity);
      } else {
        EXPECT_GE(still, (1 - 1e-9) * apart_until);
        EXPECT_GE(grows, (1 - 1e-9) * apart_until);
      }
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
    const double horizon = 1e3;
    EXPECT_GE(evaluated<Ellipse>(pair, {}, contact_gap, n, horizon).earliest().time,
              (1 - 1e-6) * bound);
  }
}

// A step of Newton's method takes an axis that is off by δ to within C δ², C ~ 3 κ at most: from 1e-4
// far closer than a hundredth of that.
TEST(ContactScreenOfEllipses, TurnsAxesToTheBest) {
  Stream draw(34, Purpose::tests);
  for (int trial = 0; trial < 5'000; ++trial) {
    Vec2 n;
    const EllipsePairAt pair = random_pair(draw, 3, draw.uniform(0.01, 1), n);
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
  std::array<Vec2, simd_width> axes;
  for (Vec2& axis : axes) axis = random_direction(draw);
  const auto largest_error = [&] {
    double largest = 0;
    for (const Vec2& axis : axes) largest = std::max(largest, std::abs(axis.norm() - 1));
    return largest;
  };
  for (int turn = 1; turn <= 100'000; ++turn) {
    ContactScreen<Ellipse> screen(coefficients, {Vec2::Zero(), draw.uniform(-3, 3)}, {{0.1, 0}, 1},
                                  {}, 1e-12);
    for (int k = 0; k < simd_width; ++k)
      screen.set(k, {2.9 * random_direction(draw), draw.uniform(-3, 3)}, {{0.3, 0.2}, -1},
                 coefficients, {axes[k]}, 1);
    screen.evaluate(simd_width);
    for (int k = 0; k < simd_width; ++k) axes[k] = screen.warm_start(k).axis;
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
    pair.pose1.angle = draw.uniform(-1, 1) * std::pow(10, draw.uniform(3, 9));
    pair.pose2.angle = draw.uniform(-1, 1) * std::pow(10, draw.uniform(3, 9));
    EllipsePairAt same = pair;
    same.pose1.angle = remainder(pair.pose1.angle);
    same.pose2.angle = remainder(pair.pose2.angle);
    pair.pose2.position = same.pose2.position = (pair.one.a + pair.two.a) * n;
    const double horizon = 3;
    const double time = evaluated<Ellipse>(pair, {}, 1e-12, n, horizon).earliest().time;
    const double wanted = evaluated<Ellipse>(same, {}, 1e-12, n, horizon).earliest().time;
    if (wanted == infinity)
      EXPECT_EQ(time, infinity);
    else
      EXPECT_NEAR(time, wanted, 1e-6 * wanted);
  }
}

}  // namespace
}  // namespace vitrel

// Every method for the collision time: the scene that all can do, closed forms, brackets, derivatives.

#include "bench/methods/method.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <ostream>

#include "bench/methods/bracket.h"
#include "bench/methods/ellipses/ellipse_constraint.h"
#include "bench/methods/ellipses/perram_wertheim_root.h"
#include "bench/methods/ellipses/psi_root.h"
#include "bench/methods/ellipses/unit_circle.h"
#include "bench/methods/opening.h"
#include "core/random/stream.h"
#include "core/special_values.h"

namespace vitrel::bench {

// GoogleTest's name for it.
void PrintTo(const Method& method, std::ostream* out) {
  *out << method.name << " at " << method.tolerance;
}

namespace {

using std::numbers::pi;

CollisionCase scene_of_appendix_b1() {
  return {{{{1, 0.5}, 1, 0}, {{0, 0}, 0}, {{0, 0}, 0}},
          {{{1, 0.5}, 1, 0}, {{1, 1}, 0}, {{-1, 0}, pi}},
          2};
}

Flight<GrowingEllipse> disk(double radius, double size, double growth, Vec2 position,
                            Vec2 velocity) {
  return {{{radius, radius}, size, growth}, {position, 0}, {velocity, 0.7}};
}

Flight<GrowingEllipse> random_flight(Stream& draw, const Vec2& position, bool growing) {
  const double b = draw.uniform(0.5, 1.5);
  const double a = b * draw.uniform(1.01, 6);
  const double growth = growing ? draw.uniform(-0.1, 0.3) : 0;
  return {{{a, b}, growing ? draw.uniform(0.5, 1) : 1, growth},
          {position, draw.uniform(0, 2 * pi)},
          {{draw.normal(), draw.normal()}, 2 * draw.normal()}};
}

CollisionCase random_case(std::uint64_t number) {
  Stream draw(1, Purpose::tests, 3, number);
  const bool growing = number % 2 == 1;
  const double distance = draw.uniform(0.5, 8);
  const double angle = draw.uniform(0, 2 * pi);
  const Vec2 first{draw.normal(), draw.normal()};
  const auto one = random_flight(draw, first, growing);
  const Vec2 second = one.pose.position + distance * Vec2(std::cos(angle), std::sin(angle));
  return {one, random_flight(draw, second, growing), 2};
}

std::string name_of(const testing::TestParamInfo<Method>& method) {
  return method.param.name;
}

// What a method's usual tolerance lets one expect of the time and of the point and normal, in a
// scene where it converges. Penalties and barriers are off by their last parameter, simplices by
// the square root of what they see of the time; annealing is only coarse.
struct Accuracy {
  double time, place;
};
Accuracy accuracy(const std::string& name) {
  if (name == "simulated_annealing") return {0.02, 0.2};
  if (name == "nelder_mead") return {1e-9, 1e-5};
  if (name == "log_barrier" || name == "quadratic_penalty") return {1e-8, 1e-8};
  if (name == "augmented_lagrangian" || name.starts_with("slsqp")) return {1e-9, 1e-8};
  if (name == "separating_axis") return {1e-13, 2e-12};
  return {1e-15, 2e-12};  // roots in double precision
}

class EveryMethod : public testing::TestWithParam<Method> {
 protected:
  Prediction2 predict(const CollisionCase& asked) const { return GetParam().predict(asked); }
  bool round_only() const { return GetParam().name == "circles"; }
  Accuracy within() const { return accuracy(GetParam().name); }

  void expect_contact(const CollisionCase& asked, double time, const Vec2& point,
                      const Vec2& normal) const {
    const Prediction2 answer = predict(asked);
    ASSERT_EQ(answer.outcome, Outcome::contact);
    EXPECT_NEAR(answer.time, time, within().time);
    EXPECT_LT((answer.point - point).norm(), within().place);
    EXPECT_LT((answer.normal - normal).norm(), within().place);
  }
};

INSTANTIATE_TEST_SUITE_P(Methods, EveryMethod, testing::ValuesIn(collision_time_methods()),
                         name_of);

// Reference values in extended precision. The pair touches again at t = 1, from inside the overlap.
TEST_P(EveryMethod, FindsTheContactOfAppendixB1) {
  if (round_only()) {
    EXPECT_EQ(predict(scene_of_appendix_b1()).outcome, Outcome::not_converged);
    return;
  }
  expect_contact(scene_of_appendix_b1(), 0.08472238582199765, {0.3428630757205, 0.4696926950964},
                 {0.179528294643, 0.983752810122});
}

TEST_P(EveryMethod, FindsApproachingDisks) {
  // Centres 7 apart along x and 1 along y, closing at 2: contact where the x distance is √8.
  const CollisionCase asked{disk(1, 1, 0, {0, 0}, {0.5, 0}), disk(2, 1, 0, {7, 1}, {-1.5, 0}), 10};
  const double time = (7 - std::sqrt(8.0)) / 2;
  const Vec2 normal(std::sqrt(8.0) / 3, 1.0 / 3);
  expect_contact(asked, time, Vec2(0.5 * time, 0) + normal, normal);
}

TEST_P(EveryMethod, FindsGrowingDisks) {
  // At rest, 10 apart, radii 1 + 0.5 t and 2 (0.5 + t): contact at 2 + 2.5 t = 10.
  const CollisionCase asked{disk(1, 1, 0.5, {1, 0}, {0, 0}), disk(2, 0.5, 1, {1, 10}, {0, 0}), 10};
  expect_contact(asked, 3.2, {1, 2.6}, {0, 1});
}

TEST_P(EveryMethod, FindsDisksGrowingFromPoints) {
  const CollisionCase asked{disk(1, 0, 1, {0, 0}, {0, 0}), disk(1, 0, 1, {3, 4}, {0, 0}), 10};
  expect_contact(asked, 2.5, {1.5, 2}, {0.6, 0.8});
}

// Perpendicular ellipses meet head-on with their tips: one tip at 2 + 0.2 t, the other at 6 − t.
TEST_P(EveryMethod, FindsGrowingEllipsesMeetingOnAnAxis) {
  if (round_only()) return;
  const CollisionCase asked{{{{2, 1}, 1, 0.1}, {{0, 0}, 0}, {{0, 0}, 0}},
                            {{{2, 1}, 1, 0}, {{7, 0}, pi / 2}, {{-1, 0}, 0}},
                            10};
  const double time = 4 / 1.2;
  expect_contact(asked, time, {2 + 0.2 * time, 0}, {1, 0});
}

TEST_P(EveryMethod, ReportsNothingForPairsThatPart) {
  const CollisionCase disks{disk(1, 1, 0, {0, 0}, {-1, 0}), disk(2, 1, 0, {7, 1}, {2, 0}), 10};
  EXPECT_EQ(predict(disks).outcome, Outcome::none);
  if (round_only()) return;
  CollisionCase ellipses = scene_of_appendix_b1();
  ellipses.two.pose.position = {3, 0.5};
  ellipses.two.motion.velocity = {2, 1};
  EXPECT_EQ(predict(ellipses).outcome, Outcome::none);
}

TEST_P(EveryMethod, SeesOverlapAtTheStart) {
  const CollisionCase disks{disk(1, 1, 0, {0, 0}, {-1, 0}), disk(2, 1, 0.1, {2, 1}, {2, 0}), 10};
  EXPECT_EQ(predict(disks).outcome, Outcome::overlap);
  if (round_only()) return;
  // Crossed: four intersections, Ψ > 0.
  const CollisionCase crossed{{{{3, 0.5}, 1, 0}, {{0, 0}, 0}, {{0, 0}, 1}},
                              {{{3, 0.5}, 1, 0}, {{0.3, 0.1}, pi / 2}, {{1, 0}, -1}},
                              2};
  EXPECT_EQ(predict(crossed).outcome, Outcome::overlap);
}

// Whatever is asked, an answer comes, and a contact is a finite one within the horizon.
TEST_P(EveryMethod, SurvivesAnything) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<CollisionCase> odd(13, scene_of_appendix_b1());
  odd[0].one.pose.position.x() = nan;
  odd[1].two.motion.velocity.x() = infinity;
  odd[2].horizon = nan;
  odd[3].horizon = 0;
  odd[4].horizon = -1;
  odd[5].two.pose.position = {0, 0};                // concentric
  odd[6].one.body.size = odd[6].two.body.size = 0;  // two points that never grow
  odd[7].one.body.size = 0;                         // a point that grows in front of an ellipse
  odd[7].one.body.growth_rate = 0.5;
  odd[8].two.motion.velocity = {0, 0};  // at rest, touching circumcircles
  odd[8].two.motion.angular_velocity = 0;
  odd[9].one.body.growth_rate = -1;  // gone at t = 1
  odd[10].one.body.shape = {1e3, 1e-3};
  odd[11].two.motion.angular_velocity = 1e6;
  odd[12].one.body.shape = {1e-8, 1e-9};
  for (const CollisionCase& asked : odd) {
    const Prediction2 answer = predict(asked);
    if (answer.outcome != Outcome::contact) continue;
    EXPECT_GE(answer.time, 0);
    EXPECT_LE(answer.time, asked.horizon);
    EXPECT_TRUE(answer.point.allFinite());
    EXPECT_NEAR(answer.normal.norm(), 1, 1e-12);
  }
}

// A local optimiser may answer "none" or find a later contact, but a contact it reports
// must lie between the times of the circles.
TEST_P(EveryMethod, AnswersWithinTheBracket) {
  const int cases = GetParam().name == "simulated_annealing" ? 50 : 300;
  int contacts = 0;
  for (int number = 0; number < cases; ++number) {
    const CollisionCase asked = random_case(number);
    const Prediction2 answer = predict(asked);
    if (answer.outcome != Outcome::contact) continue;
    ++contacts;
    const auto bracket = bracket_contact(asked);
    ASSERT_TRUE(bracket) << number;
    EXPECT_GE(answer.time, bracket->earliest - 1e-12) << number;
    EXPECT_LE(answer.time, bracket->latest + 1e-12) << number;
  }
  EXPECT_EQ(contacts > 0, !round_only());
}

// The roots share neither function nor refinement; where all three see a contact it is the same.
TEST(CollisionTimeMethods, RootsAgree) {
  int contacts = 0;
  for (int number = 0; number < 1000; ++number) {
    const CollisionCase asked = random_case(number);
    const Prediction2 psi = psi_root(asked, 1.0 / 300);
    const Prediction2 perram = perram_wertheim_root(asked, 1.0 / 300);
    const Prediction2 circle = unit_circle(asked, 1.0 / 300);
    ASSERT_EQ(psi.outcome, perram.outcome) << number;
    ASSERT_EQ(psi.outcome, circle.outcome) << number;
    if (psi.outcome != Outcome::contact) continue;
    ++contacts;
    // A relative error of F of some 1e-15 over a slope that is rarely below 1e-3.
    EXPECT_NEAR(psi.time, perram.time, 1e-11) << number;
    EXPECT_NEAR(psi.time, circle.time, 1e-11) << number;
    EXPECT_LT((psi.point - circle.point).norm(), 1e-6) << number;
    EXPECT_LT((psi.normal - circle.normal).norm(), 1e-6) << number;
  }
  EXPECT_GT(contacts, 100);
}

// Outer circles overlap exactly from `begin` to `end`: looked at in many places.
TEST(Bracket, OverlapOfCirclesIsOneInterval) {
  Stream draw(1, Purpose::tests, 4);
  int overlaps = 0;
  for (int pair = 0; pair < 1000; ++pair) {
    const Vec2 d{3 * draw.normal(), 3 * draw.normal()};
    const Vec2 v{draw.normal(), draw.normal()};
    const double radius = draw.uniform(0, 2);
    const double growth = pair % 3 == 0 ? 0 : draw.uniform(-0.5 * radius, 3);
    const auto overlap = circle_overlap(d, v, radius, growth, 2);
    overlaps += overlap.has_value();
    for (int k = 0; k <= 200; ++k) {
      const double time = k / 100.0;
      const double gap = (d + v * time).norm() - radius - growth * time;
      if (std::abs(gap) < 1e-9) continue;
      const bool inside = overlap && time >= overlap->begin && time <= overlap->end;
      EXPECT_EQ(gap < 0, inside) << pair << ' ' << time;
    }
  }
  EXPECT_GT(overlaps, 100);
}

// Central differences of step h: errors h² of the third derivative and ε/h of rounding.
TEST(EllipseConstraint, DerivativesAreThoseOfItsValue) {
  constexpr double h = 1e-5;
  for (int number = 0; number < 100; ++number) {
    const CollisionCase asked = random_case(number);
    const EllipseConstraint constraint(asked.one);
    Stream draw(1, Purpose::tests, 5, number);
    const double time = draw.uniform(0, 2);
    const Vec2 point{2 * draw.normal(), 2 * draw.normal()};
    const EllipseFunction e = constraint.with_hessian(time, point);
    Vec3 gradient;
    const double scale = 1 + e.hessian.norm() + e.gradient.norm() + std::abs(e.value);
    EXPECT_NEAR(constraint.value(time, point), e.value, 1e-13 * scale);
    EXPECT_NEAR(constraint.value(time, point, gradient), e.value, 1e-13 * scale);
    EXPECT_LT((gradient - e.gradient).norm(), 1e-13 * scale);
    for (int k = 0; k < 3; ++k) {
      const Vec3 step = h * Vec3::Unit(k);
      Vec3 above, below;
      const double difference = constraint.value(time + step[0], point + step.tail<2>(), above) -
                                constraint.value(time - step[0], point - step.tail<2>(), below);
      EXPECT_NEAR(difference / (2 * h), e.gradient[k], 1e-6 * scale) << number << ' ' << k;
      EXPECT_LT(((above - below) / (2 * h) - e.hessian.col(k)).norm(), 1e-6 * scale)
          << number << ' ' << k;
    }
  }
}

TEST(PerramWertheimRate, IsTheDerivativeOfTheValue) {
  constexpr double h = 1e-5;
  for (int number = 0; number < 300; ++number) {
    const CollisionCase asked = random_case(number);
    const double time = 1.0;
    const PerramWertheimRate rate = perram_wertheim_rate(asked, time);
    const double above = perram_wertheim_at(asked, time + h).value;
    const double below = perram_wertheim_at(asked, time - h).value;
    EXPECT_NEAR(rate.value, perram_wertheim_at(asked, time).value, 1e-13 * rate.value);
    EXPECT_NEAR(rate.slope, (above - below) / (2 * h),
                1e-6 * (1 + rate.value + std::abs(rate.slope)));
  }
}

// The eigenvalue problem against a walk around the ellipse.
TEST(ClosestToOrigin, IsClosestOfTheBoundary) {
  Stream draw(1, Purpose::tests, 6);
  for (int ellipse = 0; ellipse < 300; ++ellipse) {
    Mat2 m;
    m << draw.normal(), draw.normal(), draw.normal(), draw.normal();
    Vec2 c{2 * draw.normal(), 2 * draw.normal()};
    if (ellipse % 10 == 1) m = Vec2(draw.uniform(1, 3), 1).asDiagonal();
    if (ellipse % 10 == 1) c = {0, draw.uniform(0, 3)};  // the origin on an axis: the hard case
    if (ellipse % 10 == 2) c = {0, 0};
    const ClosestPoint closest = closest_to_origin(c, m);
    double least = 1e300;
    for (int k = 0; k < 20000; ++k) {
      const double angle = 2 * pi * k / 20000;
      least = std::min(least, (c + m * Vec2(std::cos(angle), std::sin(angle))).norm());
    }
    // The walk's step, at most 3e-4 · 5, misses the closest point sideways by half of that: the distance
    // is off by the square of that over twice the distance and the radius of curvature.
    const double off = 1e-6 + std::min(1e-3, 1e-6 / least);
    EXPECT_NEAR(std::abs(closest.distance), least, off) << ellipse;
    EXPECT_NEAR(closest.point.norm(), std::abs(closest.distance), 1e-12);
    EXPECT_EQ(closest.distance < 0, (m.inverse() * c).norm() < 1) << ellipse;
  }
}

TEST(ClosestToOrigin, TellsOverlapLikePerramAndWertheim) {
  int overlaps = 0;
  for (int number = 0; number < 3000; ++number) {
    CollisionCase asked = random_case(number);
    const Vec2 d = asked.two.pose.position - asked.one.pose.position;
    const double angle1 = asked.one.pose.angle;
    const Ellipse one = body_at(asked.one, 0);
    const Ellipse two = body_at(asked.two, 0);
    const Mat2 to_circle =
        Vec2(1 / one.a, 1 / one.b).asDiagonal() * Eigen::Rotation2Dd(-angle1).toRotationMatrix();
    const Mat2 m = to_circle * Eigen::Rotation2Dd(asked.two.pose.angle).toRotationMatrix() *
                   Vec2(two.a, two.b).asDiagonal();
    const double f = perram_wertheim_at(asked, 0).value;
    if (std::abs(f - 1) < 1e-12) continue;
    overlaps += f < 1;
    EXPECT_EQ(closest_to_origin(to_circle * d, m).distance > 1, f > 1) << number;
  }
  EXPECT_GT(overlaps, 300);
  EXPECT_LT(overlaps, 2700);
}

TEST(CollisionTimeMethods, RegistryNamesEachOnceAndSeriesContainThem) {
  const auto methods = collision_time_methods();
  ASSERT_EQ(methods.front().name, "separating_axis");
  EXPECT_EQ(methods.size(), 12u);
  const auto series = collision_time_methods_by_tolerance();
  for (const Method& method : methods) {
    const auto same = [&](const Method& other) {
      return other.name == method.name && other.tolerance == method.tolerance;
    };
    EXPECT_EQ(std::count_if(series.begin(), series.end(), same), 1) << method.name;
  }
}

}  // namespace
}  // namespace vitrel::bench

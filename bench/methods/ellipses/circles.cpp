#include "bench/methods/ellipses/circles.h"

#include <cmath>

#include "bench/methods/opening.h"

namespace vitrel::bench {

Prediction2 circles(const CollisionCase& asked, double) {
  const GrowingEllipse& one = asked.one.body;
  const GrowingEllipse& two = asked.two.body;
  if (!is_sound(asked) || !one.shape.is_round() || !two.shape.is_round())
    return {Outcome::not_converged};
  const Vec2 d = asked.two.pose.position - asked.one.pose.position;
  const Vec2 v = asked.two.motion.velocity - asked.one.motion.velocity;
  const double reach = one.circumradius() + two.circumradius();
  if (d.norm() < reach) return {Outcome::overlap};

  const double growth = one.growth_rate * one.shape.a + two.growth_rate * two.shape.a;
  const auto overlap = circle_overlap(d, v, reach, growth, asked.horizon);
  // Circles that touch at the start and do not approach separate at once.
  if (!overlap || overlap->end == 0) return {};
  const double time = overlap->begin;
  const Vec2 normal = (d + v * time).normalized();
  const Vec2 centre = asked.one.pose.position + asked.one.motion.velocity * time;
  return {Outcome::contact, time, normal, centre + body_at(asked.one, time).a * normal, 1};
}

}  // namespace vitrel::bench

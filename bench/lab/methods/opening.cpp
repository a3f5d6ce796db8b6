#include "bench/lab/methods/opening.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vitrel::lab {
namespace {

double angle_at(const Flight<GrowingEllipse>& flight, double time) {
  return flight.pose.angle + flight.motion.angular_velocity * time;
}

Vec2 separation_at(const CollisionCase& asked, double time) {
  return asked.two.pose.position - asked.one.pose.position +
         (asked.two.motion.velocity - asked.one.motion.velocity) * time;
}

bool is_sound(const Flight<GrowingEllipse>& flight) {
  const Ellipse& shape = flight.body.shape;
  return std::isfinite(shape.a) && shape.a >= shape.b && shape.b > 0 &&
         std::isfinite(flight.body.size) && flight.body.size >= 0 &&
         std::isfinite(flight.body.growth_rate) && flight.pose.position.allFinite() &&
         std::isfinite(flight.pose.angle) && flight.motion.velocity.allFinite() &&
         std::isfinite(flight.motion.angular_velocity);
}

}  // namespace

Ellipse body_at(const Flight<GrowingEllipse>& flight, double time) {
  const double size = std::max(flight.body.size_at(time), smallest_size);
  return {flight.body.shape.a * size, flight.body.shape.b * size};
}

VieillardBaron<double> vieillard_baron_at(const CollisionCase& asked, double time) {
  return vieillard_baron(body_at(asked.one, time), angle_at(asked.one, time),
                         body_at(asked.two, time), angle_at(asked.two, time),
                         separation_at(asked, time));
}

PerramWertheim<2> perram_wertheim_at(const CollisionCase& asked, double time) {
  return perram_wertheim(body_at(asked.one, time), angle_at(asked.one, time),
                         body_at(asked.two, time), angle_at(asked.two, time),
                         separation_at(asked, time));
}

bool overlaps_at_start(const CollisionCase& asked) {
  return !vieillard_baron_at(asked, 0).disjoint_or_touching();
}

Prediction2 without_contact(Outcome outcome, int steps) {
  return {outcome, 0, Vec2::Zero(), Vec2::Zero(), steps};
}

Prediction2 contact_along(const Vec2& outward, double time, const Vec2& point, int steps) {
  const Vec2 normal = outward.stableNormalized();
  if (!normal.allFinite() || normal.isZero()) return without_contact(Outcome::not_converged, steps);
  return {Outcome::contact, time, normal, point, steps};
}

Prediction2 contact_at(const CollisionCase& asked, double time, int steps) {
  const PerramWertheim<2> touch = perram_wertheim_at(asked, time);
  const Vec2 centre = asked.one.pose.position + asked.one.motion.velocity * time;
  return {Outcome::contact, time, touch.normal, centre + touch.point, steps};
}

bool is_sound(const CollisionCase& asked) {
  return is_sound(asked.one) && is_sound(asked.two) && std::isfinite(asked.horizon);
}

Opening open_search(const CollisionCase& asked) {
  const auto answer = [](Outcome outcome) { return Opening{Prediction2{outcome}, {}}; };
  if (!is_sound(asked)) return answer(Outcome::not_converged);
  const auto bracket = bracket_contact(asked);
  if (!bracket) return answer(Outcome::none);
  if (bracket->earliest == 0 && overlaps_at_start(asked)) return answer(Outcome::overlap);
  const double rounding = 4 * std::numeric_limits<double>::epsilon() * bracket->latest;
  if (bracket->duration() > rounding) return {std::nullopt, *bracket};
  if (bracket->certain) return {contact_at(asked, bracket->earliest, 0), *bracket};
  return answer(Outcome::none);
}

}  // namespace vitrel::lab

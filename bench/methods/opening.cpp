#include "bench/methods/opening.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/free_flight.h"

namespace vitrel::bench {
namespace {

template <int Dim>
Pose<Dim> steadily_rotated(const CollisionCaseOf<Dim>& asked, int body, double time) {
  const Flight<GrowingBody<Dim>>& flight = body == 0 ? asked.one : asked.two;
  return advanced(flight.pose, flight.motion, time);
}

template <int Dim>
Vec<Dim> separation_at(const CollisionCaseOf<Dim>& asked, double time) {
  return asked.two.pose.position - asked.one.pose.position +
         (asked.two.motion.velocity - asked.one.motion.velocity) * time;
}

bool overlap(const CollisionCase& asked, double time) {
  return !vieillard_baron_at(asked, time).disjoint_or_touching();
}
bool overlap(const EllipsoidCase& asked, double time) {
  return !ellipsoid_eta_at(asked, time).disjoint_or_touching();
}

bool is_sound(const Ellipse& shape) {
  return std::isfinite(shape.a) && shape.a >= shape.b && shape.b > 0;
}
bool is_sound(const Ellipsoid& shape) {
  return shape.semi_axes.allFinite() && shape.inradius() > 0;
}

bool is_finite(double number) {
  return std::isfinite(number);
}
bool is_finite(const Vec3& vector) {
  return vector.allFinite();
}
bool is_finite(const Quaternion& quaternion) {
  return quaternion.coeffs().allFinite();
}

template <int Dim>
bool is_sound_flight(const Flight<GrowingBody<Dim>>& flight) {
  return is_sound(flight.body.shape) && std::isfinite(flight.body.size) && flight.body.size >= 0 &&
         std::isfinite(flight.body.growth_rate) && flight.pose.position.allFinite() &&
         is_finite(orientation_of(flight.pose)) && flight.motion.velocity.allFinite() &&
         is_finite(flight.motion.angular_velocity);
}

}  // namespace

Pose2 pose_at(const CollisionCase& asked, int body, double time) {
  return steadily_rotated(asked, body, time);
}

Pose3 pose_at(const EllipsoidCase& asked, int body, double time) {
  if (!asked.tumbles()) return steadily_rotated(asked, body, time);
  const Flight<TumblingEllipsoid>& flight = asked.tumbling[body];
  return {flight.pose.position + flight.motion.velocity * time,
          Quaternion(flight.top.at(time).axes)};
}

VieillardBaron<double> vieillard_baron_at(const CollisionCase& asked, double time) {
  return vieillard_baron(body_at(asked.one, time), pose_at(asked, 0, time).angle,
                         body_at(asked.two, time), pose_at(asked, 1, time).angle,
                         separation_at(asked, time));
}

EllipsoidEta<double> ellipsoid_eta_at(const EllipsoidCase& asked, double time) {
  return ellipsoid_eta(body_at(asked.one, time), pose_at(asked, 0, time).orientation,
                       body_at(asked.two, time), pose_at(asked, 1, time).orientation,
                       separation_at(asked, time));
}

template <int Dim>
PerramWertheim<Dim> perram_wertheim_at(const CollisionCaseOf<Dim>& asked, double time) {
  return perram_wertheim(body_at(asked.one, time), orientation_of(pose_at(asked, 0, time)),
                         body_at(asked.two, time), orientation_of(pose_at(asked, 1, time)),
                         separation_at(asked, time));
}

template <int Dim>
bool overlaps_at_start(const CollisionCaseOf<Dim>& asked) {
  return overlap(asked, 0);
}

Prediction2 contact_along(const Vec2& outward, double time, const Vec2& point, int steps) {
  const Vec2 normal = outward.stableNormalized();
  if (!normal.allFinite() || normal.isZero()) return without_contact(Outcome::not_converged, steps);
  return {Outcome::contact, time, normal, point, steps};
}

template <int Dim>
Prediction<Dim> contact_at(const CollisionCaseOf<Dim>& asked, double time, int steps) {
  const PerramWertheim<Dim> touch = perram_wertheim_at(asked, time);
  const Vec<Dim> centre = asked.one.pose.position + asked.one.motion.velocity * time;
  return {Outcome::contact, time, touch.normal, centre + touch.point, steps};
}

template <int Dim>
bool is_sound(const CollisionCaseOf<Dim>& asked) {
  return is_sound_flight<Dim>(asked.one) && is_sound_flight<Dim>(asked.two) &&
         std::isfinite(asked.horizon);
}

template <int Dim>
OpeningOf<Dim> open_search(const CollisionCaseOf<Dim>& asked) {
  const auto answer = [](Outcome outcome) { return OpeningOf<Dim>{Prediction<Dim>{outcome}, {}}; };
  if (!is_sound(asked)) return answer(Outcome::not_converged);
  const auto bracket = bracket_contact(asked);
  if (!bracket) return answer(Outcome::none);
  if (bracket->earliest == 0 && overlaps_at_start(asked)) return answer(Outcome::overlap);
  const double rounding = 4 * std::numeric_limits<double>::epsilon() * bracket->latest;
  if (bracket->duration() > rounding) return {std::nullopt, *bracket};
  if (bracket->certain) return {contact_at(asked, bracket->earliest, 0), *bracket};
  return answer(Outcome::none);
}

template PerramWertheim<2> perram_wertheim_at(const CollisionCase&, double);
template PerramWertheim<3> perram_wertheim_at(const EllipsoidCase&, double);
template bool overlaps_at_start(const CollisionCase&);
template bool overlaps_at_start(const EllipsoidCase&);
template Prediction2 contact_at(const CollisionCase&, double, int);
template Prediction3 contact_at(const EllipsoidCase&, double, int);
template bool is_sound(const CollisionCase&);
template bool is_sound(const EllipsoidCase&);
template Opening open_search(const CollisionCase&);
template OpeningOf<3> open_search(const EllipsoidCase&);

}  // namespace vitrel::bench

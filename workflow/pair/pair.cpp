#include "workflow/pair/pair.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/contact/ellipse_gap.h"
#include "core/contact/ellipsoid_gap.h"
#include "core/contact/perram_wertheim.h"
#include "core/elementary.h"
#include "core/error.h"
#include "core/geometry/free_flight.h"
#include "core/geometry/tumbling_ellipsoid.h"
#include "core/special_values.h"
#include "core/state/exact_pair.h"
#include "core/tolerances.h"

namespace vitrel {
namespace {

/// Converts components to a vector; no components mean zero.
template <int Dim>
Vec<Dim> vector_of(const std::vector<double>& components) {
  if (components.empty()) return Vec<Dim>::Zero();
  return Eigen::Map<const Vec<Dim>>(components.data());
}

Flight<Ellipse> flight_of(const BodyParameters& p, const Ellipse&) {
  return {{p.semi_axes[0], p.semi_axes[1]},
          {vector_of<2>(p.position), p.angle},
          {vector_of<2>(p.velocity), p.angular_velocity[0]}};
}

Flight<Ellipsoid> flight_of(const BodyParameters& p, const Ellipsoid&) {
  const auto& [w, x, y, z] = p.orientation;
  const bool turns = p.angular_velocity.size() == 3;
  return {{vector_of<3>(p.semi_axes)},
          {vector_of<3>(p.position), normalized(Quaternion(w, x, y, z))},
          {vector_of<3>(p.velocity), turns ? vector_of<3>(p.angular_velocity) : Vec3::Zero()}};
}

Flight<TumblingEllipsoid> tumbling(const Flight<Ellipsoid>& flight) {
  return {TumblingEllipsoid{flight.body}, flight.pose, flight.motion};
}

bool is_scalene(const Ellipse&) {
  return false;
}
bool is_scalene(const Ellipsoid& body) {
  return body.is_scalene();
}

template <int Dim>
Pose<Dim> pose_at(const Pair<Dim>& pair, const Flight<ParticleShape<Dim>>& flight, double time) {
  if constexpr (Dim == 3)
    if (pair.tumbles()) return vitrel::pose_at(tumbling(flight), time);
  return vitrel::pose_at(flight, time);
}

Vec2 surface_point(const Ellipse& ellipse, double angle, const Vec2& n) {
  const auto [cosine, sine] = cosine_and_sine(angle);
  return vitrel::surface_point(ellipse, {cosine, sine}, n);
}

VieillardBaron<double> criterion(const Ellipse& one, double angle1, const Ellipse& two,
                                 double angle2, const Vec2& d) {
  return vieillard_baron(one, angle1, two, angle2, d);
}
EllipsoidEta<double> criterion(const Ellipsoid& one, const Quaternion& orientation1,
                               const Ellipsoid& two, const Quaternion& orientation2,
                               const Vec3& d) {
  return ellipsoid_eta(one, orientation1, two, orientation2, d);
}

/// Calls visit(shift) for all images of body 2 within `reach` of body 1. d is the separation of the bodies
/// themselves.
template <int Dim, class Visit>
void for_each_image(const Pair<Dim>& pair, const Vec<Dim>& d, double reach, Visit&& visit) {
  if (!pair.box) return visit(Shift<Dim>::Zero());
  pair.box->for_each_image(d, reach,
                           [&](const Shift<Dim>& shift, const Vec<Dim>&) { visit(shift); });
}

/// Images whose centres are no farther apart than this may have the smallest gap, because |d| less the circumradii ≤
/// gap ≤ |d| less the inradii.
template <int Dim>
double reach_of_smallest_gap(const Pair<Dim>& pair, const Vec<Dim>& d) {
  if (!pair.box) return 0;
  const ParticleShape<Dim>&one = pair.one.body, &two = pair.two.body;
  const double nearest = (d + pair.box->translation(pair.box->nearest_shift(d))).norm();
  const double reach =
      nearest + one.circumradius() - one.inradius() + two.circumradius() - two.inradius();
  return reach * (1 + 1e-12);
}

/// The vector from centre 1 to the centre of the given image of body 2, in extended precision.
template <int Dim>
exact::Point<Dim> exact_separation(const Pair<Dim>& pair, const exact::Particle<Dim>& one,
                                   const exact::Particle<Dim>& two, const Shift<Dim>& shift) {
  exact::Point<Dim> d = two.centre - one.centre;
  if (pair.box)
    d +=
        shift.template cast<Extended>().cwiseProduct(pair.box->lengths().template cast<Extended>());
  return d;
}

/// Adds the normal and the closest points; d is the separation of the centres.
template <int Dim>
void add_closest_points(const ParticleShape<Dim>& one, const Pose<Dim>& pose1,
                        const ParticleShape<Dim>& two, const Pose<Dim>& pose2, const Vec<Dim>& d,
                        PairGap<Dim>& gap) {
  const auto orientation1 = orientation_of(pose1), orientation2 = orientation_of(pose2);
  gap.normal = support_gap(one, orientation1, two, orientation2, d).normal;
  gap.point1 = pose1.position + surface_point(one, orientation1, gap.normal);
  gap.point2 = pose1.position + d - surface_point(two, orientation2, gap.normal);
}

template <class B>
Prediction<B::dimension> converged_contact(const Flight<B>& one, const Flight<B>& two,
                                           double horizon, double contact_gap) {
  auto found = first_contact(one, two, horizon, contact_gap);
  while (found.outcome == Outcome::not_converged)
    found = first_contact(one, two, horizon, contact_gap, {found.time, found.normal});
  return found;
}

template <int Dim>
Prediction<Dim> predict_as_the_engine(const Pair<Dim>& pair) {
  const double extent = std::max({pair.one.body.circumradius() + pair.two.body.circumradius(),
                                  pair.one.pose.position.cwiseAbs().maxCoeff(),
                                  pair.two.pose.position.cwiseAbs().maxCoeff()});
  const double contact_gap = tolerance::contact_gap(extent);
  if constexpr (Dim == 3)
    if (pair.tumbles())
      return converged_contact(tumbling(pair.one), tumbling(pair.two), pair.horizon, contact_gap);
  return converged_contact(pair.one, pair.two, pair.horizon, contact_gap);
}

double norm(double angular_velocity) {
  return std::abs(angular_velocity);
}
double norm(const Vec3& angular_velocity) {
  return angular_velocity.norm();
}

/// A search takes a few steps per radian, so the number of radians must be limited.
template <int Dim>
void require_few_rotations(const Pair<Dim>& pair) {
  constexpr double max_radians = 1e6;  // so that angles keep ten digits
  for (const Flight<ParticleShape<Dim>>* flight : {&pair.one, &pair.two}) {
    const double radians = norm(flight->motion.angular_velocity) * pair.horizon;
    if (!(radians <= max_radians))
      throw UserError(
          fmt::format("a body turns by {:.3g} radians until the horizon, but at most {:g} are "
                      "possible; lower horizon or angular_velocity",
                      radians, max_radians));
  }
}

/// Finds the first contact up to `end` with any image of body 2 that lies within `reach` of body 1 when the body itself
/// has the separation d.
template <int Dim>
PairContact<Dim> earliest_contact(const Pair<Dim>& pair, const PredictContact<Dim>& predict,
                                  double end, const Vec<Dim>& d, double reach) {
  PairContact<Dim> earliest;
  Pair<Dim> alone = pair;
  alone.box.reset();
  alone.horizon = end;
  for_each_image(pair, d, reach, [&](const Shift<Dim>& shift) {
    if (pair.box) alone.two.pose.position = pair.two.pose.position + pair.box->translation(shift);
    const Prediction<Dim> found = predict(alone);
    const bool is_first =
        earliest.prediction.outcome == Outcome::none || found.time < earliest.prediction.time;
    if (found.outcome != Outcome::none && is_first) earliest = {found, shift};
  });
  return earliest;
}

}  // namespace

template <int Dim>
bool Pair<Dim>::tumbles() const {
  return rotation == FreeRotation::euler && (is_scalene(one.body) || is_scalene(two.body));
}

template <int Dim>
Pair<Dim> pair_of(const PairParameters& p) {
  Pair<Dim> pair{flight_of(p.body[0], ParticleShape<Dim>()),
                 flight_of(p.body[1], ParticleShape<Dim>()), std::nullopt, p.horizon, p.rotation};
  if (p.box) pair.box.emplace(vector_of<Dim>(*p.box));
  return pair;
}

template <int Dim>
bool overlaps(const Pair<Dim>& pair) {
  const Vec<Dim> d = pair.two.pose.position - pair.one.pose.position;
  const double touch = pair.one.body.circumradius() + pair.two.body.circumradius();
  const double reach = touch + 1e-12 * (touch + d.norm());  // more than rounding can change
  if (!pair.box && d.norm() > reach) return false;
  const auto one = exact::particle(pair.one.body, pair.one.pose);
  const auto two = exact::particle(pair.two.body, pair.two.pose);
  constexpr double any_gap = -std::numeric_limits<double>::infinity();
  bool found = false;
  for_each_image(pair, d, reach, [&](const Shift<Dim>& shift) {
    found =
        found || exact::examine(one, two, exact_separation(pair, one, two, shift), any_gap).overlap;
  });
  return found;
}

template <int Dim>
PairGap<Dim> gap_at(const Pair<Dim>& pair, double time) {
  const ParticleShape<Dim>&body1 = pair.one.body, &body2 = pair.two.body;
  const Pose<Dim> pose1 = pose_at(pair, pair.one, time), pose2 = pose_at(pair, pair.two, time);
  const auto one = exact::particle(body1, pose1), two = exact::particle(body2, pose2);
  const Vec<Dim> d = pose2.position - pose1.position;
  PairGap<Dim> closest;
  closest.gap = infinity;
  for_each_image(pair, d, reach_of_smallest_gap(pair, d), [&](const Shift<Dim>& shift) {
    const auto found = exact::examine(one, two, exact_separation(pair, one, two, shift), infinity);
    if (!(found.gap < closest.gap)) return;
    closest.overlap = found.overlap;
    closest.gap = static_cast<double>(found.gap);
    closest.image = shift;
  });
  const Vec<Dim> nearest = pair.box ? Vec<Dim>(d + pair.box->translation(closest.image)) : d;
  const auto orientation1 = orientation_of(pose1), orientation2 = orientation_of(pose2);
  closest.touching_scale =
      std::sqrt(perram_wertheim(body1, orientation1, body2, orientation2, nearest).value);
  closest.criterion = criterion(body1, orientation1, body2, orientation2, nearest);
  if (!closest.overlap) add_closest_points<Dim>(body1, pose1, body2, pose2, nearest, closest);
  return closest;
}

template <int Dim>
PairContact<Dim> first_contact_of_images(const Pair<Dim>& pair,
                                         const PredictContact<Dim>& predict) {
  require_few_rotations(pair);
  const Vec<Dim> d = pair.two.pose.position - pair.one.pose.position;
  const Vec<Dim> v = pair.two.motion.velocity - pair.one.motion.velocity;
  const double touch = pair.one.body.circumradius() + pair.two.body.circumradius();
  // In each step the bodies move by no more than a side of the box, so that few images come within reach.
  const double side = pair.box ? pair.box->lengths().minCoeff() : 0;
  const double steps = pair.box ? std::max(1.0, std::ceil(v.norm() * pair.horizon / side)) : 1;
  const double duration = pair.horizon / steps;
  for (double step = 1;; ++step) {
    const double end = step < steps ? step * duration : pair.horizon;
    const Vec<Dim> middle = d + v * ((step - 0.5) * duration);
    const PairContact<Dim> found = earliest_contact(pair, predict, end, middle, touch + side);
    if (found.prediction.outcome != Outcome::none || step >= steps) return found;
  }
}

template <int Dim>
PairContact<Dim> first_contact(const Pair<Dim>& pair) {
  if (!pair.box) {
    require_few_rotations(pair);
    return {predict_as_the_engine(pair)};
  }
  return first_contact_of_images<Dim>(pair, predict_as_the_engine<Dim>);
}

template struct Pair<2>;
template struct Pair<3>;
template Pair<2> pair_of(const PairParameters&);
template Pair<3> pair_of(const PairParameters&);
template bool overlaps(const Pair<2>&);
template bool overlaps(const Pair<3>&);
template PairGap<2> gap_at(const Pair<2>&, double);
template PairGap<3> gap_at(const Pair<3>&, double);
template PairContact<2> first_contact_of_images(const Pair<2>&, const PredictContact<2>&);
template PairContact<3> first_contact_of_images(const Pair<3>&, const PredictContact<3>&);
template PairContact<2> first_contact(const Pair<2>&);
template PairContact<3> first_contact(const Pair<3>&);

}  // namespace vitrel

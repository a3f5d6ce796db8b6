#pragma once

#include <cmath>

#include "bench/methods/opening.h"
#include "bench/surveys/drawn_class.h"
#include "bench/surveys/verdict.h"
#include "core/geometry/free_flight.h"

/// @file
/// Places the two bodies of a case, and says when and how they meet.
namespace vitrel::bench {

template <int Dim>
using Moving = Flight<GrowingBody<Dim>>;

template <int Dim>
bool disjoint_at(const CollisionCaseOf<Dim>& pair, double time) {
  return perram_wertheim_at(pair, time).disjoint();
}

template <int Dim>
bool disjoint_at_samples(const CollisionCaseOf<Dim>& pair, double until, int samples) {
  for (int k = 0; k < samples; ++k)
    if (!disjoint_at(pair, k * until / samples)) return false;
  return true;
}

/// Places the second body near the first until the two are disjoint. The direction is random, and the distance of the
/// centres is uniform between `nearest` and `farthest` times a₁ + a₂.
template <int Dim>
CollisionCaseOf<Dim> placed_apart(Stream& draw, CollisionCaseOf<Dim> pair, double nearest,
                                  double farthest) {
  do {
    const double distance = draw.uniform(nearest, farthest) * pair.reach();
    pair.two.pose.position = pair.one.pose.position + distance * any_direction<Dim>(draw);
  } while (!disjoint_at(pair, 0));
  return pair;
}

template <int Dim>
CollisionCaseOf<Dim> close_pair(Stream& draw, const CollisionCaseOf<Dim>& pair) {
  return placed_apart(draw, pair, 0.2, 1.2);
}

/// The surface point of a body of size 1 whose outward normal is n, and the speed at which rotation moves its support
/// along n.
template <int Dim>
struct Support {
  Vec<Dim> point;
  double rate;
};

inline Support<3> support(const Moving<3>& flight, const Vec3& n) {
  const Vec3 along = shape_matrix(flight.body.shape, flight.pose.orientation) * n;
  const Vec3 point = along / std::sqrt(n.dot(along));
  return {point, -point.dot(flight.motion.angular_velocity.cross(n))};
}

/// Support in the plane, with h'' (`second`) and the radius of curvature h'' + h.
struct BentSupport : Support<2> {
  double second, curvature;
};
inline BentSupport support(const Moving<2>& flight, const Vec2& n) {
  const auto& [a, b] = flight.body.shape;
  const Vec2 u = unit(flight.pose.angle), across(-u.y(), u.x());
  const double c = n.dot(u), s = n.dot(across);
  const double h = std::hypot(a * c, b * s);
  const double slope = -(a - b) * (a + b) * c * s / h, curvature = a * a * b * b / (h * h * h);
  return {{(a * a * c * u + b * b * s * across) / h, -flight.motion.angular_velocity * slope},
          curvature - h,
          curvature};
}

/// Gives two bodies the positions and velocities with which their surfaces are closest, `gap` apart along n, and
/// approach at this speed. It shifts the second body and corrects its velocity along n. Tangent surfaces that are
/// apart along their common normal are closest there, because both are convex.
template <int Dim>
void bring_together(CollisionCaseOf<Dim>& pair, const Vec<Dim>& n, double gap, double approach) {
  const auto s1 = support(pair.one, n), s2 = support(pair.two, n);
  pair.two.pose.position = pair.one.pose.position + s1.point + s2.point + gap * n;
  const double relative = (pair.two.motion.velocity - pair.one.motion.velocity).dot(n);
  pair.two.motion.velocity += (s1.rate + s2.rate - approach - relative) * n;
}

/// d²/dt² of the largest support gap of a touching pair: g_tt + g_tφ²/(ρ₁ + ρ₂).
inline double gap_acceleration(const CollisionCase& pair, const Vec2& n) {
  const BentSupport s1 = support(pair.one, n), s2 = support(pair.two, n);
  const double w1 = pair.one.motion.angular_velocity, w2 = pair.two.motion.angular_velocity;
  const double sideways =
      (pair.two.motion.velocity - pair.one.motion.velocity).dot(perpendicular(n)) + w1 * s1.second +
      w2 * s2.second;
  return -w1 * w1 * s1.second - w2 * w2 * s2.second +
         sideways * sideways / (s1.curvature + s2.curvature);
}

/// The second time derivative of the gap by finite differences.
inline double gap_acceleration(const EllipsoidCase& pair, const Vec3&) {
  constexpr double step = 1e-3;
  const auto gap = [&](double time) { return gap_at(pair, time); };
  return static_cast<double>((gap(step) - 2 * gap(0) + gap(-step)) / (step * step));
}

/// Moves the bodies back in time, so that their state at time 0 occurs at `time` instead.
template <int Dim>
void happen_at(CollisionCaseOf<Dim>& pair, double time) {
  for (Moving<Dim>* flight : {&pair.one, &pair.two})
    flight->pose = advanced(flight->pose, flight->motion, -time);
}

/// Moves the bodies back in time, also if they tumble.
inline void happen_at(EllipsoidCase& pair, double time) {
  if (!pair.tumbles()) return happen_at<3>(pair, time);
  for (const int body : {0, 1}) {
    Moving<3>& flight = body == 0 ? pair.one : pair.two;
    flight.pose = pose_at(pair, body, -time);
    flight.motion.angular_velocity = pair.tumbling[body].top.at(-time).angular_velocity;
  }
  let_tumble(pair);
}

}  // namespace vitrel::bench

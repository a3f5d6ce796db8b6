#pragma once

#include <algorithm>
#include <cmath>

#include "core/contact/first_contact.h"
#include "core/contact/simd_batch.h"

/// @file
/// The contact of two disks or spheres in free flight, in closed form. It also serves ellipses and ellipsoids that are
/// round.
namespace vitrel::detail {

/// The first t ≥ 0 with |d + v t| = r + γ t, for circles or spheres, is a root of a t² + 2 b t + c, where a = v² − γ²,
/// b = d·v − r γ and c = d² − r²; `root` is √(b² − a c). closing_time requires b < 0, which means that the surfaces
/// approach, and returns 0 if they already touch (c ≤ 0).
///
/// The callers compute a, b and c themselves: round_contact computes c as (|d| − r)(|d| + r), which is more accurate
/// near contact, and the batch of round_contacts.h avoids the square root of d².
template <class T>
VITREL_INLINE T closing_time(const T& b, const T& c, const T& root) {
  using std::max;
  return max(c / (root - b), T(0));
}
/// overtaking_time requires b ≥ 0 and a < 0: the centres recede, but the radii grow faster.
template <class T>
VITREL_INLINE T overtaking_time(const T& a, const T& b, const T& root) {
  return (b + root) / -a;
}

/// A disk or a sphere.
struct Round {
  double radius, growth;
};

template <class B>
Prediction<B::dimension> round_contact(const Flight<B>& one, const Round& round1,
                                       const Flight<B>& two, const Round& round2, double horizon,
                                       double contact_gap) {
  const Vec<B::dimension> d = two.pose.position - one.pose.position;
  const Vec<B::dimension> v = two.motion.velocity - one.motion.velocity;
  const double touch = round1.radius + round2.radius;
  if (squared_norm(d) < touch * touch)
    return {Outcome::overlap, 0, normalized(d), one.pose.position, 1};
  const double reach = touch + contact_gap;
  const double growth = round1.growth + round2.growth;
  const double distance = norm(d);
  const double c = (distance - reach) * (distance + reach);
  const double b = dot(d, v) - reach * growth;
  const double a = squared_norm(v) - growth * growth;  // a t² + 2 b t + c ≤ 0 while within reach
  const double discriminant = b * b - a * c;
  if (b >= 0 && a >= 0) return {};
  if (c > 0 && discriminant < 0) return {};
  const double root = std::sqrt(std::max(discriminant, 0.0));
  const double time = b < 0 ? closing_time(b, c, root) : overtaking_time(a, b, root);
  if (!(time <= horizon)) return {};
  const Vec<B::dimension> normal = normalized(d + v * time);
  const double radius1 = round1.radius + round1.growth * time;
  return {Outcome::contact, time, normal,
          one.pose.position + one.motion.velocity * time + radius1 * normal, 1};
}

template <class Shape>
bool is_round(const Shape& shape) {
  return shape.is_round();
}
template <class Shape>
bool is_round(const Growing<Shape>& body) {
  return body.shape.is_round();
}

template <class Shape>
Round as_round(const Shape& shape) {
  return {shape.circumradius(), 0};
}
template <class Shape>
Round as_round(const Growing<Shape>& body) {
  return {body.circumradius(), body.growth_rate * body.shape.circumradius()};
}

}  // namespace vitrel::detail

#pragma once

#include <algorithm>

#include "core/geometry/ellipsoid.h"

/// @file
/// Bounding capsules of ellipsoids give a cheap test that separates long bodies.
///
/// With semi-axes a ≥ b ≥ c, the ellipsoid lies within b of the segment of half-length (a² − b²)/a along its longest
/// axis: the balls at t on the axis with squared radius b² (1 − t²/(a² − b²)) cover the spheroid a, b, b, and the last
/// of them touches its tip.
namespace vitrel {

/// A capsule centred at the body: all points within `radius` of the segment −half … half.
struct Capsule {
  Vec3 half = Vec3::Zero();
  double radius = 0;
};

/// Computes the capsule of a shape once; `at` places it with an orientation and a size.
class CapsuleOf {
 public:
  explicit CapsuleOf(const Ellipsoid& shape) {
    const double a = shape.semi_axes.maxCoeff(&axis_);
    radius_ = sum(shape.semi_axes) - a - shape.semi_axes.minCoeff();
    half_length_ = (a * a - radius_ * radius_) / a;
  }

  Capsule at(const Quaternion& orientation, double size) const {
    return {size * half_length_ * (orientation * Vec3::Unit(axis_)), size * radius_};
  }

 private:
  int axis_ = 0;
  double half_length_, radius_;
};

/// Returns whether two capsules, the second at d from the first, are proved to be farther apart than `limit`. The
/// distance of the lines through their axes decides most pairs. The closest points of the segments are s h₁ and d + t
/// h₂ with −1 ≤ s, t ≤ 1; for nearly parallel segments any s is nearly as good.
inline bool farther_apart(const Capsule& one, const Capsule& two, const Vec3& d, double limit) {
  constexpr double parallel = 1e-14;
  const double a = squared_norm(one.half), b = dot(one.half, two.half), c = squared_norm(two.half);
  const double det = a * c - b * b;
  const double reach = one.radius + two.radius + limit;
  // The factor and the last term include rounding and the error of s for nearly parallel segments, which is 2√parallel
  // of their lengths.
  const double least = reach * reach * (1 + 1e-5) + 1e-8 * (a + c);
  const double along_normal = dot(d, one.half.cross(two.half));
  if (det > 1e-6 * a * c && along_normal * along_normal > least * det) return true;

  const auto nearest = [](double position, double length) {
    return length > 0 ? std::clamp(position / length, -1., 1.) : 0;
  };
  const double along1 = dot(one.half, d), along2 = dot(two.half, d);
  const double first = det > parallel * a * c ? nearest(along1 * c - b * along2, det) : 0;
  const double t = nearest(first * b - along2, c);
  const double s = nearest(along1 + t * b, a);
  return squared_norm(d + t * two.half - s * one.half) > least;
}

}  // namespace vitrel

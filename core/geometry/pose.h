#pragma once

#include <cmath>
#include <type_traits>

#include "core/elementary.h"
#include "core/geometry/vector.h"

/// @file
/// Where a body is and how it moves. Free flight between events is r + v t with a constant angular
/// velocity ω.
///
/// In two dimensions the angle is θ + ω t, in radians, counter-clockwise from the x axis to the first
/// (major) axis of the body, and unwrapped: two full turns are 4π, not 0.
///
/// In three dimensions the orientation q turns the axes of the body into those of space, and ω is given
/// in space: q(t) = exp(ω t/2) q. For a sphere and for a spheroid this is the torque-free motion, with
/// ω = L/I⊥ (ellipsoid.h); a scalene body would tumble by Euler's equations instead.
namespace vitrel {

template <int Dim>
struct Pose;

template <>
struct Pose<2> {
  Vec2 position;
  double angle = 0;
};

template <>
struct Pose<3> {
  Vec3 position;
  Quaternion orientation = Quaternion::Identity();
};

/// An angle in two dimensions, a quaternion in three.
template <int Dim>
using Orientation = std::conditional_t<Dim == 2, double, Quaternion>;
inline double orientation_of(const Pose<2>& pose) {
  return pose.angle;
}
inline const Quaternion& orientation_of(const Pose<3>& pose) {
  return pose.orientation;
}

/// A number in two dimensions, a vector in three.
template <int Dim>
using AngularVelocity = std::conditional_t<Dim == 2, double, Vec3>;

template <int Dim>
struct Motion;

template <>
struct Motion<2> {
  Vec2 velocity;
  double angular_velocity = 0;
};

template <>
struct Motion<3> {
  Vec3 velocity;
  Vec3 angular_velocity = Vec3::Zero();
};

using Pose2 = Pose<2>;
using Motion2 = Motion<2>;
using Pose3 = Pose<3>;
using Motion3 = Motion<3>;

/// exp(ω t/2): the rotation by the vector ω t.
inline Quaternion rotation(const Vec3& turn) {
  const double half = 0.5 * turn.norm();
  // sin(x)/x to rounding where the quotient would be lost.
  const auto [cosine, sine] = cosine_and_sine(half);
  const double sinc = half < 1e-8 ? 1 : sine / half;
  Quaternion q;
  q.w() = cosine;
  q.vec() = 0.5 * sinc * turn;
  return q;
}

/// The pose after free flight for `time` (negative: before).
inline Pose2 advanced(const Pose2& pose, const Motion2& motion, double time) {
  return {pose.position + motion.velocity * time, pose.angle + motion.angular_velocity * time};
}
inline Pose3 advanced(const Pose3& pose, const Motion3& motion, double time) {
  return {pose.position + motion.velocity * time,
          (rotation(motion.angular_velocity * time) * pose.orientation).normalized()};
}

}  // namespace vitrel

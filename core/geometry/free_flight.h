#pragma once

#include "core/elementary.h"
#include "core/geometry/body.h"

/// @file
/// Free flight between events: the position is r + v t, the angular velocity ω is constant, and in three dimensions
/// q(t) = exp(ω t/2) q. For spheres and spheroids this is the torque-free motion, with ω = L/I⊥ (ellipsoid.h); the
/// motion of scalene bodies is in tumbling_ellipsoid.h.
///
/// These functions are not in pose.h because most sources need only poses, and products of quaternions take long to
/// compile.
namespace vitrel {

/// exp(ω t/2): the rotation by the vector ω t.
inline Quaternion rotation(const Vec3& turn) {
  const double half = 0.5 * norm(turn);
  // For small x, where the quotient could be lost, sin(x)/x equals 1 to rounding.
  const auto [cosine, sine] = cosine_and_sine(half);
  const double sinc = half < 1e-8 ? 1 : sine / half;
  Quaternion q;
  q.w() = cosine;
  q.vec() = 0.5 * sinc * turn;
  return q;
}

/// Returns the pose after free flight for `time`, which may be negative.
inline Pose2 advanced(const Pose2& pose, const Motion2& motion, double time) {
  return {pose.position + motion.velocity * time, pose.angle + motion.angular_velocity * time};
}
inline Pose3 advanced(const Pose3& pose, const Motion3& motion, double time) {
  return {pose.position + motion.velocity * time,
          normalized(rotation(motion.angular_velocity * time) * pose.orientation)};
}

/// Returns the pose at `time`, counted from the start of the flight.
template <Body B>
Pose<B::dimension> pose_at(const Flight<B>& flight, double time) {
  return advanced(flight.pose, flight.motion, time);
}

}  // namespace vitrel

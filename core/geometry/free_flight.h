#pragma once

#include "core/elementary.h"
#include "core/geometry/body.h"

/// @file
/// Free flight between events: r + v t with a constant angular velocity ω; in space q(t) = exp(ω t/2) q. For spheres and
/// spheroids this is the torque-free motion, with ω = L/I⊥ (ellipsoid.h); tumbling_ellipsoid.h has that of scalene bodies.
///
/// This is apart from pose.h since most sources need only poses, and the products of quaternions take long to compile.
namespace vitrel {

/// exp(ω t/2): the rotation by the vector ω t.
inline Quaternion rotation(const Vec3& turn) {
  const double half = 0.5 * norm(turn);
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
          normalized(rotation(motion.angular_velocity * time) * pose.orientation)};
}

/// The pose at that time.
template <Body B>
Pose<B::dimension> pose_at(const Flight<B>& flight, double time) {
  return advanced(flight.pose, flight.motion, time);
}

}  // namespace vitrel

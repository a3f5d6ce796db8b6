#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/elementary.h"
#include "core/geometry/pose.h"

/// @file
/// The time at which a moving body leaves a neighbourhood (neighborhood.h).
namespace vitrel::detail {

/// Returns the rotation angle between two orientations: signed in two dimensions, the smallest one in three.
inline double rotation_angle(double from, double to) {
  return to - from;
}
inline double rotation_angle(const Quaternion& from, const Quaternion& to) {
  const Quaternion turn = from.conjugate() * to;
  return 2 * polar_angle(norm(turn.vec()), std::abs(turn.w()));
}

/// Returns the first s ≥ 0 with |r + v s| = slack + growth s, for |r| ≤ slack; 0 if the body is already outside.
template <class Vector>
double crossing(const Vector& r, const Vector& v, double slack, double growth) {
  const double c = squared_norm(r) - slack * slack;
  if (!(slack > 0) || c >= 0) return 0;
  const double a = squared_norm(v) - growth * growth;
  const double b = dot(r, v) - slack * growth;
  // This is the first positive root of a s² + 2 b s + c = 0 with c < 0, without cancellation.
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return std::numeric_limits<double>::infinity();
  const double root = std::sqrt(discriminant);
  const double below = b + root;
  const double time = below > 0 ? -c / below : (root - b) / a;
  return time > 0 ? time : std::numeric_limits<double>::infinity();
}

/// Returns the time at which displacement and rotation together use up the slack. In two dimensions the body may rotate
/// in either sense; in three, the bound assumes rotation away from the reference.
inline double exit_time(const Vec2& moved, const Motion2& motion, double rotated,
                        double max_support_rate, double slack, double slack_rate) {
  const double turning = max_support_rate * norm(motion.angular_velocity);
  const double away = std::copysign(1.0, motion.angular_velocity) * rotated;
  const double exit = crossing(moved, motion.velocity, slack - away, -turning - slack_rate);
  // A body that rotates back passes the reference before it leaves in the opposite sense.
  return away >= 0
             ? exit
             : std::min(exit, crossing(moved, motion.velocity, slack + away, turning - slack_rate));
}
inline double exit_time(const Vec3& moved, const Motion3& motion, double rotated,
                        double max_support_rate, double slack, double slack_rate) {
  return crossing(moved, motion.velocity, slack - rotated,
                  -max_support_rate * norm(motion.angular_velocity) - slack_rate);
}

}  // namespace vitrel::detail

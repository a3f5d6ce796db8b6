#pragma once

#include "core/geometry/vector.h"

/// Where a body is and how it moves. Free flight between events is r + v t, θ + ω t; angles are in
/// radians, counter-clockwise from the x axis to the first (major) axis of the body, and unwrapped:
/// two full turns are 4π, not 0.
namespace vitrel {

template <int Dim>
struct Pose;

template <>
struct Pose<2> {
  Vec2 position;
  double angle = 0;
};

template <int Dim>
struct Motion;

template <>
struct Motion<2> {
  Vec2 velocity;
  double angular_velocity = 0;
};

using Pose2 = Pose<2>;
using Motion2 = Motion<2>;

/// The pose after free flight for `time` (negative: before).
inline Pose2 advanced(const Pose2& pose, const Motion2& motion, double time) {
  return {pose.position + motion.velocity * time, pose.angle + motion.angular_velocity * time};
}

}  // namespace vitrel

#pragma once

#include <type_traits>

#include "core/geometry/vector.h"

/// @file
/// The position, orientation and motion of a body; free_flight.h moves it.
///
/// In two dimensions the angle is θ + ω t, in radians, counter-clockwise from the x axis to the first
/// (major) axis of the body, and unwrapped: two full turns are 4π, not 0.
///
/// In three dimensions the orientation q turns the axes of the body into those of space, and ω is given
/// in space.
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

}  // namespace vitrel

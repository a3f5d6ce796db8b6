#pragma once

#include <concepts>

#include "core/geometry/pose.h"

namespace vitrel {

/// The interface of a hard particle: a convex, centrally symmetric shape in `dimension` dimensions.
///
///     circumradius, inradius  radii of the smallest enclosing and the largest enclosed circle (sphere)
///     volume                  area in two dimensions
///     max_support_rate        maximum rate of the support function per unit of angular speed,
///                             max |dh/dt|/|ω| (0 for a round body)
///
/// Models: `Disk`, `Ellipse`, `Sphere`, `Ellipsoid`, `TumblingEllipsoid` and growing bodies (growing.h).
template <class B>
concept Body = requires(const B body) {
  { B::dimension } -> std::convertible_to<int>;
  { body.circumradius() } -> std::convertible_to<double>;
  { body.inradius() } -> std::convertible_to<double>;
  { body.volume() } -> std::convertible_to<double>;
  { body.max_support_rate() } -> std::convertible_to<double>;
};

/// The value that functions return in place of the index of an axis if there is no such axis.
inline constexpr int no_axis = -1;

/// A body in free flight: its pose at time 0 and its constant velocities.
template <Body B>
struct Flight {
  B body;
  Pose<B::dimension> pose;
  Motion<B::dimension> motion;
};

}  // namespace vitrel

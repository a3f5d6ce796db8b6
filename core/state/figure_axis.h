#pragma once

#include "core/geometry/ellipsoid.h"

namespace vitrel {

/// The unit vector w along which a body is oriented, either of two opposite ones: the axis of symmetry of
/// a spheroid, the short one of an oblate and the long one of a prolate; of a scalene body the longest
/// axis, which is a choice. Not for round bodies.
inline Vec3 figure_axis(const Ellipsoid& body, const Quaternion& orientation) {
  int axis = body.symmetry_axis();
  if (axis == Ellipsoid::none) body.semi_axes.maxCoeff(&axis);
  return orientation * Vec3::Unit(axis);
}

}  // namespace vitrel

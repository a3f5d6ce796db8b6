#pragma once

#include <cmath>
#include <numbers>

#include "core/geometry/ellipsoid.h"
#include "core/random/stream.h"

/// Random bodies and directions in three dimensions.
namespace vitrel {

inline Vec3 random_direction(Stream& draw) {
  const double z = draw.uniform(-1, 1), phi = draw.uniform(0, 2 * std::numbers::pi);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

/// Uniform over all rotations.
inline Quaternion random_orientation(Stream& draw) {
  Quaternion q;
  q.coeffs() << draw.normal(), draw.normal(), draw.normal(), draw.normal();
  return q.normalized();
}

/// Semi-axes of the volume of a unit sphere, with ratios up to `aspect`, log-uniform.
inline Ellipsoid random_ellipsoid(Stream& draw, double aspect) {
  Vec3 axes;
  for (double& a : axes) a = std::pow(aspect, draw.uniform(-0.5, 0.5));
  return {axes / std::cbrt(axes.prod())};
}

inline Ellipsoid prolate(double aspect) {
  return {Vec3(std::pow(aspect, 2. / 3), std::pow(aspect, -1. / 3), std::pow(aspect, -1. / 3))};
}
inline Ellipsoid oblate(double aspect) {
  return {Vec3(std::pow(aspect, 1. / 3), std::pow(aspect, 1. / 3), std::pow(aspect, -2. / 3))};
}

}  // namespace vitrel

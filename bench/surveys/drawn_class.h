#pragma once

#include <cmath>
#include <numbers>

#include "bench/methods/collision_case.h"
#include "core/random/stream.h"

/// @file
/// Random numbers from which the cases of a class are drawn.
namespace vitrel::bench {

inline double sign(Stream& draw) {
  return draw.uniform() < 0.5 ? -1 : 1;
}
inline double log_uniform(Stream& draw, double low, double high) {
  return low * std::pow(high / low, draw.uniform());
}
/// A number of random sign whose magnitude is uniform in its logarithm.
inline double signed_log_uniform(Stream& draw, double low, double high) {
  const double of_sign = sign(draw);
  return of_sign * log_uniform(draw, low, high);
}

inline Vec2 unit(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

/// A velocity at kT = 1 for mass 1.
template <int Dim>
Vec<Dim> thermal_vector(Stream& draw) {
  Vec<Dim> v;
  for (double& x : v) x = draw.normal();
  return v;
}

template <int Dim>
auto any_orientation(Stream& draw) {
  if constexpr (Dim == 2) {
    return draw.uniform(-std::numbers::pi, std::numbers::pi);
  } else {
    const Vec3 v = thermal_vector<3>(draw);
    return Quaternion(draw.normal(), v.x(), v.y(), v.z()).normalized();
  }
}

template <int Dim>
Vec<Dim> any_direction(Stream& draw) {
  if constexpr (Dim == 2)
    return unit(any_orientation<2>(draw));
  else
    return thermal_vector<3>(draw).normalized();
}

/// A random body with unit a b (c).
template <int Dim>
auto any_shape(Stream& draw, double kappa) {
  if constexpr (Dim == 2) {
    return of_unit_area(kappa);
  } else {
    const double kind = draw.uniform();
    const double middle = kind < 0.25 ? 1 : kind < 0.5 ? kappa : log_uniform(draw, 1, kappa);
    return Ellipsoid{Vec3(kappa, middle, 1) / std::cbrt(kappa * middle)};
  }
}

}  // namespace vitrel::bench

#pragma once

#include <cmath>
#include <numbers>

#include "core/geometry/ellipsoid.h"
#include "core/random/stream.h"
#include "core/state/configuration.h"

/// Random bodies and directions in three dimensions.
namespace vitrel {

inline Vec3 random_direction(Stream& draw) {
  const double z = draw.uniform(-1, 1), phi = draw.uniform(0, 2 * std::numbers::pi);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

/// A vector of random direction whose length is uniform between `low` and `high`.
inline Vec3 random_vector(Stream& draw, double low, double high) {
  const double length = draw.uniform(low, high);
  return length * random_direction(draw);
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

/// Particles on a simple cubic lattice, n³ of them, in random orientations.
template <class ShapeOf>
Configuration3 cubic_lattice(int n, double packing_fraction, ShapeOf shape_of,
                             std::uint64_t seed = 1) {
  Configuration3 c;
  const int particles = n * n * n;
  c.resize(static_cast<std::size_t>(particles));
  c.species_names = {"A"};
  double volume = 0;
  for (std::size_t i = 0; i < c.size(); ++i) {
    c.shape[i] = shape_of(i);
    c.mass[i] = c.shape[i].semi_axes.prod();
    volume += c.shape[i].volume();
  }
  const double length = std::cbrt(volume / packing_fraction);
  c.box = PeriodicBox<3>(Vec3::Constant(length));
  Stream draw(seed, Purpose::tests, 999);
  for (int k = 0; k < particles; ++k) {
    const int row = k / n, layer = row / n;
    c.position[k] = (Vec3(k % n, row % n, layer) + Vec3::Constant(0.5)) * (length / n) -
                    Vec3::Constant(0.5 * length);
    c.orientation[k] = random_orientation(draw);
  }
  return c;
}

inline Ellipsoid prolate(double aspect) {
  return {Vec3(std::pow(aspect, 2. / 3), std::pow(aspect, -1. / 3), std::pow(aspect, -1. / 3))};
}
inline Ellipsoid oblate(double aspect) {
  return {Vec3(std::pow(aspect, 1. / 3), std::pow(aspect, 1. / 3), std::pow(aspect, -2. / 3))};
}

}  // namespace vitrel

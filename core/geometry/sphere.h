#pragma once

#include <numbers>

#include "core/geometry/body.h"

namespace vitrel {

/// A hard sphere. Smooth (frictionless) collisions do not depend on its orientation, which predictions ignore.
struct Sphere {
  static constexpr int dimension = 3;
  double radius = 1;

  double circumradius() const { return radius; }
  double inradius() const { return radius; }
  double volume() const { return 4 * std::numbers::pi / 3 * radius * radius * radius; }
  double max_support_rate() const { return 0; }
};

static_assert(Body<Sphere>);

/// The same shape, of another size.
inline Sphere scaled(const Sphere& sphere, double size) {
  return {size * sphere.radius};
}

}  // namespace vitrel

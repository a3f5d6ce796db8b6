#pragma once

#include <numbers>

#include "core/geometry/body.h"

namespace vitrel {

/// A hard disk or sphere. Smooth (frictionless) collisions do not depend on its orientation, so predictions ignore it.
template <int Dim>
struct Ball {
  static constexpr int dimension = Dim;
  double radius = 1;

  double circumradius() const { return radius; }
  double inradius() const { return radius; }
  double volume() const {
    if constexpr (Dim == 2) return std::numbers::pi * radius * radius;
    return 4 * std::numbers::pi / 3 * radius * radius * radius;
  }
  double max_support_rate() const { return 0; }
};
using Disk = Ball<2>;
using Sphere = Ball<3>;

static_assert(Body<Disk> && Body<Sphere>);

/// Returns the body with all lengths multiplied by `size`.
template <int Dim>
Ball<Dim> scaled(const Ball<Dim>& body, double size) {
  return {size * body.radius};
}

}  // namespace vitrel

#pragma once

#include <cmath>
#include <numbers>

#include "core/geometry/periodic_box.h"

/// What loops over all pairs of particles need.
namespace vitrel {

/// A separation to the nearest image.
template <int Dim>
Vec<Dim> to_nearest_image(const PeriodicBox<Dim>& box, const Vec<Dim>& separation) {
  return separation + box.translation(box.nearest_shift(separation));
}

/// Area between two radii in the plane, volume in space.
template <int Dim>
double volume_between(double inner, double outer) {
  using std::numbers::pi;
  if constexpr (Dim == 2) return pi * (outer * outer - inner * inner);
  return 4 * pi / 3 * (std::pow(outer, 3) - std::pow(inner, 3));
}

}  // namespace vitrel

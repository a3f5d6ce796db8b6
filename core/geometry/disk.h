#pragma once

#include <numbers>

#include "core/geometry/body.h"

namespace vitrel {

/// A hard disk. Smooth (frictionless) collisions do not depend on its orientation, which is not modelled.
struct Disk {
  static constexpr int dimension = 2;
  double radius = 1;

  double circumradius() const { return radius; }
  double inradius() const { return radius; }
  double volume() const { return std::numbers::pi * radius * radius; }
  double max_support_rate() const { return 0; }
};

static_assert(Body<Disk>);

/// The same shape, of another size.
inline Disk scaled(const Disk& disk, double size) {
  return {size * disk.radius};
}

}  // namespace vitrel

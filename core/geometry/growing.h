#pragma once

#include "core/geometry/ellipse.h"
#include "core/geometry/ellipsoid.h"

namespace vitrel {

/// A body that grows or shrinks self-similarly at a constant rate: at time t its lengths are those of
/// `shape` times
///     size(t) = size + growth_rate · t ≥ 0,   t counted from the start of its flight.
/// It may start from a point, size = 0.
template <Body Shape>
struct Growing {
  static constexpr int dimension = Shape::dimension;
  Shape shape;  ///< at size 1
  double size = 1;
  double growth_rate = 0;

  double size_at(double time) const { return size + growth_rate * time; }
  Shape at(double time) const { return scaled(shape, size_at(time)); }

  // The body at time 0.
  double circumradius() const { return size * shape.circumradius(); }
  double inradius() const { return size * shape.inradius(); }
  double volume() const { return scaled(shape, size).volume(); }
  double swing() const { return size * shape.swing(); }
};

using GrowingEllipse = Growing<Ellipse>;
using GrowingEllipsoid = Growing<Ellipsoid>;

static_assert(Body<GrowingEllipse> && Body<GrowingEllipsoid>);

}  // namespace vitrel

#pragma once

#include "core/geometry/ellipse.h"

namespace vitrel {

/// An ellipse that grows or shrinks self-similarly at a constant rate: at time t its semi-axes are
/// those of `shape` times
///     size(t) = size + growth_rate · t ≥ 0,   t counted from the start of its flight.
/// It may start from a point, size = 0.
struct GrowingEllipse {
  static constexpr int dimension = 2;
  Ellipse shape;  ///< at size 1
  double size = 1;
  double growth_rate = 0;

  double size_at(double time) const { return size + growth_rate * time; }
  Ellipse at(double time) const { return {shape.a * size_at(time), shape.b * size_at(time)}; }

  // The body at time 0.
  double circumradius() const { return size * shape.circumradius(); }
  double inradius() const { return size * shape.inradius(); }
  double volume() const { return size * size * shape.volume(); }
  double swing() const { return size * shape.swing(); }
};

static_assert(Body<GrowingEllipse>);

}  // namespace vitrel

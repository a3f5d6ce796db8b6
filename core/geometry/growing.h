#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>

#include "core/geometry/ball.h"
#include "core/geometry/ellipse.h"
#include "core/geometry/ellipsoid.h"

namespace vitrel {

/// A body that grows or shrinks self-similarly at a constant rate: at time t its lengths are those of
/// `shape` times
///
///     size(t) = size + growth_rate · t ≥ 0,   t counted from the start of its flight.
///
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
  double max_support_rate() const { return size * shape.max_support_rate(); }
};

/// Returns the time in which a size changes by a thousandth, or a practically infinite time if the size is constant.
inline double time_of_little_growth(double size, double growth_rate) {
  constexpr double little = 1e-3, least = 1e-300;
  return little / std::max(std::abs(growth_rate) / size, least);
}

using GrowingEllipse = Growing<Ellipse>;
using GrowingEllipsoid = Growing<Ellipsoid>;
using GrowingSphere = Growing<Sphere>;

static_assert(Body<GrowingEllipse> && Body<GrowingEllipsoid> && Body<GrowingSphere>);

template <class B>
struct ShapeOf {
  using type = B;
  static constexpr bool grows = false;
};
template <class Shape>
struct ShapeOf<Growing<Shape>> {
  using type = Shape;
  static constexpr bool grows = true;
};
/// The shape of a body without its growth, at size 1.
template <class B>
using BaseShape = typename ShapeOf<B>::type;
template <class B>
inline constexpr bool grows = ShapeOf<B>::grows;

/// Disks and spheres, including growing ones.
template <class B>
concept RoundBody = Body<B> && std::same_as<BaseShape<B>, Ball<B::dimension>>;

}  // namespace vitrel

#pragma once

#include "core/geometry/growing.h"

namespace vitrel {

/// An ellipsoid that rotates by Euler's equations (asymmetric_top.h); a plain `Ellipsoid` keeps its angular velocity.
/// Spheroids and spheres are the same either way, at a higher cost here. The motion at time 0 has the angular velocity
/// of that instant.
struct TumblingEllipsoid {
  static constexpr int dimension = 3;
  Ellipsoid shape;

  double circumradius() const { return shape.circumradius(); }
  double inradius() const { return shape.inradius(); }
  double volume() const { return shape.volume(); }
  double max_support_rate() const { return shape.max_support_rate(); }
  bool is_round() const { return shape.is_round(); }
};

static_assert(Body<TumblingEllipsoid>);

template <>
struct ShapeOf<TumblingEllipsoid> {
  using type = Ellipsoid;
  static constexpr bool grows = false;
};

/// Bodies whose angular velocity changes in free flight.
template <class B>
inline constexpr bool tumbles = std::same_as<B, TumblingEllipsoid>;

}  // namespace vitrel

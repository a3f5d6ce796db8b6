#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "core/geometry/growing.h"
#include "core/tolerances.h"

namespace vitrel::bench {

template <int Dim>
using GrowingBody = std::conditional_t<Dim == 2, GrowingEllipse, GrowingEllipsoid>;

/// One question to a collision-time method: when do these two first touch, up to the horizon?
template <int Dim>
struct CollisionCaseOf {
  Flight<GrowingBody<Dim>> one, two;
  double horizon = 0;

  bool grows() const { return one.body.growth_rate != 0 || two.body.growth_rate != 0; }
  /// Gaps are given in units of the smallest semi-axis (at size 1).
  double gap_unit() const { return std::min(one.body.shape.inradius(), two.body.shape.inradius()); }
  /// The sum of the largest semi-axes (at size 1).
  double reach() const { return one.body.shape.circumradius() + two.body.shape.circumradius(); }
  /// The gap at which the default predictor declares contact.
  double contact_gap() const { return tolerance::contact_gap(reach()); }
};
using CollisionCase = CollisionCaseOf<2>;
using EllipsoidCase = CollisionCaseOf<3>;

/// The ellipse of a given aspect ratio with a b = 1.
inline Ellipse of_unit_area(double aspect_ratio) {
  return {std::sqrt(aspect_ratio), 1 / std::sqrt(aspect_ratio)};
}

/// A flight whose ellipse keeps its size.
inline Flight<GrowingEllipse> of_constant_size(const Flight<Ellipse>& flight) {
  return {{flight.body, 1, 0}, flight.pose, flight.motion};
}

}  // namespace vitrel::bench

#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include "core/geometry/growing.h"
#include "core/geometry/tumbling_ellipsoid.h"
#include "core/tolerances.h"

namespace vitrel::bench {

template <int Dim>
using GrowingBody = std::conditional_t<Dim == 2, GrowingEllipse, GrowingEllipsoid>;

/// The input of a collision-time method: two bodies in flight, whose first contact up to the horizon is wanted.
template <int Dim>
struct CollisionCaseOf {
  Flight<GrowingBody<Dim>> one, two;
  double horizon = 0;
  /// The same flights as those of ellipsoids that rotate by Euler's equations and do not grow; empty if ω is
  /// constant.
  std::vector<Flight<TumblingEllipsoid>> tumbling{};

  bool tumbles() const { return !tumbling.empty(); }
  bool grows() const { return one.body.growth_rate != 0 || two.body.growth_rate != 0; }
  /// The unit of gaps: the smallest semi-axis (at size 1).
  double gap_unit() const { return std::min(one.body.shape.inradius(), two.body.shape.inradius()); }
  /// The sum of the largest semi-axes (at size 1).
  double reach() const { return one.body.shape.circumradius() + two.body.shape.circumradius(); }
  /// The gap at which the default predictor declares contact.
  double contact_gap() const { return tolerance::contact_gap(reach()); }
};
using CollisionCase = CollisionCaseOf<2>;
using EllipsoidCase = CollisionCaseOf<3>;

/// Lets both ellipsoids rotate by Euler's equations from their state at time 0.
inline void let_tumble(EllipsoidCase& pair) {
  pair.tumbling.clear();
  for (const Flight<GrowingEllipsoid>& flight : {pair.one, pair.two})
    pair.tumbling.emplace_back(TumblingEllipsoid{flight.body.shape}, flight.pose, flight.motion);
}

/// The ellipse of a given aspect ratio with a b = 1.
inline Ellipse of_unit_area(double aspect_ratio) {
  return {std::sqrt(aspect_ratio), 1 / std::sqrt(aspect_ratio)};
}

/// A flight of an ellipse that keeps its size.
inline Flight<GrowingEllipse> of_constant_size(const Flight<Ellipse>& flight) {
  return {{flight.body, 1, 0}, flight.pose, flight.motion};
}

}  // namespace vitrel::bench

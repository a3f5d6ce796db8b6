#pragma once

#include <algorithm>
#include <cmath>

#include "core/geometry/growing.h"
#include "core/tolerances.h"

namespace vitrel::lab {

/// One question to a collision-time method: when do these two first touch, up to the horizon?
struct CollisionCase {
  Flight<GrowingEllipse> one, two;
  double horizon = 0;

  bool grows() const { return one.body.growth_rate != 0 || two.body.growth_rate != 0; }
  /// Gaps are judged in units of the smaller semi-minor axis (at size 1).
  double gap_unit() const { return std::min(one.body.shape.b, two.body.shape.b); }
  /// The gap at which the default predictor declares contact.
  double contact_gap() const { return tolerance::contact_gap(one.body.shape.a + two.body.shape.a); }
};

/// The ellipse of a given aspect ratio with a b = 1.
inline Ellipse of_unit_area(double aspect_ratio) {
  return {std::sqrt(aspect_ratio), 1 / std::sqrt(aspect_ratio)};
}

/// A flight whose ellipse keeps its size.
inline Flight<GrowingEllipse> of_constant_size(const Flight<Ellipse>& flight) {
  return {{flight.body, 1, 0}, flight.pose, flight.motion};
}

}  // namespace vitrel::lab

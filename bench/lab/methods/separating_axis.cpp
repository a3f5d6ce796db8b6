#include "bench/lab/methods/separating_axis.h"

#include "bench/lab/methods/opening.h"

namespace vitrel::lab {

Prediction separating_axis(const CollisionCase& asked, double tolerance) {
  const double gap = tolerance * (asked.one.body.shape.a + asked.two.body.shape.a);
  if (asked.grows()) return {Outcome::not_converged};
  const auto at_rest_in_size = [](const Flight<GrowingEllipse>& flight) {
    return Flight<Ellipse>{body_at(flight, 0), flight.pose, flight.motion};
  };
  return first_contact(at_rest_in_size(asked.one), at_rest_in_size(asked.two), asked.horizon, gap);
}

}  // namespace vitrel::lab

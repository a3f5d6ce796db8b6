#include "bench/lab/methods/separating_axis.h"

#include "bench/lab/methods/opening.h"

namespace vitrel::lab {

Prediction2 separating_axis(const CollisionCase& asked, double tolerance) {
  if (!is_sound(asked)) return {Outcome::not_converged};
  const double contact_gap = tolerance * (asked.one.body.shape.a + asked.two.body.shape.a);
  if (asked.grows()) return first_contact(asked.one, asked.two, asked.horizon, contact_gap);
  const auto constant = [](const Flight<GrowingEllipse>& flight) {
    return Flight<Ellipse>{flight.body.at(0), flight.pose, flight.motion};
  };
  return first_contact(constant(asked.one), constant(asked.two), asked.horizon, contact_gap);
}

}  // namespace vitrel::lab

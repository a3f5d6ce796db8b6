#include "bench/lab/methods/separating_axis.h"

#include "bench/lab/methods/opening.h"

namespace vitrel::lab {

Prediction separating_axis(const CollisionCase& asked, double tolerance) {
  if (!is_sound(asked)) return {Outcome::not_converged};
  const double gap = tolerance * (asked.one.body.shape.a + asked.two.body.shape.a);
  if (asked.grows()) return first_contact(asked.one, asked.two, asked.horizon, gap);
  const auto of_this_size = [](const Flight<GrowingEllipse>& flight) {
    return Flight<Ellipse>{body_at(flight, 0), flight.pose, flight.motion};
  };
  return first_contact(of_this_size(asked.one), of_this_size(asked.two), asked.horizon, gap);
}

}  // namespace vitrel::lab

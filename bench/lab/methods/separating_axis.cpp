#include "bench/lab/methods/separating_axis.h"

namespace vitrel::lab {

Prediction separating_axis(const CollisionCase& asked, double tolerance) {
  const double contact_gap = tolerance * (asked.one.body.shape.a + asked.two.body.shape.a);
  return first_contact(asked.one, asked.two, asked.horizon, contact_gap);
}

}  // namespace vitrel::lab

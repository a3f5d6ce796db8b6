#include "bench/methods/ellipses/separating_axis.h"

#include "bench/methods/opening.h"

namespace vitrel::bench {
namespace {

template <class Shape>
Flight<Shape> constant(const Flight<Growing<Shape>>& flight) {
  return {flight.body.at(0), flight.pose, flight.motion};
}

}  // namespace

template <int Dim>
Prediction<Dim> separating_axis(const CollisionCaseOf<Dim>& asked, double tolerance) {
  if (!is_sound(asked)) return {Outcome::not_converged};
  const double contact_gap = tolerance * asked.reach();
  if constexpr (Dim == 3)
    if (asked.tumbles())
      return first_contact(asked.tumbling[0], asked.tumbling[1], asked.horizon, contact_gap);
  if (asked.grows()) return first_contact(asked.one, asked.two, asked.horizon, contact_gap);
  return first_contact(constant(asked.one), constant(asked.two), asked.horizon, contact_gap);
}

template Prediction2 separating_axis(const CollisionCase&, double);
template Prediction3 separating_axis(const EllipsoidCase&, double);

}  // namespace vitrel::bench

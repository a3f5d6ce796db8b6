#include "bench/baselines/unchecked_method.h"

#include "edmd/collision_rule.h"

#include "core/geometry/free_flight.h"

namespace vitrel::bench {
namespace {

bool surfaces_approach(const CollisionCase& asked, const Prediction2& contact) {
  const auto arm = [&](const Flight<GrowingEllipse>& flight) {
    const Vec2 centre = advanced(flight.pose, flight.motion, contact.time).position;
    return cross(contact.point - centre, contact.normal);
  };
  return approach_speed(asked.one.motion, asked.two.motion,
                        {contact.normal, arm(asked.one), arm(asked.two)}) > 0;
}

}  // namespace

Prediction2 unchecked_answer(const Method& method, const CollisionCase& asked) {
  Prediction2 answer = method.predict(asked);
  if (answer.outcome == Outcome::contact && !surfaces_approach(asked, answer))
    return {Outcome::not_converged};
  return answer;
}

}  // namespace vitrel::bench

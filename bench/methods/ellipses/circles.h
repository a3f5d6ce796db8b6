#pragma once

#include "bench/methods/collision_case.h"
#include "core/contact/first_contact.h"

namespace vitrel::bench {

/// Round pairs in closed form, growing or not: the earlier solution of |d + v t| = R(t), see bracket.h.
/// not_converged for pairs of which one is not round. The tolerance has no meaning here.
Prediction2 circles(const CollisionCase& asked, double tolerance);

}  // namespace vitrel::bench

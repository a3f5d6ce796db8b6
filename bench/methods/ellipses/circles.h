#pragma once

#include "bench/methods/collision_case.h"
#include "core/contact/first_contact.h"

namespace vitrel::bench {

/// Round pairs in closed form, growing or not: the earlier solution of |d + v t| = R(t) (bracket.h). Answers
/// not_converged if one body is not round. The tolerance has no meaning.
Prediction2 circles(const CollisionCase& asked, double tolerance);

}  // namespace vitrel::bench

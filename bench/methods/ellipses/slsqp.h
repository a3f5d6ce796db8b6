#pragma once

#include "bench/methods/collision_case.h"
#include "core/contact/first_contact.h"

namespace vitrel::bench {

/// Sequential quadratic programming (SLSQP of NLopt) as in section 3.2.6 and appendix A.1 of the thesis: minimises t
/// subject to E₁(t, x) ≤ 0 and E₂(t, x) ≤ 0.
///
///   1. Bounds: t lies in the bracket of the circles, x in the box that the ellipses can reach in it.
///   2. Start: the earliest time, and the midpoint of the centres at that time.
///   3. Stop: the relative change of the variables is below `tolerance` (usually 1e-10); constraints hold to 1e-10.
///   4. A time at an end of the bracket at which a constraint is violated by more than 1e-8 means no contact. A time
///      below 1e-8 of an overlapping pair means overlap (here by the complete criterion).
///
/// Any other result of the optimiser is accepted, as in the thesis. If the optimiser gives up, its last point is
/// accepted if the constraints hold there. The method is local: its contact need not be the first one.
Prediction2 slsqp(const CollisionCase& asked, double tolerance);

/// SLSQP with a check of the result: wherever it lies, a result that violates a constraint is no contact. This shows
/// the failures of SLSQP itself, without those that the missing check adds.
Prediction2 slsqp_checked(const CollisionCase& asked, double tolerance);

}  // namespace vitrel::bench

#pragma once

#include "bench/methods/collision_case.h"
#include "core/contact/first_contact.h"

namespace vitrel::bench {

/// Sequential quadratic programming (SLSQP of NLopt), as in section 3.2.6 and appendix A.1 of the
/// thesis: minimise t subject to E₁(t, x) ≤ 0 and E₂(t, x) ≤ 0.
///
///   1. Bounds: t within the bracket of the circles, x within the box that the ellipses reach there.
///   2. Start: the earliest time and the middle of the centres then.
///   3. Stop: relative change of the variables below `tolerance` (usual 1e-10); constraints to 1e-10.
///   4. A time at an end of the bracket with a constraint violated by more than 1e-8 means no contact;
///      a time below 1e-8 of an overlapping pair means overlap (here by the complete criterion).
/// What the optimiser returns besides counts, as in the thesis. If it gives up, its last
/// point counts if the constraints hold there. It is local: nothing makes its contact the first one.
Prediction2 slsqp(const CollisionCase& asked, double tolerance);

/// The same, but a result that violates a constraint is no contact wherever it lies: what SLSQP
/// itself fails at, without what a missing check adds.
Prediction2 slsqp_checked(const CollisionCase& asked, double tolerance);

}  // namespace vitrel::bench

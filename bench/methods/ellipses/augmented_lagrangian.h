#pragma once

#include "bench/methods/collision_case.h"
#include "core/contact/first_contact.h"

namespace vitrel::bench {

/// Augmented Lagrangian, equation (3.28) of woetzel2012, for E₁ ≤ 0 and E₂ ≤ 0: the Lagrangian of the problem plus a
/// quadratic penalty is minimised repeatedly while the multipliers are updated. NLopt's implementation (AUGLAG, after
/// Birgin and Martínez) is used with an inner preconditioned truncated Newton method, which stays closest to the
/// optimum of all methods of NLopt. The variables are those of ScaledProblem with 0 ≤ τ ≤ 1, and the start is where
/// the circumcircles touch. Both loops end when the relative change of the variables is below `tolerance` (usually
/// 1e-10), or after 1000 evaluations. A result that violates a constraint by more than 1e-6 means no contact. The
/// method is local.
Prediction2 augmented_lagrangian(const CollisionCase& asked, double tolerance);

}  // namespace vitrel::bench

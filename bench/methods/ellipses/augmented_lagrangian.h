#pragma once

#include "bench/methods/collision_case.h"
#include "core/contact/first_contact.h"

namespace vitrel::bench {

/// Augmented Lagrangian, equation (3.28) of woetzel2012, for E₁ ≤ 0 and E₂ ≤ 0: the Lagrangian of the
/// problem plus a quadratic penalty, minimised again and again while the multipliers are updated.
/// NLopt's implementation (AUGLAG, after Birgin and Martínez) with a preconditioned truncated Newton
/// method inside (of NLopt's methods it stays closest to the optimum), in
/// the variables of ScaledProblem with 0 ≤ τ ≤ 1, from where the circumcircles touch. `tolerance` (usual
/// 1e-10): the relative change of the variables at which both loops end; 1000 evaluations end them too.
/// A result that violates a constraint by more than 1e-6 means no contact. Local.
Prediction2 augmented_lagrangian(const CollisionCase& asked, double tolerance);

}  // namespace vitrel::bench

#pragma once

#include "bench/methods/collision_case.h"
#include "core/contact/first_contact.h"

namespace vitrel::bench {

/// Quadratic penalty with a decreasing parameter, equation (3.26) of woetzel2012. It minimises, each time from the
/// previous minimum,
///     f(y) = τ + (E₁² + E₂²)/2μ,   μ = 1, 0.1, … down to `tolerance` (usually 1e-10),
/// in the variables of ScaledProblem with 0 ≤ τ ≤ 1, by damped Newton steps with exact second derivatives (newton.h).
/// At the minimum Eᵢ = μ λᵢ with the multipliers λᵢ, so the time is early by μ (λ₁² + λ₂²) to first order. A final
/// |Eᵢ| above √tolerance means no contact. The method is local.
Prediction2 quadratic_penalty(const CollisionCase& asked, double tolerance);

}  // namespace vitrel::bench

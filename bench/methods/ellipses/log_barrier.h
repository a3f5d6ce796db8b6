#pragma once

#include "bench/methods/collision_case.h"
#include "core/contact/first_contact.h"

namespace vitrel::bench {

/// Logarithmic barrier with a decreasing parameter, equation (3.27) of woetzel2012: minimise, from
/// where the last minimum was,
///     f(y) = τ − μ (ln(−E₁) + ln(−E₂)),   μ = 0.1, 0.01, … down to `tolerance` (usual 1e-10),
/// in the variables of ScaledProblem by damped Newton steps (newton.h). Every point stays inside
/// both ellipses, so the method needs one to begin with: of 32 times spread over the bracket, the
/// first with Perram-Wertheim F < 1, and the point where the ellipses shrunk by √F touch. Without
/// such a time it reports no contact: contacts that last shorter than its step escape it. The time is
/// late by about 2μ (in units of the bracket). Local: the beginning of the overlap that was found.
Prediction2 log_barrier(const CollisionCase& asked, double tolerance);

}  // namespace vitrel::bench

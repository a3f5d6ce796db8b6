#pragma once

#include "bench/methods/collision_case.h"
#include "core/contact/first_contact.h"

namespace vitrel::bench {

/// Logarithmic barrier with a decreasing parameter, equation (3.27) of woetzel2012. It minimises, each time from the
/// previous minimum,
///     f(y) = τ − μ (ln(−E₁) + ln(−E₂)),   μ = 0.1, 0.01, … down to `tolerance` (usually 1e-10),
/// in the variables of ScaledProblem by damped Newton steps (newton.h). Every point lies inside both ellipses, so the
/// method needs such a point to start: it takes the first of 32 times spread over the bracket at which the
/// Perram-Wertheim F < 1, and the point where the ellipses shrunk by √F touch. If there is no such time it reports no
/// contact, so it misses contacts that last shorter than this step. The time is late by about 2μ in units of the
/// bracket. The method is local: it finds the beginning of the overlap in which it starts.
Prediction2 log_barrier(const CollisionCase& asked, double tolerance);

}  // namespace vitrel::bench

#pragma once

#include "bench/methods/collision_case.h"
#include "core/contact/first_contact.h"

namespace vitrel::bench {

/// Simulated annealing (GSL, gsl_siman) on a penalised objective (penalised.h) of weight 300.
///
/// The temperature, in units of the objective (1 is the whole bracket), falls from 0.3 by 3 % every 20 trials until
/// it is below `tolerance` (usually 1e-4). A trial moves all three variables by up to a length that is drawn between
/// `tolerance` and 1, uniformly in its logarithm, because GSL uses the same step width at all temperatures. The
/// random numbers start from the same seed in every call. The result is the best point found; if it violates a
/// constraint by more than 1e-2, there is no contact. The method is global in principle, but seldom comes closer than
/// 1e-3 of the bracket, whatever the tolerance.
Prediction2 simulated_annealing(const CollisionCase& asked, double tolerance);

}  // namespace vitrel::bench

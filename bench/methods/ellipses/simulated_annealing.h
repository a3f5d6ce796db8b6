#pragma once

#include "bench/methods/collision_case.h"
#include "core/contact/first_contact.h"

namespace vitrel::bench {

/// Simulated annealing (GSL, gsl_siman) on a penalised objective (penalised.h) of weight 300.
///
/// The temperature, in units of the objective (1 is the whole bracket), falls from 0.3 by 3 % every 20
/// trials until it is below `tolerance` (usual 1e-4). A trial moves all three variables by up to a
/// length drawn between `tolerance` and 1, evenly in its logarithm: GSL gives the same step width at all
/// temperatures. The random numbers start from the same seed in every call. The best point ever seen
/// is the result, as it is; if it violates a constraint by more than 1e-2 there is no contact.
/// Global in principle, but it seldom comes closer than 1e-3 of the bracket, whatever the tolerance.
Prediction2 simulated_annealing(const CollisionCase& asked, double tolerance);

}  // namespace vitrel::bench

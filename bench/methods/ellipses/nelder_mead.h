#pragma once

#include "bench/methods/collision_case.h"
#include "core/contact/first_contact.h"

namespace vitrel::bench {

/// The simplex method of Nelder and Mead (GSL, nmsimplex2) on a penalised objective (penalised.h).
///
/// The weight of the penalty grows from 10 tenfold up to 10/tolerance (usual 1e-10). Every weight
/// gets a fresh simplex about the last result, as wide as the last move, and is done with when the
/// simplex is smaller than the tolerance (in the scaled variables). The first one starts where the
/// circumcircles touch. A result that violates a constraint by more than √tolerance means no contact.
/// Local, and blind to a first contact that its simplex steps over.
Prediction2 nelder_mead(const CollisionCase& asked, double tolerance);

}  // namespace vitrel::bench

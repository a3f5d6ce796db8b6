#pragma once

#include "bench/methods/collision_case.h"
#include "core/contact/first_contact.h"

namespace vitrel::bench {

/// The simplex method of Nelder and Mead (GSL, nmsimplex2) on a penalised objective (penalised.h).
///
/// The weight of the penalty grows in factors of ten from 10 to 10/tolerance (tolerance usually 1e-10). For every
/// weight, a new simplex is placed about the last result, as wide as the last move, and is minimised until it is
/// smaller than the tolerance (in the scaled variables). The first simplex lies where the circumcircles touch. A
/// result that violates a constraint by more than √tolerance means no contact. The method is local, and misses a
/// first contact that its simplex steps over.
Prediction2 nelder_mead(const CollisionCase& asked, double tolerance);

}  // namespace vitrel::bench

#pragma once

#include "bench/methods/method.h"

namespace vitrel::bench {

/// What an engine takes from a method that is not exact. Such a method finds the pair that has just
/// collided touching still: a contact at which the surfaces recede is no answer (not_converged, known
/// to be free up to time 0). The default method's answers remain as they are.
Prediction2 unchecked_answer(const Method& method, const CollisionCase& asked);

}  // namespace vitrel::bench

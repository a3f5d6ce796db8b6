#pragma once

#include "bench/methods/method.h"

namespace vitrel::bench {

/// The answer that an engine accepts from a method that is not exact. Such a method finds that the pair which has
/// just collided still touches, so a contact at which the surfaces recede is no answer (not_converged, known to be
/// free up to time 0). Answers of the default method are not changed.
Prediction2 unchecked_answer(const Method& method, const CollisionCase& asked);

}  // namespace vitrel::bench

#pragma once

#include "bench/lab/collision_case.h"
#include "core/contact/first_contact.h"

namespace vitrel::lab {

/// The default of the engine: advance along a separating axis (core/contact/first_contact.h).
/// `tolerance` is the contact gap in units of a₁ + a₂ (usual 32 ε).
Prediction2 separating_axis(const CollisionCase& asked, double tolerance);

}  // namespace vitrel::lab

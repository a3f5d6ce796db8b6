#pragma once

#include "bench/methods/collision_case.h"
#include "core/contact/first_contact.h"

namespace vitrel::bench {

/// The default method of the engine, which advances along a separating axis (core/contact/first_contact.h).
/// `tolerance` is the contact gap in units of the sum of the largest semi-axes (usually 32 ε).
template <int Dim>
Prediction<Dim> separating_axis(const CollisionCaseOf<Dim>& asked, double tolerance);

}  // namespace vitrel::bench

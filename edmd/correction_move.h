#pragma once

#include "edmd/collision_rule.h"

namespace vitrel {

/// The correction move for an overlapping pair (on_overlap = "correct"): the relative velocity is turned into the line
/// of centres so that the bodies separate; angular velocities do not change. Conserves momentum and energy, but not
/// angular momentum. `d` runs from centre 1 to centre 2.
template <int Dim>
void separate(Motion<Dim>& one, const Inertia<Dim>& inertia1, Motion<Dim>& two,
              const Inertia<Dim>& inertia2, const Vec<Dim>& d);

}  // namespace vitrel

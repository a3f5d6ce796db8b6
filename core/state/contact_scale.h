#pragma once

#include "core/state/configuration.h"

namespace vitrel {

/// The factor by which both particles of a pair must be scaled about their centres to touch (perram_wertheim.h): below 1
/// if they overlap, 0 if their centres coincide.
template <int Dim>
double contact_scale(const Configuration<Dim>& configuration, const PairImage<Dim>& pair);

/// Scales all particles about their centres until the first two touch, by a factor that is returned: 1 if none overlap.
/// The exact check then finds no overlap. Throws InvariantError if two centres coincide.
template <int Dim>
double shrink_to_contact(Configuration<Dim>& configuration);

}  // namespace vitrel

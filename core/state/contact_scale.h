#pragma once

#include "core/state/configuration.h"

namespace vitrel {

/// Returns the factor by which both particles of a pair must be scaled about their centres to touch
/// (perram_wertheim.h): it is below 1 if they overlap, and 0 if their centres coincide.
template <int Dim>
double contact_scale(const Configuration<Dim>& configuration, const PairImage<Dim>& pair);

/// Shrinks all particles about their centres by a common factor until the first two only touch, and returns the factor,
/// which is 1 if none overlap. The exact check then finds no overlap. Throws InvariantError if two centres coincide.
template <int Dim>
double shrink_to_contact(Configuration<Dim>& configuration);

}  // namespace vitrel

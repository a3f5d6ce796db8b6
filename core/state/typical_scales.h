#pragma once

#include "core/state/configuration.h"

/// @file
/// The size of a particle, and the length and the time that are typical of all of them, so that options can be relative
/// to these: medians over the particles, of an even number the lower one. A few large particles among many small ones
/// leave both as they are.
namespace vitrel {

/// √(a b), or ∛(a b c).
double size_of(const Ellipse& shape);
double size_of(const Ellipsoid& shape);

/// The median size.
template <int Dim>
double typical_length(const Configuration<Dim>& configuration);

/// τ, in which a particle moves by about its own size: of √(m a b/kT), or √(m/kT) ∛(a b c), at kT = 1.
template <int Dim>
double typical_time(const Configuration<Dim>& configuration);

}  // namespace vitrel

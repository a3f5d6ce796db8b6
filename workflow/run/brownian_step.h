#pragma once

#include <string>

#include "core/state/configuration.h"

/// @file
/// How long a step of Brownian dynamics is: √(kT/m) τ_B, the distance between two draws of the velocities, over the size of
/// a typical particle. The limit of short steps is overdamped motion (scala2007). `scripts/validate brownian_step`
/// measures how much longer relaxation takes: from φ = 0.3 to 0.8 by 4 % or less at 0.1, by 12 to 18 % at 0.3, and twice as long
/// at 1. That hardly depends on the density, and so not on the gaps between particles: collisions are exact.
namespace vitrel {

template <int Dim>
double step_in_sizes(double brownian_step, const Configuration<Dim>& particles);

/// Beyond 0.2 a warning; else empty.
template <int Dim>
std::string long_step_text(double brownian_step, const Configuration<Dim>& particles);

}  // namespace vitrel

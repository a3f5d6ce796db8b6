#pragma once

#include <string>

#include "core/state/configuration.h"
#include "workflow/configuration/parameters.h"

/// @file
/// What a run is expected to cost, for its plan: collisions by theory (edmd/hard_fluid.h), good to a factor of two for
/// elastic fluids below freezing. Inelastic particles slow down and collide less.
namespace vitrel {

struct RunCost {
  double collisions = 0;
  double events = 0;
  double seconds = 0;       ///< on one core of a processor of our days
  double memory_bytes = 0;  ///< of the process, without correlations on the fly
  double disk_bytes = 0;    ///< of the trajectory
};

/// What the particles are simulated as, and why: "rotating ellipses, since some particle is not round". `some`: the
/// particles of the run, or some that represent them.
template <int Dim>
std::string model_text(const Parameters& parameters, const Configuration<Dim>& some);

/// `some`: the particles of the run, or some that represent them.
template <int Dim>
RunCost run_cost(const Parameters& parameters, const Configuration<Dim>& some);

/// A warning if a step of Brownian dynamics is longer than 0.2; else empty.
///
/// How long a step is: √(kT/m) τ_B, the distance between two draws of the velocities, over the size of a typical
/// particle (its typical time, typical_scales.h). The limit of short steps is overdamped motion (scala2007).
/// `vitrel bench brownian-step` measures how much longer relaxation takes: from φ = 0.3 to 0.8 by 2.2 % or less at 0.1,
/// by 7 to 17 % at 0.3, and by 70 to 100 % at 1 (docs/studies/brownian-step.md). That hardly depends on the density,
/// and so not on the gaps between particles: collisions are exact.
std::string long_step_text(double brownian_step, double typical_time);

}  // namespace vitrel

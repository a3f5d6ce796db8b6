#pragma once

#include <string>

#include "core/state/configuration.h"
#include "workflow/configuration/parameters.h"

/// @file
/// The expected cost of a run, for its plan. Collisions are counted by theory (edmd/hard_fluid.h), good to a factor
/// of two for elastic fluids below freezing. Inelastic particles slow down and collide less often.
namespace vitrel {

struct RunCost {
  double collisions = 0;
  double events = 0;
  double seconds = 0;       ///< on one core of a present-day processor
  double memory_bytes = 0;  ///< of the process, without correlations on the fly
  double disk_bytes = 0;    ///< of the trajectory
};

/// Says how the particles are simulated, and why: "rotating ellipses, since some particle is not round". `some` are
/// the particles of the run, or particles that represent them.
template <int Dim>
std::string model_text(const Parameters& parameters, const Configuration<Dim>& some);

/// `some` are the particles of the run, or particles that represent them.
template <int Dim>
RunCost run_cost(const Parameters& parameters, const Configuration<Dim>& some);

/// Returns a warning if a step of Brownian dynamics is longer than 0.2, else an empty text.
///
/// The length of a step is √(kT/m) τ_B, with the time τ_B between two draws of the velocities, over the size of a
/// typical particle (or τ_B over its typical time, typical_scales.h). Short steps approach overdamped motion
/// (scala2007). `vitrel bench brownian-step` measures how much longer relaxation takes: from φ = 0.3 to 0.8 by 2.2 %
/// or less at 0.1, by 7 to 17 % at 0.3, and by 70 to 100 % at 1 (docs/studies/brownian-step.md). This hardly depends
/// on the density, and so not on the gaps between particles, because collisions are exact.
std::string long_step_text(double brownian_step, double typical_time);

}  // namespace vitrel

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

}  // namespace vitrel

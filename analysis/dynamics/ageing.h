#pragma once

#include <vector>

#include "analysis/dynamics/displacement.h"

/// @file
/// How a run changes with its age.
namespace vitrel {

/// What follows a waiting time t_w.
struct AgedMotion {
  double waiting_time;   ///< of the frame, since the first one
  Displacements motion;  ///< from this frame alone to all later ones
  /// The length of domains in this frame (correlation_length in order.h); NaN in space, and without rotors.
  double nematic_length;
};

/// Correlations of the configuration at t_w with that at t_w + t, for every waiting time of the options: in equilibrium
/// they depend on t alone, in a glass on t_w as well. The frame of a waiting time is the first one not before it, to
/// rounding. F_s at the first of the wave numbers, L_2 (in space P_2 of the axes). Errors are those of particles
/// (CorrelationSum). Throws UserError for a waiting time that is not followed by a frame.
template <int Dim>
std::vector<AgedMotion> ageing(Trajectory<Dim>& trajectory, DisplacementOptions options,
                               const ProgressReport& report = {});

}  // namespace vitrel

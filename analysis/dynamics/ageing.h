#pragma once

#include <vector>

#include "analysis/dynamics/displacement.h"

/// @file
/// The change of a run with its age.
namespace vitrel {

/// The motion after a waiting time t_w.
struct AgedMotion {
  double waiting_time;   ///< time of its frame since the first one
  Displacements motion;  ///< from this frame alone to all later ones
  /// The length of domains in this frame (correlation_length in order.h); NaN in space, and without rotors.
  double nematic_length;
};

/// Correlates the configuration at t_w with that at t_w + t, for every waiting time of the options: in equilibrium the
/// correlations depend on t alone, in a glass on t_w as well. The frame of a waiting time is the first one not before
/// it, up to rounding. F_s is measured at the first of the wave numbers, and L_2 (in space P_2 of the axes). Errors are
/// those of particles (CorrelationSum). Throws UserError for a waiting time that is not followed by a frame.
template <int Dim>
std::vector<AgedMotion> ageing(Trajectory<Dim>& trajectory, DisplacementOptions options,
                               const ProgressReport& report = {});

}  // namespace vitrel

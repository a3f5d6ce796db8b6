#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/observables/dynamics_tables.h"
#include "analysis/observables/frame_observable.h"
#include "analysis/observables/motion_tables.h"
#include "workflow/analyze/analyze.h"
#include "workflow/configuration/parameters.h"
#include "workflow/storage/trajectory_file.h"

namespace vitrel {

/// All that is measured, before it is put into tables.
struct RunAnalysis {
  std::size_t particles, rotors, rotations, frames;
  double packing_fraction, duration, collisions;
  std::vector<Column> state;            ///< of the last frame, for the summary
  std::string obstacle;                 ///< to saying anything about motion, if there is one
  std::optional<RunDynamics> dynamics;  ///< otherwise
  std::optional<RunMotion> motion;      ///< likewise
  EnergySeries energy;
  CompressibilitySeries compressibility;
  DiffusionCoefficient diffusion, rotational_diffusion;  ///< of all particles
  FrameResults structure;
  std::optional<GlassRun> glass;
};

/// Measures what the tables that are wanted need, in the run of this name.
template <int Dim>
RunAnalysis run_analysis(TrajectoryFile<Dim>& trajectory, const std::string& name,
                         const Parameters& parameters, const TableChoice& wanted,
                         const AnalysisProgress& progress);

}  // namespace vitrel

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

/// All measurements of a run, before they are put into tables.
struct RunAnalysis {
  std::size_t particles, rotors, rotations, frames;
  double packing_fraction, duration, collisions;
  std::vector<Column> state;            ///< columns of the summary that describe the last frame
  std::string obstacle;                 ///< why motion cannot be measured; empty if it can
  std::optional<RunDynamics> dynamics;  ///< none if there is an obstacle or no table needs them
  std::optional<RunMotion> motion;      ///< none if there is an obstacle
  EnergySeries energy;
  CompressibilitySeries compressibility;
  DiffusionCoefficient diffusion, rotational_diffusion;  ///< averages over all particles
  FrameResults structure;
  std::optional<GlassRun> glass;
};

/// Measures what the `wanted` tables need. `name` is the name of the run.
template <int Dim>
RunAnalysis run_analysis(TrajectoryFile<Dim>& trajectory, const std::string& name,
                         const Parameters& parameters, const TableChoice& wanted,
                         const AnalysisProgress& progress);

}  // namespace vitrel

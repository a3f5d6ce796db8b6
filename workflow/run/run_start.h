#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/io/checkpoint.h"
#include "edmd/run.h"
#include "workflow/prepare/prepare.h"
#include "workflow/run/run.h"

/// @file
/// Where a run starts: at the end of its preparation, or at its checkpoint.
namespace vitrel {

/// The checkpoint of the run with this output.
std::filesystem::path checkpoint_path(const std::filesystem::path& output);

/// What the checkpoint of a run holds.
template <int Dim>
struct RunCheckpoint {
  RunState<Dim> state;
  double wall_seconds = 0;
  bool complete = false;
  std::vector<double> correlations;  ///< state of those measured on the fly; empty: none yet
  std::string parameters;            ///< effective parameters, TOML
};

template <int Dim>
Checkpoint to_checkpoint(const RunCheckpoint<Dim>& run);

/// The run to continue, also if its file to start from is no longer there; parameters of the request that depend on it
/// are set. A complete run that becomes longer goes on from the checkpoint before its last. UserError if the request
/// has parameters that may not change, FileError if the trajectory is not there, or not that of the run.
template <int Dim>
RunCheckpoint<Dim> stored_run(RunRequest& request, const Checkpoint& checkpoint);

/// What prepares the state to start from.
PrepareRequest preparation_request(const RunRequest& request);

/// UserError if there is an output to which no checkpoint belongs.
void refuse_foreign_output(const std::filesystem::path& output);

/// Those at the start of the run. UserError if all particles are at rest.
template <int Dim>
void set_velocities(Configuration<Dim>& configuration, const Parameters& parameters);

/// The time of the run for a person.
std::string time_text(double time, double start);

}  // namespace vitrel

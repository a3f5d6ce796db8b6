#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/io/checkpoint.h"
#include "edmd/run.h"
#include "workflow/prepare/prepare.h"
#include "workflow/run/run.h"

/// @file
/// The start of a run: the end of its preparation, or its checkpoint.
namespace vitrel {

/// The path of the checkpoint of the run with this output.
std::filesystem::path checkpoint_path(const std::filesystem::path& output);

/// The content of the checkpoint of a run.
template <int Dim>
struct RunCheckpoint {
  RunState<Dim> state;
  double wall_seconds = 0;
  bool complete = false;
  /// The state of the correlations on the fly; empty if there is none yet.
  std::vector<double> correlations;
  std::string parameters;  ///< effective parameters as TOML
};

template <int Dim>
Checkpoint to_checkpoint(const RunCheckpoint<Dim>& run);

/// Returns the run to continue, even if the state file from which it started is gone, and sets the parameters of the
/// request that depend on that file. A complete run that becomes longer continues from its last checkpoint but one.
/// Throws UserError if the request changes parameters that must not change, and FileError if the trajectory is
/// missing or belongs to another run.
template <int Dim>
RunCheckpoint<Dim> stored_run(RunRequest& request, const Checkpoint& checkpoint);

/// The request that prepares the state to start from.
PrepareRequest preparation_request(const RunRequest& request);

/// Throws UserError if an output exists to which no checkpoint belongs.
void refuse_foreign_output(const std::filesystem::path& output);

/// Sets the velocities at the start of the run. Throws UserError if all particles are at rest.
template <int Dim>
void set_velocities(Configuration<Dim>& configuration, const Parameters& parameters);

/// The time of the run in words.
std::string time_text(double time, double start);

}  // namespace vitrel

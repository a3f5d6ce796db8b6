#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/io/checkpoint.h"
#include "edmd/run.h"

namespace vitrel {

/// A run as its checkpoint holds it.
template <int Dim>
struct StoredRun {
  RunState<Dim> state;
  double wall_seconds = 0;
  bool complete = false;
  std::vector<double> correlations;  ///< state of those measured on the fly; empty: none yet
  std::string parameters;            ///< effective parameters, TOML
};

template <int Dim>
Checkpoint to_checkpoint(const StoredRun<Dim>& run);
/// Throws FileError, naming `file`, if a number is missing, or it is of the other dimension.
template <int Dim>
StoredRun<Dim> run_from_checkpoint(const Checkpoint& checkpoint, const std::filesystem::path& file);

}  // namespace vitrel

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/io/checkpoint.h"
#include "edmd/run.h"

namespace vitrel {

/// A run as its checkpoint holds it.
struct StoredRun {
  RunState2 state;
  double wall_seconds = 0;
  bool complete = false;
  std::vector<double> correlations;  ///< state of those measured on the fly; empty: none yet
  std::string parameters;            ///< effective parameters, TOML
};

Checkpoint to_checkpoint(const StoredRun& run);
/// Throws FileError, naming `file`, if a number is missing.
StoredRun from_checkpoint(const Checkpoint& checkpoint, const std::filesystem::path& file);

}  // namespace vitrel

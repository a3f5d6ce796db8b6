#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "core/state/configuration.h"

namespace vitrel {

/// All that a run needs to go on as if it had never stopped: the state at a block's end, and the
/// numbers that the parts of the run keep, by name.
struct Checkpoint {
  Configuration2 configuration;
  std::map<std::string, double> reals;
  std::map<std::string, std::uint64_t> counters;
  std::string parameters;  ///< TOML text of the run it belongs to
};

/// Writes `<path>.partial`, waits for the disk, keeps the checkpoint before as `<path>.previous`,
/// and renames. Every double is kept bit by bit. Killed at any moment, or on a full disk, at least
/// one complete checkpoint stays. Throws FileError; both earlier files are then still there.
void save_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);

struct LoadedCheckpoint {
  Checkpoint checkpoint;
  std::string warning;  ///< empty, or why the previous one had to be taken
};

/// The newest readable one of `path` and `<path>.previous`. Throws FileError if neither is.
LoadedCheckpoint load_checkpoint(const std::filesystem::path& path);

/// Whether load_checkpoint has a file to try.
bool checkpoint_exists(const std::filesystem::path& path);

}  // namespace vitrel

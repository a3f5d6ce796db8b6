#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "core/state/configuration.h"

namespace vitrel {

/// Everything needed to continue a computation as if it had never stopped: the configuration, and named values of the
/// parts of the computation.
struct Checkpoint {
  std::variant<Configuration2, Configuration3> configuration;
  std::map<std::string, double> reals;
  std::map<std::string, std::uint64_t> counters;
  std::map<std::string, std::vector<double>> series;
  std::map<std::string, std::string> texts;  ///< without zero bytes
  std::string parameters;                    ///< TOML text of the computation
};

/// Returns the dimension of the configuration.
inline int dimension_of(const Checkpoint& checkpoint) {
  return checkpoint.configuration.index() == 0 ? 2 : 3;
}

/// Writes a partial file (atomic_file.h), waits for the disk, renames the last checkpoint to `<path>.previous`, and
/// renames the partial file to `path`. Doubles are stored exactly, and a checksum covers all bytes. If the process is
/// killed at any moment, or the disk is full, at least one complete checkpoint stays. Throws FileError; both earlier
/// files are then still there.
void save_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);

struct LoadedCheckpoint {
  Checkpoint checkpoint;
  std::string warning;  ///< empty, or why the previous checkpoint had to be taken
};

/// Returns the newest undamaged checkpoint of `path` and `<path>.previous`. Throws FileError if there is none.
LoadedCheckpoint load_checkpoint(const std::filesystem::path& path);

/// Returns `<path>.previous`, the checkpoint before the newest. Throws FileError.
Checkpoint load_previous_checkpoint(const std::filesystem::path& path);

/// Returns whether load_checkpoint has a file to try.
bool checkpoint_exists(const std::filesystem::path& path);

/// Removes both files, if there are any. Throws FileError.
void remove_checkpoint(const std::filesystem::path& path);

}  // namespace vitrel

#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "core/state/configuration.h"

namespace vitrel {

/// Everything needed to continue a computation as if it had never stopped: the configuration, and the items of its
/// parts by name.
struct Checkpoint {
  std::variant<Configuration2, Configuration3> configuration;
  std::map<std::string, double> reals;
  std::map<std::string, std::uint64_t> counters;
  std::map<std::string, std::vector<double>> series;
  std::map<std::string, std::string> texts;  ///< without zero bytes
  std::string parameters;                    ///< TOML text of the work it belongs to
};

/// The dimension of its configuration.
inline int dimension_of(const Checkpoint& checkpoint) {
  return checkpoint.configuration.index() == 0 ? 2 : 3;
}

/// Writes a file beside it (atomic_file.h), waits for the disk, keeps the checkpoint before as `<path>.previous`,
/// and renames. Doubles are stored exactly, and a checksum covers all bytes. Killed at any moment, or on
/// a full disk, at least one complete checkpoint stays. Throws FileError; both earlier files are then still there.
void save_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);

struct LoadedCheckpoint {
  Checkpoint checkpoint;
  std::string warning;  ///< empty, or why the previous one had to be taken
};

/// The newest undamaged one of `path` and `<path>.previous`. Throws FileError if neither is.
LoadedCheckpoint load_checkpoint(const std::filesystem::path& path);

/// `<path>.previous`: the one before the newest. Throws FileError.
Checkpoint load_previous_checkpoint(const std::filesystem::path& path);

/// Whether load_checkpoint has a file to try.
bool checkpoint_exists(const std::filesystem::path& path);

/// Removes both files, if there are any. Throws FileError.
void remove_checkpoint(const std::filesystem::path& path);

}  // namespace vitrel

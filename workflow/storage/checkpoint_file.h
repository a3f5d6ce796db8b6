#pragma once

#include <filesystem>

#include "core/io/checkpoint.h"
#include "workflow/log.h"
#include "workflow/storage/work_timer.h"

namespace vitrel {

/// The checkpoint of a run or preparation, beside its output. Functions throw FileError.
class CheckpointFile {
 public:
  /// `interval` is the wall time between two checkpoints in seconds.
  CheckpointFile(std::filesystem::path path, double interval)
      : path_(std::move(path)), interval_(interval) {}

  const std::filesystem::path& path() const { return path_; }
  bool exists() const { return checkpoint_exists(path_); }
  /// `log` gets a line if the checkpoint is not the newest that was written.
  Checkpoint load(const Log& log) const {
    LoadedCheckpoint loaded = load_checkpoint(path_);
    if (!loaded.warning.empty()) log_line(log, loaded.warning);
    return std::move(loaded.checkpoint);
  }
  void save(const Checkpoint& checkpoint) {
    save_checkpoint(path_, checkpoint);
    since_last_ = WorkTimer();
  }
  /// Whether the interval has passed since the last checkpoint.
  bool is_due() const { return since_last_.seconds() >= interval_; }

 private:
  std::filesystem::path path_;
  double interval_;
  WorkTimer since_last_;
};

}  // namespace vitrel

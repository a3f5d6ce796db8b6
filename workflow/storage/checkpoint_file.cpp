#include "workflow/storage/checkpoint_file.h"

namespace vitrel {

Checkpoint CheckpointFile::load(const Log& log) const {
  LoadedCheckpoint loaded = load_checkpoint(path_);
  if (!loaded.warning.empty()) log_line(log, loaded.warning);
  return std::move(loaded.checkpoint);
}

void CheckpointFile::save(const Checkpoint& checkpoint) {
  save_checkpoint(path_, checkpoint);
  since_last_ = WorkTimer();
}

}  // namespace vitrel

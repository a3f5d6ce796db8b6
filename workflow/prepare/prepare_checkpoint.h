#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/io/checkpoint.h"
#include "workflow/prepare/prepare.h"
#include "workflow/stages/stage_state.h"

namespace vitrel {

/// What the checkpoint of a preparation holds.
template <int Dim>
struct PrepareCheckpoint {
  Preparation<Dim> done;     ///< `stages` are those that have ended
  StageState state;          ///< of the stage after them, if there is one
  double stage_seconds = 0;  ///< wall time spent on that stage
  std::string parameters;    ///< effective parameters, TOML
};

template <int Dim>
Checkpoint to_checkpoint(const PrepareCheckpoint<Dim>& preparation);
/// `stages`: of the whole preparation. Throws FileError, naming `file`, if something is missing.
template <int Dim>
PrepareCheckpoint<Dim> preparation_from_checkpoint(const Checkpoint& checkpoint,
                                                   const std::vector<Stage>& stages,
                                                   const std::filesystem::path& file);

}  // namespace vitrel

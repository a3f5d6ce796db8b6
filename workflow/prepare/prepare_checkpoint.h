#pragma once

#include <filesystem>
#include <string>

#include "core/io/checkpoint.h"
#include "mc/compression.h"
#include "mc/swelling.h"
#include "workflow/prepare/hybrid.h"
#include "workflow/prepare/prepare.h"

namespace vitrel {

/// Where the stage at work stands; every method uses its own field.
struct StageWork {
  SamplingState sampling;
  SwellingState swelling;
  CompressionState compression;
  GrowthState growth;
  HybridState hybrid;
  double wall_seconds = 0;

  StageWork() = default;
  explicit StageWork(std::uint64_t next_sweep) {
    for (SweepState* moves :
         {&sampling.local, &swelling.moves, &compression.moves, &hybrid.sampling.local})
      moves->next_sweep = next_sweep;
    sampling.chains.next_sweep = hybrid.sampling.chains.next_sweep = next_sweep;
  }
};

/// A preparation at work, as its checkpoint holds it.
template <int Dim>
struct StoredPreparation {
  Preparation<Dim> done;   ///< `stages` are those that have ended
  StageWork work;          ///< of the stage after them
  std::string parameters;  ///< effective parameters, TOML
};

template <int Dim>
Checkpoint to_checkpoint(const StoredPreparation<Dim>& preparation);
/// Throws FileError, naming `file`, if something is missing.
template <int Dim>
StoredPreparation<Dim> preparation_from_checkpoint(const Checkpoint& checkpoint,
                                                   const std::filesystem::path& file);

}  // namespace vitrel

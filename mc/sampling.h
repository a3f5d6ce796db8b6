#pragma once

#include <cstdint>

#include "core/state/configuration.h"
#include "core/state/stage.h"
#include "mc/trials.h"

namespace vitrel {

struct SamplingOptions {
  std::uint64_t sweeps = 1000;
  int threads = 1;  ///< the result does not depend on it
};

/// Monte Carlo at constant packing fraction (sampler.h), as a stage that brings a state to equilibrium:
/// step sizes adapt all the way. `reached` when `state` counts the wanted sweeps, `stopped` by the
/// budget between two sweeps; the same call then goes on bit by bit.
StageReport sample(Configuration2& configuration, const SamplingOptions& options,
                   std::uint64_t seed, SweepState& state, const Budget& budget);

}  // namespace vitrel

#pragma once

#include <cstdint>

#include "core/state/configuration.h"
#include "core/state/stage.h"
#include "mc/event_chain.h"
#include "mc/sweep_state.h"

namespace vitrel {

/// How particles move: by event chains (event_chain.h), which forget density and places many times sooner
/// and orientations about as fast, or by local trial moves (sampler.h), which can use several threads.
enum class Moves { chains, local };

struct SamplingOptions {
  std::uint64_t sweeps = 1000;
  Moves moves = Moves::chains;
  double exchanges = 0;  ///< share of the local moves (sampler.h)
  int threads = 1;       ///< of local moves; the result does not depend on it
};

/// Where a sampling stands; each kind of moves uses its own.
struct SamplingState {
  ChainState chains;
  SweepState local;

  std::uint64_t sweeps() const { return chains.sweeps + local.sweeps; }
};

/// Monte Carlo at constant packing fraction, as a stage that brings a state to equilibrium: chains and
/// steps adapt all the way. `reached` when `state` counts the wanted sweeps, `stopped` by the run control
/// between two sweeps; the same call then goes on bit by bit. The reason tells if chains were cut short.
StageReport sample(Configuration2& configuration, const SamplingOptions& options,
                   std::uint64_t seed, SamplingState& state, const RunControl& control);

}  // namespace vitrel

#pragma once

#include <cstdint>

#include "core/state/configuration.h"
#include "core/state/stage.h"
#include "mc/event_chain.h"
#include "mc/options.h"
#include "mc/sweep_state.h"

namespace vitrel {

/// Where a sampling stands; each kind of moves uses its own.
struct SamplingState {
  ChainState chains;
  SweepState local;

  std::uint64_t sweeps() const { return chains.sweeps + local.sweeps; }
  /// The sweep that comes next draws by this number, whichever kind of moves it is of.
  void number_sweeps(std::uint64_t next) { chains.next_sweep = local.next_sweep = next; }
};

/// Monte Carlo at constant packing fraction, as a stage that brings a state to equilibrium: chains and
/// steps adapt all the way. `reached` when `state` counts the wanted sweeps, `stopped` by the budget
/// between two sweeps; the same call then goes on bit by bit. The reason tells if chains were cut short.
StageReport sample(Configuration2& configuration, const SamplingOptions& options,
                   std::uint64_t seed, SamplingState& state, const Budget& budget);

}  // namespace vitrel

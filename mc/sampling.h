#pragma once

#include <cstdint>

#include "core/state/configuration.h"
#include "core/state/stage.h"
#include "mc/event_chain.h"
#include "mc/sweep_state.h"

namespace vitrel {

/// Moves: event chains (event_chain.h), which decorrelate density and positions many times faster and orientations
/// about as fast, or local trial moves (sampler.h), which can use several threads.
enum class Moves { chains, local };

struct SamplingOptions {
  std::uint64_t sweeps = 1000;
  Moves moves = Moves::chains;
  double exchanges = 0;  ///< share of the local moves (sampler.h)
  int threads = 1;       ///< of local moves; the result does not depend on it
};

/// The state of a sampling; each kind of moves uses its own.
struct SamplingState {
  ChainState chains;
  SweepState local;

  std::uint64_t sweeps() const { return chains.sweeps + local.sweeps; }
};

/// Monte Carlo at constant packing fraction, as an equilibration stage: chains and step sizes adapt throughout.
/// `reached` when `state` counts the requested sweeps, `stopped` on request between two sweeps; the same call then
/// continues with bit-identical results. The reason says if chains were cut short.
StageReport sample(Configuration2& configuration, const SamplingOptions& options,
                   std::uint64_t seed, SamplingState& state, const RunControl& control);

}  // namespace vitrel

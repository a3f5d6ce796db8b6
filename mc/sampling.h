#pragma once

#include <cstdint>
#include <vector>

#include "core/state/configuration.h"
#include "core/state/stage.h"
#include "mc/event_chain.h"
#include "mc/options.h"
#include "mc/sweep_state.h"

namespace vitrel {

/// The state of a count of how often a sampled configuration has decorrelated. It has decorrelated when places,
/// orientations and sizes, each place by place (place_correlation.h), have all fallen to 1/e at some time since the
/// first configuration. The configuration of that moment then becomes the first one. Comparisons follow after numbers
/// of sweeps that grow by a tenth. The state is a plain value, which together with the configuration suffices to go on
/// counting.
struct DecorrelationState {
  std::uint64_t count = 0;
  // These count from the present first configuration:
  bool places = false, orientations = false, sizes = false;  ///< whether these have decorrelated
  std::uint64_t begin = 0, next = 0;  ///< sweeps at its time, and at the next comparison
  std::vector<double> first;          ///< position, image and orientation of every particle in it
};

/// The state of a sampling; each kind of moves uses its own.
struct SamplingState {
  ChainState chains;
  SweepState local;
  DecorrelationState decorrelation;  ///< unused if decorrelations are not counted

  std::uint64_t sweeps() const { return chains.sweeps + local.sweeps; }
  void number_sweeps(std::uint64_t next) { chains.next_sweep = local.next_sweep = next; }
};

/// Samples by Monte Carlo at constant packing fraction, as an equilibration stage: chains and step sizes adapt
/// throughout. Returns `reached` when `state` counts the requested sweeps or decorrelations, `stalled` if the
/// decorrelations take more than the maximum of sweeps, and `stopped` on request between two sweeps, after which the
/// same call continues with bit-identical results. The reason says if chains were cut short.
template <int Dim>
StageReport sample(Configuration<Dim>& configuration, const SamplingOptions& options,
                   std::uint64_t seed, SamplingState& state, const RunControl& control);

}  // namespace vitrel

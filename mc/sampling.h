#pragma once

#include <cstdint>
#include <vector>

#include "core/state/configuration.h"
#include "core/state/stage.h"
#include "mc/event_chain.h"
#include "mc/options.h"
#include "mc/sweep_state.h"

namespace vitrel {

/// The state of a count of how often a sampled configuration has decorrelated: places, orientations and sizes, each
/// place by place (place_correlation.h), have all fallen to 1/e at some time since the first configuration. Then the
/// next configuration is the first one. They are compared after numbers of sweeps that grow by a tenth. A plain value,
/// together with the configuration sufficient to go on counting.
struct DecorrelationState {
  std::uint64_t count = 0;
  // Since the first of the present configurations:
  bool places = false, orientations = false, sizes = false;  ///< these have decorrelated
  std::uint64_t begin = 0, next = 0;  ///< sweeps at it, and at the next comparison
  std::vector<double> first;          ///< position, image and orientation of every particle
};

/// The state of a sampling; each kind of moves uses its own.
struct SamplingState {
  ChainState chains;
  SweepState local;
  DecorrelationState decorrelation;  ///< unused without a number of decorrelations

  std::uint64_t sweeps() const { return chains.sweeps + local.sweeps; }
  void number_sweeps(std::uint64_t next) { chains.next_sweep = local.next_sweep = next; }
};

/// Monte Carlo at constant packing fraction, as an equilibration stage: chains and step sizes adapt throughout.
/// `reached` when `state` counts the requested sweeps or decorrelations, `stalled` if these take more than the maximum
/// of sweeps, `stopped` on request between two sweeps; the same call then continues with bit-identical results. The
/// reason says if chains were cut short.
template <int Dim>
StageReport sample(Configuration<Dim>& configuration, const SamplingOptions& options,
                   std::uint64_t seed, SamplingState& state, const RunControl& control);

}  // namespace vitrel

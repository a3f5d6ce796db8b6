#pragma once

#include <cstdint>
#include <vector>

#include "core/state/configuration.h"
#include "core/state/stage.h"
#include "mc/options.h"
#include "mc/sweep_state.h"

namespace vitrel {

struct CompressionState {
  SweepState moves;
  BoxState box;
  std::vector<double> packing_fraction;  ///< after every sweep

  void number_sweeps(std::uint64_t next) { moves.next_sweep = next; }
};

/// Compresses at constant pressure. Returns `reached` at the target packing fraction or, without one, after all sweeps;
/// `stalled` if the sweeps did not suffice or the packing fraction no longer rises, that is, by less than a thousandth
/// from the third to the last quarter of at least 4000 sweeps; `stopped` on request between two sweeps, after which the
/// same call continues with bit-identical results. Step sizes adapt throughout; without a target, they adapt only in
/// the first half of the sweeps, so that the second half samples equilibrium. In any case no particles overlap. A
/// configuration denser than the target is expanded.
template <int Dim>
StageReport compress(Configuration<Dim>& configuration, const CompressionOptions& options,
                     std::uint64_t seed, CompressionState& state, const RunControl& control);

}  // namespace vitrel

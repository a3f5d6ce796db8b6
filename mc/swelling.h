#pragma once

#include <cstdint>

#include "mc/options.h"
#include "core/state/configuration.h"
#include "core/state/stage.h"
#include "mc/sweep_state.h"

namespace vitrel {

/// The state at the end of a round.
struct SwellingState {
  SweepState moves;
  double growth = 0.02;  ///< g − 1 of the next round
  // The last check for jamming.
  std::uint64_t checked_sweeps = 0;
  double checked_packing_fraction = 0;
};

/// `reached` at the target packing fraction; `stalled` if the sweeps are used up, or if the particles are jammed: the
/// packing fraction rises by less than a relative 1e-4 in 5000 sweeps; `stopped` on request, at the end of the
/// previous round: the same call then continues with bit-identical results. In any case the state is hard. A
/// configuration denser than the target is expanded.
StageReport swell(Configuration2& configuration, const SwellingOptions& options, std::uint64_t seed,
                  SwellingState& state, const RunControl& control);

}  // namespace vitrel

#pragma once

#include <cstdint>

#include "core/state/configuration.h"
#include "core/state/stage.h"
#include "edmd/growth.h"
#include "mc/sampling.h"
#include "workflow/stages/hybrid_options.h"

namespace vitrel {

struct HybridState {
  GrowthState growth;
  SamplingState sampling;
  std::uint64_t stretches = 0;  ///< completed intervals of both kinds
  double stretch_end = 0;       ///< packing fraction at which the current interval of growth ends

  void number_sweeps(std::uint64_t next) { sampling.number_sweeps(next); }
};

/// Compression by alternating intervals of event-driven growth (edmd/growth.h) and of Monte Carlo, which relaxes the
/// liquid at the packing fraction reached.
///
/// An interval of growth ends when all lengths have grown by 1 %, or by 0.2/Z if that is less. It then has used about a
/// fifth of the free lengths, and Z has risen by the same fraction. Velocities are redrawn after every interval of
/// Monte Carlo. Goals are reached during growth, which ends the stage.
///
/// Returns `reached` at the target packing fraction or pressure and `stalled` if the particles jam before. Returns
/// `stopped` if the run control stops it; the same call then continues with bit-identical results. Everything else is
/// as in `grow`.
template <int Dim>
StageReport hybrid(Configuration<Dim>& configuration, const HybridOptions& options,
                   HybridState& state, const RunControl& control);

}  // namespace vitrel

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
  std::uint64_t stretches = 0;  ///< of both kinds, complete
  double stretch_end = 0;       ///< packing fraction at which the present growth ends
};

/// Compression by both engines in turn: event-driven growth (edmd/growth.h), and Monte Carlo at the
/// packing fraction reached, in which the liquid relaxes.
///
/// A stretch of growth ends when all lengths have grown by 1 %, or by 0.2/Z if that is less: then about
/// a fifth of the free lengths is used up, and Z has risen by as much. Velocities are
/// drawn anew after every stretch of Monte Carlo. Goals are met within growth, which ends the stage.
///
/// `reached` at the wanted packing fraction or pressure, `stuck` if the particles are jammed before,
/// `stopped` by the run control: the same call then continues and its result is bit-identical. Else as `grow`.
StageReport hybrid(Configuration2& configuration, const HybridOptions& options, HybridState& state,
                   const RunControl& control);

}  // namespace vitrel

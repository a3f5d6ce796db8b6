#pragma once

#include <cstdint>
#include <optional>

#include "core/state/configuration.h"
#include "core/state/stage.h"
#include "edmd/growth.h"
#include "mc/sampling.h"

namespace vitrel {

/// Compression by both engines in turn: event-driven growth (edmd/growth.h), and Monte Carlo at the
/// packing fraction reached, in which the liquid relaxes.
///
/// A stretch of growth ends when all lengths have grown by 1 %, or by 0.2/Z if that is less: then about
/// a fifth of the free lengths is used up, and Z has risen by as much. Velocities are
/// drawn anew after every stretch of Monte Carlo. Goals are met within growth, which ends the stage.
struct HybridOptions {
  double growth_rate = 1e-2;
  std::optional<double> packing_fraction;     ///< ends there, exactly
  std::optional<double> reduced_pressure;     ///< ends at such a pressure
  SamplingOptions stretch = {.sweeps = 100};  ///< of Monte Carlo
  std::uint64_t seed = 1;
};

struct HybridState {
  GrowthState growth;
  SamplingState sampling;
  std::uint64_t stretches = 0;  ///< of both kinds, complete
  double stretch_end = 0;       ///< packing fraction at which the present growth ends
};

/// `reached` at the wanted packing fraction or pressure, `stuck` if the particles are jammed before,
/// `stopped` by the run control: the same call then goes on bit by bit. Else as `grow`.
StageReport hybrid(Configuration2& configuration, const HybridOptions& options, HybridState& state,
                   const RunControl& control);

}  // namespace vitrel

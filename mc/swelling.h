#pragma once

#include <cstdint>

#include "core/state/configuration.h"
#include "core/state/stage.h"

namespace vitrel {

/// Swelling to a wanted packing fraction: sweeps of Monte Carlo, and after each all particles swell
/// together until the first pair touches. What counts is the ratio of particle to box size; since
/// the reference species has a b = 1, the particles keep their size and the box and all positions
/// shrink, which is the same state in other units.
struct SwellingOptions {
  double packing_fraction = 0.7;   ///< to be reached, exactly
  std::uint64_t sweeps = 1000000;  ///< at most
};

/// `reached` at the wanted packing fraction, `stuck` if the sweeps were used up (the state is hard,
/// at the packing fraction reached), `stopped` by the budget. Sweeps are numbered from
/// `first_sweep`, which returns as the next one.
StageReport swell(Configuration2& configuration, const SwellingOptions& options, std::uint64_t seed,
                  std::uint64_t& first_sweep, const Budget& budget);

}  // namespace vitrel

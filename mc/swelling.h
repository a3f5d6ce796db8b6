#pragma once

#include <cstdint>

#include "core/state/configuration.h"
#include "core/state/stage.h"
#include "mc/sweep_state.h"

namespace vitrel {

/// Swelling to a wanted packing fraction, by Monte Carlo.
///
/// Steps of one round, to enlarge all particles by a factor g:
///   1. A sweep of trial moves, their step sizes adapted to the density.
///   2. Every particle that is not yet enlarged is enlarged alone, by g, if there is room for it.
///   3. Repeat until all are enlarged; if some find no room in 40 sweeps, g − 1 is halved for all.
///   4. All lengths are divided by g: since the reference species has a b = 1, the particles have
///      their old size again, and the box is smaller. A fast_sweeps round makes the next one greedier.
/// No particle waits for the closest pair of the whole system, so the sweeps needed grow slowly with
/// N. A round that ends without success (jammed, or stopped) shrinks the box as far as the closest
/// pair allows (shrink_to_contact). The wanted packing fraction is met to rounding.
struct SwellingOptions {
  double packing_fraction = 0.7;   ///< to be reached, exactly
  std::uint64_t sweeps = 1000000;  ///< at most
  int threads = 1;                 ///< the result does not depend on it
};

/// Where a swelling stands, at the end of a round.
struct SwellingState {
  SweepState moves;
  double growth = 0.02;  ///< g − 1 of the next round
  // The last look at whether the particles are jammed.
  std::uint64_t checked_sweeps = 0;
  double checked_packing_fraction = 0;
};

/// `reached` at the wanted packing fraction; `stuck` if the sweeps were used up, or if the
/// particles are jammed: the packing fraction rises by less than 1e-4 of itself in 5000 sweeps;
/// `stopped` by the run control, at the end of the round before: the same call then goes on bit by bit. In any
/// case the state is hard. A configuration that is denser than wanted already is expanded.
StageReport swell(Configuration2& configuration, const SwellingOptions& options, std::uint64_t seed,
                  SwellingState& state, const RunControl& control);

}  // namespace vitrel

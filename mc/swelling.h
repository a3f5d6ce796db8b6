#pragma once

#include <cstdint>

#include "core/state/configuration.h"
#include "core/state/stage.h"
#include "mc/options.h"
#include "mc/sweep_state.h"

namespace vitrel {

/// The state at the end of a round.
struct SwellingState {
  SweepState moves;
  double growth = 0.02;  ///< g − 1 of the next round
  // These are the values at the last check for jamming.
  std::uint64_t checked_sweeps = 0;
  double checked_packing_fraction = 0;

  void number_sweeps(std::uint64_t next) { moves.next_sweep = next; }
};

/// Compression by swelling: Monte Carlo to a target packing fraction.
///
/// One round enlarges all particles by a factor g:
///   1. A sweep of trial moves is made, with step sizes adapted to the density.
///   2. Each particle that is not yet enlarged is enlarged by g if there is space for it.
///   3. Steps 1 and 2 repeat until all are enlarged; if some find no space in 40 sweeps, g − 1 is halved for all.
///   4. All lengths are divided by g, so that the particles have their old sizes again (the reference species has
///      a b = 1, or a b c = 1), and the box is smaller. After a fast round the next g is larger.
/// No particle waits for the closest pair of the whole system, so the number of sweeps grows slowly with N. An
/// unsuccessful round (jammed, or stopped) shrinks the box as far as the closest pair allows (shrink_to_contact). The
/// target packing fraction is met to rounding.
///
/// Returns `reached` at the target packing fraction; `stalled` if the sweeps are used up, or if the particles are
/// jammed, that is, if the packing fraction rises by less than a relative 1e-4 in 5000 sweeps; `stopped` on request, at
/// the end of the previous round, after which the same call continues with bit-identical results. In any case no
/// particles overlap. A configuration denser than the target is expanded.
template <int Dim>
StageReport swell(Configuration<Dim>& configuration, const SwellingOptions& options,
                  std::uint64_t seed, SwellingState& state, const RunControl& control);

}  // namespace vitrel

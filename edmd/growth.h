#pragma once

#include <cstdint>

#include "core/state/configuration.h"
#include "core/state/stage.h"
#include "edmd/engine.h"
#include "edmd/options.h"

/// @file
/// Compression of hard particles by growth (Lubachevsky–Stillinger), to a target packing fraction or until they jam:
/// Newtonian dynamics in which all semi-axes of all particles grow at the same rate,
///
///     a_i(t) = (1 + γ t) a_i,   b_i(t) = (1 + γ t) b_i …,   φ(t) = (1 + γ t)^D φ(0)
///
/// in D dimensions. The options give γ τ, where τ is the typical time of the particles (typical_scales.h): one rate
/// then means the same, and costs the same, in any unit of length and mass. Conventions: masses are constant, moments
/// of inertia are those of the current axes, and ω is constant in flight, also for scalene ellipsoids (ellipsoid.h). In
/// a collision the surface speed s = γ (h₁ + h₂) along the normal (h the support functions) adds to the approach speed;
/// every impulse J does the work J s, and the particles heat up.
///
/// Velocities are drawn at the start (brownian.h), from the stream (seed, velocities, draws). A block ends after a
/// fixed count of events, or after a growth of 20 %. In each block
///   1. the engine runs at growth rate γ, in steps that end when kT has risen by about 10 % or, in a dilute gas, after
///      a growth of 5 %;
///   2. after each step, the reduced pressure is Z = βP/ρ = 1 + Σ J n·d/(D N ⟨kT⟩ t), d from centre to centre.
///      kT = 2E/f, f = D (N − 1) + N_rot, rises exponentially at constant Z, and ⟨kT⟩ is the mean of such a rise;
///   3. velocities are rescaled to kT = 1: translational energy D (N − 1)/2 and rotational energy N_rot/2, each by
///      its own factor, as when velocities are drawn. With a common factor the two would drift apart if they are weakly
///      coupled, since collisions of nearly round particles heat only translation.
/// At the end of a block all lengths are divided by 1 + γ t, since growth is equivalent to shrinking the box, and the
/// particles have the sizes of their species again. With kT = 1 and times in units of τ, the motion is the same at all
/// sizes a(t), so γ is relative to the current size.
///
/// Near jamming all gaps shrink together and Z ≈ C/(1 − φ/φ_J). For ideal jamming C is the number of degrees of freedom
/// per particle, less the share of rattlers (disks 2, ellipses and spheres 3, spheroids 5, scalene ellipsoids 6). The
/// collision rate is proportional to Z, and the rise from Z to e Z takes about 1/γ (disks) to 2/γ (ellipses) collisions
/// per particle for any Z, so γ need not be lowered near jamming. It determines how long the liquid can equilibrate
/// before it falls out of equilibrium, and thereby φ_J.
///
/// If the particles jam below the target packing fraction, they can try again: the box grows by a tenth in all
/// directions, as if all lengths shrank (convex particles that do not overlap stay so), velocities are drawn anew, and
/// γ is halved. Systems of few particles jam at widely scattered packing fractions, which rise as γ falls.
///
/// A target packing fraction beyond jamming cannot be reached. From Z = 10⁴ on, 1 − φ/φ_J is at most 6 · 10⁻⁴. From
/// there on the particles count as jammed if the target is more than 30/Z, five times as far, above the packing
/// fraction. If the target is closer, or if there is a target pressure, they count as jammed at `max_reduced_pressure`.
///
/// Growth always terminates, since φ < 1. Validity: |γ τ| well below 1 (otherwise the surfaces are faster than the
/// particles, and Z is meaningless), and Z up to `max_reduced_pressure`. Sources: lubachevsky1990, donev2005.
namespace vitrel {

/// The state of a growth at the end of a block.
struct GrowthState {
  std::uint64_t draws = 0;      ///< number of draws of velocities so far
  std::uint64_t retries = 0;    ///< number of restarts after jamming
  bool under_way = false;       ///< if false, velocities are drawn first
  double reduced_pressure = 0;  ///< value of the last significant step; 0 if there was none
  double time = 0;              ///< sum over steps, each in its current unit
  RunCounters counters;
};

/// Returns `reached` at the target packing fraction or pressure, whichever comes first; `stalled` if the particles jam
/// before that and no retries are left; `stopped` on request at the end of a block, after which the same call continues
/// with bit-identical results. In any case the particles do not overlap, and they have the given shapes and time, a
/// smaller (γ < 0: larger) box, net momentum 0 and kT = 1. Throws UserError if there is no target, if γ leads away from
/// it, or if nothing can move (a lone disk); throws InvariantError on an overlap, or if a particle grows into its own
/// image and cannot rotate away.
template <int Dim>
StageReport grow(Configuration<Dim>& configuration, const GrowthOptions& options,
                 GrowthState& state, const RunControl& control);

}  // namespace vitrel

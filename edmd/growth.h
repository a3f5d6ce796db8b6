#pragma once

#include <cstdint>
#include <optional>

#include "core/state/configuration.h"
#include "core/state/stage.h"
#include "edmd/engine.h"

/// Growth of hard particles in motion, to a wanted packing fraction or until they jam: Newtonian
/// dynamics in which all semi-axes of all particles grow alike,
///
///     a_i(t) = (1 + γ t) a_i,   b_i(t) = (1 + γ t) b_i …,   φ(t) = (1 + γ t)^D φ(0)
///
/// in D dimensions. Conventions: masses stay, the moments of inertia are those of the axes of the moment,
/// and ω is constant in flight (of scalene ellipsoids, too: ellipsoid.h). In an impact the surfaces' own speed s = γ (h₁ + h₂) along the normal
/// (h the support functions) adds to the approach speed, so that every impulse J does the work J s
/// and the particles heat up.
///
/// Velocities are drawn at the start (brownian.h), from the stream (seed, velocities, draws). Blocks end after
/// a fixed count of events, or when all has grown by 20 %. In them
///   1. the engine runs with growth rate γ, in steps that end when kT has risen by some 10 %, or, in a dilute
///      gas, all has grown by 5 %;
///   2. after each, reduced pressure Z = βP/ρ = 1 + Σ J n·d/(D N ⟨kT⟩ t), d from centre to centre. kT = 2E/f,
///      f = D (N − 1) + N_rot, rises exponentially at constant Z; ⟨kT⟩ is the mean of such a rise;
///   3. velocities are rescaled to kT = 1: to D (N − 1)/2 for the translational and N_rot/2 for
///      the rotational energy, each by its own factor, as when velocities are drawn. One factor for
///      both would let them drift apart where they hardly couple: impacts of nearly round particles
///      heat translation only.
/// At a block's end all lengths are divided by 1 + γ t: growing is the same as shrinking the box, and the
/// particles have the sizes of their species again. Lengths a(t) and kT = 1 give the same motion in the unit
/// of time √(m a b/kT) whatever t is, so γ is always relative to the present size and in this unit for the
/// reference species.
///
/// Near jamming all gaps shrink together and Z ≈ C/(1 − φ/φ_J), in a true jam with C the number of
/// degrees of freedom per particle, less the share of rattlers (disks 2, ellipses and spheres 3, spheroids 5, scalene
/// ellipsoids 6). Collisions per
/// time rise like Z, and from Z to e Z it takes about 1/γ (disks) to 2/γ (ellipses) collisions per
/// particle whatever Z is: the rate needs no lowering near jamming. It decides how long the liquid
/// can order before it falls out of equilibrium, and thereby φ_J.
///
/// Growth always ends, since φ < 1. Validity: |γ| well below 1 (beyond, the surfaces are faster than
/// the particles, and Z means nothing), Z up to `max_reduced_pressure`.
/// Sources: lubachevsky1990, donev2005.
namespace vitrel {

/// Beyond, gaps come near to the rounding of the coordinates, and particles count as jammed.
inline constexpr double max_reduced_pressure = 1e9;

struct GrowthOptions {
  double growth_rate = 1e-3;               ///< γ, relative, per unit of time; negative to shrink
  std::optional<double> packing_fraction;  ///< ends there, exactly (tolerance::given_fraction)
  std::optional<double> reduced_pressure;  ///< ends with the first block of such a pressure
  std::uint64_t seed = 1;
};

/// Where a growth stands, at a block's end.
struct GrowthState {
  std::uint64_t draws = 0;      ///< of velocities, of which the next one bears this number
  bool under_way = false;       ///< else velocities are drawn first
  double reduced_pressure = 0;  ///< of the last step that could tell; 0 if there was none
  double time = 0;              ///< of all steps, in the unit of the moment
  RunCounters counters;
};

/// `reached` at the wanted packing fraction or pressure, whichever comes first; `stuck` if the particles
/// are jammed before; `stopped` by the run control, at a block end: the same call then goes on bit by bit. In
/// any case the state is hard, with shapes as given and a smaller (γ < 0: larger) box, net momentum 0 and
/// kT = 1; its time is as given. Throws UserError if there is no goal, if γ leads away from it, or if
/// nothing can move (a lone disk); InvariantError on an overlap, or if a particle grows into its own image
/// and cannot turn away.
template <int Dim>
StageReport grow(Configuration<Dim>& configuration, const GrowthOptions& options,
                 GrowthState& state, const RunControl& control);

}  // namespace vitrel

#pragma once

#include "core/random/stream.h"
#include "core/state/configuration.h"

namespace vitrel {

/// The kinetic energy that corresponds to kT = 1 once the net momentum has been removed.
///   total:    Σ m v²/2 = D N kT/2 in D dimensions; the mean squared displacement of free particles then has no
///             term of order 1/N
///   relative: Σ m v²/2 = D (N − 1) kT/2; Newtonian equipartition then is exact
/// The rotational energy is N_rot kT/2 in both, N_rot the number of rotational degrees of freedom that smooth
/// collisions change: 1 for an ellipse, 2 for a spheroid, 3 for a scalene ellipsoid, 0 for a round particle.
enum class Temperature { total, relative };

/// Draws all velocities: v ~ N(0, kT/m) per component and ω ~ N(0, kT/I), from the streams (seed, purpose, step,
/// particle); then removes the net momentum and rescales translation and rotation to exactly the energies of
/// `temperature`. Rotations that smooth collisions do not change are not modelled: round particles get ω = 0,
/// spheroids no spin about their axes. A single particle keeps its momentum.
///
/// The result does not depend on the number of threads. This is both the initial draw and the Brownian step
/// (thesis, section 1 of the sources): repeated every τ_B, a free particle diffuses with D₀ = kT τ_B/(2m) and
/// D_r0 = kT τ_B/(2I).
template <int Dim>
void draw_velocities(Configuration<Dim>& configuration, std::uint64_t seed, Purpose purpose,
                     std::uint64_t step, Temperature temperature, int threads = 1);

/// The initial velocities of a run.
enum class InitialVelocities {
  maxwell,      ///< drawn as above
  translation,  ///< drawn, then all energy put into translation
  rotation,     ///< drawn, then all energy put into rotation
  keep,         ///< those of the configuration
};
/// Throws UserError where a split is impossible (rotation without any particle that can rotate).
template <int Dim>
void set_initial_velocities(Configuration<Dim>& configuration, std::uint64_t seed,
                            InitialVelocities kind, Temperature temperature);

}  // namespace vitrel

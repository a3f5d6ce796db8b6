#pragma once

#include "core/random/stream.h"
#include "core/state/configuration.h"

namespace vitrel {

/// Which kinetic energy counts as the temperature kT = 1 once the net momentum has been removed.
///   total:    Σ m v²/2 = D N kT/2 in D dimensions; the mean squared displacement of free particles then has no
///             term in 1/N
///   relative: Σ m v²/2 = D (N − 1) kT/2; Newtonian equipartition then is exact
/// The rotational energy is N_rot kT/2 in both, N_rot the number of rotations that smooth collisions
/// can see: of an ellipse 1, a spheroid 2, a scalene ellipsoid 3, a round particle 0.
enum class Temperature { total, relative };

/// Draws all velocities anew: v ~ N(0, kT/m) per component and ω ~ N(0, kT/I), from the streams
/// (seed, purpose, step, particle); then removes the net momentum and rescales translation and
/// rotation to exactly the energies of `temperature`. Rotations that smooth collisions never see are not
/// modelled: round particles get ω = 0, spheroids none about their axes. A single particle keeps its momentum.
///
/// The same on any number of threads. This is both the initial draw and the Brownian step (thesis, section 1 of the sources): repeated
/// every τ_B, a free particle diffuses with D₀ = kT τ_B/(2m) and D_r0 = kT τ_B/(2I).
template <int Dim>
void draw_velocities(Configuration<Dim>& configuration, std::uint64_t seed, Purpose purpose,
                     std::uint64_t step, Temperature temperature, int threads = 1);

/// How the velocities of a run begin.
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

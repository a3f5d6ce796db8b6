#pragma once

#include "core/random/stream.h"
#include "core/state/configuration.h"
#include "edmd/options.h"

namespace vitrel {

/// Draws all velocities: v ~ N(0, kT/m) per component and ω ~ N(0, kT/I), from the streams (seed, purpose, step,
/// particle); then removes the net momentum and rescales translation and rotation to exactly the energies of
/// `temperature`. Rotations that contacts do not change are at rest: if they are smooth, round particles have ω = 0,
/// and spheroids have no spin about their axes. A single particle keeps its momentum.
///
/// The result does not depend on the number of threads. This is both the initial draw and the Brownian step
/// (thesis, section 1 of the sources): repeated every τ_B, a free particle diffuses with D₀ = kT τ_B/(2m) and
/// D_r0 = kT τ_B/(2I).
template <int Dim>
void draw_velocities(Configuration<Dim>& configuration, std::uint64_t seed, Purpose purpose,
                     std::uint64_t step, Temperature temperature,
                     Contacts contacts = Contacts::smooth, int threads = 1);

/// The velocities of a run at its start. With temperatures of species, energies are Σ kT_i in the place of N kT. Throws
/// UserError if the energy cannot be distributed so: rotation of smooth round particles, or no energy at all.
template <int Dim>
void set_initial_velocities(Configuration<Dim>& configuration, std::uint64_t seed,
                            InitialVelocities kind, Temperature temperature,
                            const InitialEnergies& energies = {},
                            Contacts contacts = Contacts::smooth);

/// Homogeneous driving by random forces, as of a vibrated or fluidised granular gas (vannoije1998): every `interval`
/// each particle is kicked, v += g √(2 P τ N/((N − 1) D m)) with D normal numbers g per particle from the stream (seed,
/// kicks, step, particle), τ the interval and P the power; then Σ m v is brought back to what it was. On average this
/// supplies the energy P per particle and unit of time. Rotations are not kicked. With τ well below the time between
/// collisions it is the white noise ξ₀² = 2P/(D m).
///
/// A single particle is not kicked, since it would keep its momentum. The result does not depend on the number of
/// threads.
template <int Dim>
void kick(Configuration<Dim>& configuration, const Driving& driving, std::uint64_t seed,
          std::uint64_t step, int threads = 1);

}  // namespace vitrel

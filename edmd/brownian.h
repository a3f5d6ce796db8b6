#pragma once

#include "core/random/stream.h"
#include "core/state/configuration.h"
#include "edmd/options.h"

namespace vitrel {

/// Draws all velocities and then fixes momentum and energy. Each component of v is drawn from N(0, kT/m) and each of ω
/// from N(0, kT/I), from the streams (seed, purpose, step, particle). Then the net momentum is removed, and translation
/// and rotation are rescaled to exactly the energies of `temperature`. Rotations that contacts do not change stay at
/// rest: if contacts are smooth, round particles have ω = 0, and spheroids have no spin about their axes. A single
/// particle keeps its momentum.
///
/// The result does not depend on the number of threads. This function makes both the initial draw and the Brownian step
/// (thesis, section 1 of the sources): if it is repeated every τ_B, a free particle diffuses with D₀ = kT τ_B/(2m) and
/// D_r0 = kT τ_B/(2I).
template <int Dim>
void draw_velocities(Configuration<Dim>& configuration, std::uint64_t seed, Purpose purpose,
                     std::uint64_t step, Temperature temperature,
                     Contacts contacts = Contacts::smooth, int threads = 1);

/// Sets the velocities at the start of a run. If species have temperatures, the energies are Σ kT_i instead of N kT.
/// Throws UserError if `kind` requires an energy that cannot exist: rotation of smooth round particles, or any energy
/// if all temperatures are 0.
template <int Dim>
void set_initial_velocities(Configuration<Dim>& configuration, std::uint64_t seed,
                            InitialVelocities kind, Temperature temperature,
                            const InitialEnergies& energies = {},
                            Contacts contacts = Contacts::smooth);

/// Drives the system homogeneously by random forces, as in a vibrated or fluidised granular gas (vannoije1998). Every
/// `interval`, each particle is kicked: v += g √(2 P τ N/((N − 1) D m)), where g is D normal numbers per particle from
/// the stream (seed, kicks, step, particle), τ the interval and P the power. Then Σ m v is brought back to its value
/// before the kick. On average this supplies the energy P per particle and unit of time. Rotations are not kicked. If τ
/// is well below the time between collisions, the driving is the white noise ξ₀² = 2P/(D m).
///
/// A single particle is not kicked, since it would keep its momentum. The result does not depend on the number of
/// threads.
template <int Dim>
void kick(Configuration<Dim>& configuration, const Driving& driving, std::uint64_t seed,
          std::uint64_t step, int threads = 1);

}  // namespace vitrel

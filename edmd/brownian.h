#pragma once

#include "core/random/stream.h"
#include "core/state/configuration.h"
#include "edmd/options.h"

namespace vitrel {

/// Draws all velocities: v ~ N(0, kT/m) per component and ω ~ N(0, kT/I), from the streams (seed, purpose, step,
/// particle); then removes the net momentum and rescales translation and rotation to exactly the energies of
/// `temperature`. Rotations that contacts do not change are at rest: if they are smooth, round particles have ω = 0, and
/// spheroids have no spin about their axes. A single particle keeps its momentum.
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

}  // namespace vitrel

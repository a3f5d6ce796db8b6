#pragma once

#include "core/state/configuration.h"
#include "workflow/configuration/parameters.h"

/// @file
/// What a run is expected to cost, for its plan.
///
/// Collisions. The virial theorem relates their rate to the compressibility factor, (Z − 1) D N kT = ν ⟨J⟩ ⟨n·r⟩, with
/// the mean impulse ⟨J⟩ = √(2π μ kT) at the effective mass 1/μ = Σ (1/m + ℓ²/I), ℓ the lever of the contact point, and
/// ⟨n·r⟩ twice the mean support function ⟨h⟩. Averages are over uniform normals n and over the particles. Z is that of
/// scaled-particle theory for convex bodies (gibbons1969), in the plane 1/(1 − φ) + P²/(4πA) φ/(1 − φ)² (boublik1975).
/// Events. Measured numbers of events per collision lie between 1.2 and 3.3.
///
/// Good to a factor of two for elastic fluids below freezing. Inelastic particles slow down and collide less.
namespace vitrel {

struct RunCost {
  double collisions = 0;
  double events = 0;
  double seconds = 0;       ///< on one core of a processor of our days
  double memory_bytes = 0;  ///< of the process, without correlations on the fly
  double disk_bytes = 0;    ///< of the trajectory
};

/// `some`: the particles of the run, or some that represent them.
template <int Dim>
RunCost run_cost(const Parameters& parameters, const Configuration<Dim>& some);

/// Particles as the parameters describe them; at most some thousands.
template <int Dim>
Configuration<Dim> representative_particles(const Parameters& parameters);

}  // namespace vitrel

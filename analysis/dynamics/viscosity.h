#pragma once

#include <cstddef>
#include <vector>

#include "analysis/dynamics/correlation.h"
#include "analysis/dynamics/diffusion.h"

namespace vitrel {

/// Properties of a run on which its viscosity depends, beside the moments.
struct ViscosityScale {
  double volume;       ///< V, an area in the plane
  double temperature;  ///< kT
  /// A time after which the stress has decayed; NaN where the run is too short to tell.
  double relaxation_time;
};

struct Viscosity {
  std::vector<double> lag;           ///< time differences t
  std::vector<std::size_t> origins;  ///< number of origins averaged over, for every lag
  Correlation moment;                ///< ⟨ΔG(t)²⟩/(2 V kT)
  DiffusionCoefficient shear;        ///< η, with the time differences of its slope
};

/// Returns the shear viscosity η from the Helfand moments G_ab of the frames (edmd/momentum_flux.h), a ≠ b,
///
///     ⟨[G_ab(t) − G_ab(0)]²⟩/(2 V kT) → η t + constant
///
/// (helfand1960, in the form of alder1970 for collisions), averaged over the elements `moments`, each with a value per
/// frame, and over time origins. It is Green and Kubo's integral of the stress autocorrelation, without its noise from
/// sampling, and exact for impulses.
///
/// 1. All frames are origins. The errors are those of CorrelationSum by blocks; there is none at lags with fewer than
///    eight blocks.
/// 2. Let τ be the relaxation time. η is the slope between τ and 3 τ, where the constant has dropped out. Its error is
///    that of the series of this slope at every origin, by the same blocks. If τ is unknown, the samples are not evenly
///    spaced, or the run is too short, there is no η, and the reason is given.
///
/// The formula holds for isotropic fluids of elastic particles whose momentum and energy are conserved; the box should
/// be about cubic. The cost is about (lags) × (frames) × 2 ns for each element.
Viscosity shear_viscosity(const std::vector<double>& times,
                          const std::vector<std::vector<double>>& moments,
                          const ViscosityScale& scale, TimeAxisOptions axis = {});

}  // namespace vitrel

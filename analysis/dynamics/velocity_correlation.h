#pragma once

#include <vector>

#include "analysis/dynamics/correlation.h"
#include "analysis/dynamics/displacement_options.h"
#include "analysis/structure/frame_average.h"
#include "analysis/trajectory.h"

/// @file
/// Autocorrelation of velocities, and its spectrum.
namespace vitrel {

/// The correlations of the velocities v, or of the angular velocities ω in their place.
struct VelocityCorrelation {
  double mean_square = 0;   ///< ⟨v²⟩ at the origins of t = 0
  Correlation correlation;  ///< C(t) at every lag
  Averages spectrum;        ///< g(ω) at every frequency
};

struct VelocityCorrelations {
  std::vector<double> lag;           ///< time differences t, from 0
  std::vector<std::size_t> origins;  ///< time origins averaged over, for every lag
  std::vector<double> frequency;     ///< ω in radians per time; empty if there are no spectra
  VelocityCorrelation translation;
  VelocityCorrelation rotation;  ///< without values if no particle turns in the first frame
};

/// Computes the velocity autocorrelation function and its cosine transform,
///
///     C(t) = ⟨v(0)·v(t)⟩/⟨v²⟩,  g(ω) = (2/π) ∫₀^∞ C(t) cos ωt dt,  ∫₀^∞ g(ω) dω = C(0) = 1,
///
/// averaged over particles, each with the same weight whatever its mass, and over time origins. Green and Kubo's
/// D = ⟨v²⟩/d ∫₀^∞ C dt in d dimensions is π ⟨v²⟩ g(0)/(2d). For harmonic vibrations of one mass g is the density of
/// states; for velocities forgotten at a rate γ it is (2/π) γ/(γ² + ω²) (hansen2013).
///
/// 1. Velocities are those of the frames, with respect to the box; soft particles in contact count with the velocity
///    after it. Brownian steps draw velocities anew, so C is 0 from one step on. Angular velocities are in the axes of
///    space; those of particles that do not turn are 0.
/// 2. Lags are 0 and those of the time axis, with the same origins for all, 128 at most (origins_for). ⟨v²⟩ is taken at
///    the origins of each lag, so that C(0) = 1 without error; the errors of C are those of MomentSum::ratio.
/// 3. Spectra need evenly sampled frames, Δ apart. The times are t_k = kΔ for k = 0 … M, where M is at most 400 and
///    ends before the first lag that the time axis leaves out. With Hann's window and the frequencies ω_j = πj/(MΔ) for
///    j = 0 … M,
///    j = 0 … M,
///
///        g(ω_j) = (Δ/π) [C(0) + 2 Σ_{0 < k < M} cos²(πk/(2M)) C(t_k) cos(ω_j t_k)].
///
///    The trapezoidal sum over ω_j returns C(0) up to rounding. Lines have a full width of 2π/(MΔ) at half their
///    height, and what velocities do faster than Δ is folded into ω ≤ π/Δ.
/// 4. The error of g is that of the same sum at every origin that has all M lags, linearised as in 2.
///
/// The file is read once, or several times for a few particles each if their components, 8 bytes each per frame, exceed
/// `options.memory`. Threads share the lags; the result depends neither on their number nor on `memory`. The cost is
/// about (lags) × (origins) × N × 5 ns for both.
template <int Dim>
VelocityCorrelations velocity_correlations(Trajectory<Dim>& trajectory,
                                           const DisplacementOptions& options = {},
                                           const ProgressReport& report = {});

}  // namespace vitrel

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/dynamics/correlation.h"
#include "analysis/dynamics/displacement_options.h"
#include "analysis/dynamics/time_axis.h"
#include "analysis/trajectory.h"
#include "core/parallel.h"

/// @file
/// Correlations of single particles: how far each has moved and turned in a time t, from unwrapped
/// positions and angles. Δr = r(t) − r(0), Δθ = θ(t) − θ(0); lengths in units where a b = 1, angles
/// in radians.
namespace vitrel {

struct DisplacementGroup {
  std::string name;  ///< "all", or the name of a species
  std::size_t particles = 0;
  std::size_t rotors =
      0;  ///< particles that are not round; the rotation of round ones is not modelled
  Correlation translation;   ///< ⟨|Δr|²⟩, the mean squared displacement (MSD)
  Correlation quartic;       ///< ⟨|Δr|⁴⟩
  Correlation non_gaussian;  ///< α₂ = ⟨|Δr|⁴⟩/(2⟨|Δr|²⟩²) − 1
  /// F_s(q, t) = ⟨J₀(q |Δr|)⟩ for every wave number: the average of exp(iq·Δr) over all directions
  /// of q in the plane, exact but for 1e-10 (bessel_j0.h).
  std::vector<Correlation> self_scattering;
  // The rest is that of the rotors, and empty without any.
  Correlation parallel;          ///< ⟨(Δr·u)²⟩, u along the long axis at the origin of time
  Correlation perpendicular;     ///< the same, u along the short axis
  Correlation rotation;          ///< ⟨Δθ²⟩, the mean squared rotation (MSR)
  Correlation quartic_rotation;  ///< ⟨Δθ⁴⟩
  Correlation non_gaussian_rotation;     ///< ⟨Δθ⁴⟩/(3⟨Δθ²⟩²) − 1
  std::vector<Correlation> orientation;  ///< L_n(t) = ⟨cos nΔθ⟩ for every order n
};

struct Displacements {
  std::vector<double> lag;           ///< time differences t > 0
  std::vector<std::size_t> origins;  ///< time origins averaged over, for every lag
  std::vector<double> wave_numbers;  ///< those of self_scattering
  std::vector<double> orders;        ///< those of orientation
  double overlap_distance = 0;       ///< that of overlap
  /// "all" first, then every species that has particles, if there is more than one.
  std::vector<DisplacementGroup> groups;
  /// ⟨Q⟩ of the overlap Q(t) = N⁻¹ Σ_i Θ(a − |Δr_i|), the share of particles that are still, or
  /// again, within a of where they were.
  Correlation overlap;
  /// Four-point susceptibility χ_4(t) = N(⟨Q²⟩ − ⟨Q⟩²) (lacevic2003): how many particles move
  /// together. p(1 − p) with p = ⟨Q⟩ if they are independent.
  Correlation susceptibility;
};

/// One pass over particles, lags and origins. Lags and origins are those of the time axis; averages
/// and errors are described at CorrelationSum, those of ratios at MomentSum, χ_4 at susceptibility.
///
/// The file is read once, or several times for a few particles each if the tracks exceed `memory`;
/// the result depends neither on it nor on the number of threads, which share the lags. Besides, the
/// sums take 8 bytes per lag, origin, species and quantity. Cost about (lags) × (origins) × N × 25 ns.
/// Throws UserError for fewer than two frames.
Displacements displacements(Trajectory& trajectory, const DisplacementOptions& options = {},
                            const ProgressReport& report = {});

/// Where the main peak of the structure factor of a dense liquid is, about: the first Bragg peak
/// of the triangular lattice of the same number density ρ, q = 2π √(2ρ/√3).
double main_wave_number(const Configuration2& configuration);
/// The wanted wave numbers, or that of main_wave_number if none is.
std::vector<double> wave_numbers_or_main(std::vector<double> wanted,
                                         const Configuration2& configuration);

}  // namespace vitrel

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
/// Correlations of single particles: how far each has moved and turned in a time t, from unwrapped positions and turns.
/// Δr = r(t) − r(0). Δφ is the change of the angle in the plane, and of the rotation vector (path.h) in space. Lengths
/// are in units where a b = 1 (a b c = 1), and angles in radians.
namespace vitrel {

struct DisplacementGroup {
  std::string name;  ///< "all", or the name of a species
  std::size_t particles = 0;
  /// Particles that are not round; the rotation of round ones is not modelled.
  std::size_t rotors = 0;
  Correlation translation;  ///< ⟨|Δr|²⟩, the mean squared displacement (MSD)
  Correlation quartic;      ///< ⟨|Δr|⁴⟩
  Correlation non_gaussian;  ///< α₂ = d ⟨|Δr|⁴⟩/((d + 2)⟨|Δr|²⟩²) − 1 in d dimensions
  /// F_s(q, t), the average of exp(iq·Δr) over all directions of q, for every wave number: ⟨J₀(q |Δr|)⟩
  /// in the plane (up to 1e-10, bessel_j0.h), ⟨sin(q |Δr|)/(q |Δr|)⟩ in space.
  std::vector<Correlation> self_scattering;
  // The correlations below are those of the rotors, and are empty if there are none.
  Correlation parallel;       ///< ⟨(Δr·u)²⟩, u along the axis (path.h) at the origin of time
  Correlation perpendicular;  ///< ⟨|Δr|² − (Δr·u)²⟩
  // The correlations of turns are empty if the turns are not known (Displacements::unknown_turns).
  Correlation rotation;          ///< ⟨|Δφ|²⟩, the mean squared rotation (MSR)
  Correlation quartic_rotation;  ///< ⟨|Δφ|⁴⟩
  /// Like α₂, with one dimension in the plane and three in space.
  Correlation non_gaussian_rotation;
  /// L_n(t) for every order n of the first axis, of the second …: ⟨cos nΔθ⟩ in the plane, Legendre's
  /// ⟨P_n(u(0)·u(t))⟩ in space.
  std::vector<Correlation> orientation;
};

/// Curves of all particles from the frames of one half of the run alone. Their errors are by blocks, or there are none.
struct HalfOfRun {
  std::vector<double> lag;
  Correlation translation;
  std::vector<Correlation> self_scattering, orientation;
};

struct Displacements {
  int dimension = 2;
  MotionParts parts = {};            ///< which correlations there are
  std::vector<double> lag;           ///< time differences t > 0
  std::vector<std::size_t> origins;  ///< time origins averaged over, for every lag
  std::vector<double> wave_numbers;  ///< wave numbers of self_scattering
  std::vector<double> orders;        ///< orders of orientation
  std::size_t axes = 1;              ///< number of axes of orientation (axis_count in path.h)
  std::string unknown_turns;         ///< why rotations are not given; else empty
  double overlap_distance = 0;       ///< distance of overlap
  /// "all" first, then every species that has particles, if there is more than one.
  std::vector<DisplacementGroup> groups;
  /// The earlier and the later half of an evenly sampled run; there are none with fewer than four frames.
  std::vector<HalfOfRun> halves;
  /// ⟨Q⟩ of the overlap Q(t) = N⁻¹ Σ_i Θ(a − |Δr_i|), the share of particles that are still, or again, within a of
  /// where they were.
  Correlation overlap;
  /// The four-point susceptibility χ_4(t) = N(⟨Q²⟩ − ⟨Q⟩²) (lacevic2003), which shows how many particles move together.
  /// It is p(1 − p) with p = ⟨Q⟩ if they are independent.
  Correlation susceptibility;
};

/// Makes one pass over particles, lags and origins. Lags and origins are those of the time axis, with fewer origins if
/// there are many particles (origins_for). Averages and errors are described at CorrelationSum, those of ratios at
/// MomentSum, and χ_4 at susceptibility.
///
/// The file is read once, or several times for a few particles each if the tracks exceed `memory`. Threads share the
/// lags; the result depends neither on their number nor on `memory`. Besides the tracks, the sums take 8 bytes per lag,
/// origin, species and quantity. The cost is about (lags) × (origins) × N × 25 ns. Throws UserError for fewer than two
/// frames.
template <int Dim>
Displacements displacements(Trajectory<Dim>& trajectory, const DisplacementOptions& options = {},
                            const ProgressReport& report = {});

/// Returns about where the main peak of the structure factor of a dense liquid is: the first Bragg peak of the closest
/// packing with the same number density ρ. It is q = 2π √(2ρ/√3) of the triangular lattice in the plane, and q = 2π √3
/// (ρ/4)^⅓ of the face-centred cubic one in space.
template <int Dim>
double main_wave_number(const Configuration<Dim>& configuration);
/// Returns the given wave numbers, or that of main_wave_number if there are none.
template <int Dim>
std::vector<double> wave_numbers_or_main(std::vector<double> given,
                                         const Configuration<Dim>& configuration) {
  if (given.empty()) given = {main_wave_number(configuration)};
  return given;
}

}  // namespace vitrel

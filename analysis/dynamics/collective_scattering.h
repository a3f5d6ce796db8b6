#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "analysis/dynamics/correlation.h"
#include "analysis/dynamics/time_axis.h"
#include "analysis/trajectory.h"

namespace vitrel {

/// Wave vectors q = 2π (n_x/L_x, n_y/L_y …) of a box whose lengths are about the same. Of q and −q, it has the one
/// whose first component other than 0 is positive.
template <int Dim>
struct WaveVectorShell {
  std::vector<std::array<int, Dim>> n;
  double wave_number;  ///< mean |q|
};

/// Returns the wave vectors with |q| nearest to a wave number, at most 32, and none farther from it than half the
/// distance π/L of wave vectors along the longest side. The cost is O((q L)^(D−1)) in D dimensions. Throws UserError if
/// there is none, which happens below π/L.
template <int Dim>
WaveVectorShell<Dim> wave_vector_shell(const PeriodicBox<Dim>& box, double wave_number);

struct CollectiveScattering {
  std::vector<double> lag;              ///< time differences t, from 0
  std::vector<std::size_t> origins;     ///< time origins averaged over, for every lag
  std::vector<double> wave_numbers;     ///< mean |q| of every shell
  std::vector<std::size_t> modes;       ///< number of wave vectors of every shell
  std::vector<Correlation> scattering;  ///< F(q, t), one for every shell
};

/// The collective (coherent) intermediate scattering function of all particles,
///
///     F(q, t) = N⁻¹ ⟨Re ρ_q(t) ρ_q(0)*⟩,  ρ_q = Σ_j exp(i q·r_j),
///
/// averaged over the wave vectors of a shell and over time origins. It is not normalised: F(q, 0) = S(q).
///
/// 1. One pass over the frames gives ρ_q(t) of every wave vector, with powers of exp(2πi x/L) by multiplication, to an
///    error below 1e-13 N. Threads share the frames. 16 bytes per frame and wave vector are kept.
/// 2. Lags and origins are those of the time axis; F(q, 0) is averaged over all frames. Errors are those of
///    CorrelationSum with wave vectors in the place of particles, since their modes are independent of each other up to
///    O(1/N). For few wave vectors (small q) the errors have Student's wide tails.
///
/// The box must be the same in all frames; otherwise UserError is thrown. The cost is about N × (32 + q L/π) per frame
/// and wave number.
template <int Dim>
CollectiveScattering collective_scattering(Trajectory<Dim>& trajectory,
                                           std::span<const double> wave_numbers,
                                           const TimeAxisOptions& axis = {},
                                           const ProgressReport& report = {},
                                           int threads = std::numeric_limits<int>::max());

}  // namespace vitrel

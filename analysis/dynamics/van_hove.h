#pragma once

#include <vector>

#include "analysis/dynamics/two_times.h"
#include "analysis/structure/structure_options.h"

/// @file
/// Van Hove's functions, the probability to find a particle at r at time t if there was one at 0 at time 0
/// (vanhove1954). It is the same particle in G_s, and another one in G_d:
///
///     G_s(r, t) = N⁻¹ ⟨Σ_i δ(r − [r_i(t) − r_i(0)])⟩,  G_d(r, t) = N⁻¹ ⟨Σ_{i≠j} δ(r − [r_j(t) − r_i(0)])⟩,
///
/// averaged over directions, particles and time origins, in bins of width distance_step with the middles x. Errors,
/// memory and frames read are those of average_two_times.
namespace vitrel {

/// Returns the self part as the density of |Δr|: 2πr G_s in the plane and 4πr² G_s in space, per length, up to
/// distance_max. Its integral over r is 1, except for particles that have moved farther. Displacements are unwrapped.
/// If they are normally distributed with variance s² per axis, it is (r/s²) exp(−r²/(2s²)) in the plane and √(2/π)
/// (r²/s³) exp(−r²/(2s²)) in space; in free flight s² = kT t²/m. The cost is N.
template <int Dim>
TwoTimeFunction<Dim> van_hove_self(const PairCorrelationOptions& options);

/// Returns the distinct part as G_d/ρ, in units of the pairs of N particles anywhere, like g in pair_correlation.h,
/// which it is for t → 0. It is 1 in an ideal gas at any t, and in a liquid at large r up to O(1/N). r is that of
/// nearest images, so in all frames it ends at half the shortest side of the box of `first`.
///
/// Only every n-th particle i is taken at an origin, and other particles at the next one; n is the smallest number that
/// leaves no more than 2¹³ pairs per particle within reach over all lags and origins. Pairs are found by cells, which
/// costs about 0.1 ms per particle.
template <int Dim>
TwoTimeFunction<Dim> van_hove_distinct(const Configuration<Dim>& first,
                                       const std::vector<Lag>& lags,
                                       const PairCorrelationOptions& options);

}  // namespace vitrel

#pragma once

#include "analysis/dynamics/two_times.h"

namespace vitrel {

/// Four-point dynamic structure factor of the particles that are still, or again, where they were (lacevic2003),
///
///     S₄(q, t) = N⁻¹ ⟨|Σ_i w_i exp(i q·r_i(0))|²⟩,  w_i = Θ(a − |r_i(t) − r_i(0)|),
///
/// with a = overlap_distance. It shows how far regions of slow particles reach. It is S(q) as long as all stay within
/// a, and 0 when all have left. If particles stay with probability p independently of each other, it is p² S(q) + p
/// (1 − p).
///
/// 1. x are the mean |q| of the shells of wave_vector_shell at the multiples 1 … 8 of the smallest wave number of the
///    box; each is an average over its wave vectors, 32 at most.
/// 2. For q = 0 the sum is N Q with the overlap Q of displacement.h, so S₄(0, t) = N⟨Q²⟩ = χ₄ + N⟨Q⟩². The mean ⟨Q⟩ is
///    uniform in space and adds nothing at q > 0. For q → 0, S₄ tends to χ₄ plus what fluctuations of the density add,
///    which a box of N particles has at q > 0 only: p² S(q → 0) in the example above.
/// 3. Errors, memory and frames read are those of average_two_times. One origin determines S₄ in a shell of n wave
///    vectors to about S₄/√n, so small q need many independent origins.
///
/// The box must be the same in all frames. The cost is about N × (wave vectors) × 2 ns for every lag and origin.
template <int Dim>
TwoTimeFunction<Dim> four_point_structure(const PeriodicBox<Dim>& box, double overlap_distance);

}  // namespace vitrel

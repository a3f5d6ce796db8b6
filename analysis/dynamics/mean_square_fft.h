#pragma once

#include <span>
#include <vector>

namespace vitrel {

/// Mean squares of the changes of an evenly sampled coordinate over every lag and all origins,
///
///     m(n) = (T − n)⁻¹ Σ_{k=0}^{T−n−1} (x_{k+n} − x_k)²,  n = 0 … T − 1,
///
/// in O(T log T). The mean squared displacement of a particle is that of x plus that of y.
///
/// m(n) = (A(n) − 2 B(n))/(T − n): A(n) = Σ (x_k² + x_{k+n}²) from a recursion, B(n) = Σ x_k x_{k+n}, the
/// autocorrelation, by the Fourier transform of x padded with zeros (kneller1995). x enters relative to
/// its mean. Equal to the direct sum up to the rounding of T max x² ε/(T − n), so relative errors of
/// m(n) are about ε max x²/m(n).
///
/// When to use it: of 10⁴ frames it gives every lag in 0.8 ms, fifty times sooner than the direct sums
/// (41 ms, one processor of 2026), but no errors by blocking and no averages other than squares.
/// `displacements` needs those, and by its choice of lags takes less than 200 of them: it sums directly.
std::vector<double> mean_square_changes(std::span<const double> series);

}  // namespace vitrel

#pragma once

#include "core/state/configuration.h"

namespace vitrel {

/// Pressure of a hard system at constant volume, from the contact function (after Eppenga &
/// Frenkel, 1984).
///
/// Every pair has a contact function F = μ² (perram_wertheim.h): it touches when all distances
/// shrink by 1/μ, that is, the area (volume) by μ^−D in D dimensions. So a shrink by 1/(1 + x) leaves
/// no overlap with probability 1 − n x + …, n the mean number of pairs per unit of μ^D at μ → 1. With
/// Q the configuration integral, βP = ∂ ln Q/∂V, so
///
///     Z = βP/ρ = 1 + n/N.
///
/// In the dilute limit pairs are uniform in μ^D, and n/N = B₂ρ.
///
/// The density of pairs over y = (μ^D − 1)/w on 0 … 1 is extrapolated to 0 by its least-squares
/// cubic. By orthogonality of the Legendre polynomials that is a plain sum over pairs,
///
///     n ≈ Σ K(y)/w,   K = Σ_k (2k+1)(−1)^k P_k(2y − 1) = 16 − 120 y + 240 y² − 140 y³,
///
/// so that no bins are needed and averages over configurations are unbiased up to the cubic itself,
/// whose error falls with w⁴. The window w holds 1.5 pairs per particle in the first configuration,
/// but is at most 0.75. At κ = 2, φ = 0.5 that is w = 0.55: a narrower one gives the same Z within
/// 0.2 %, twice the width is 0.4 % too low.
class ContactPressure {
 public:
  /// Adds one configuration; a block consists of many decorrelated ones.
  template <int Dim>
  void add(const Configuration<Dim>& configuration);
  /// Z from all configurations added so far; at least one.
  double compressibility() const { return 1 + pairs_ / particles_; }
  /// Discards all configurations but keeps the window, for the next block.
  void clear() { pairs_ = particles_ = 0; }

 private:
  double window_ = 0;
  double pairs_ = 0;      // Σ K(y)/w over pairs, summed over configurations
  double particles_ = 0;  // N, summed over configurations
};

}  // namespace vitrel

#pragma once

#include <cmath>

#include "core/state/configuration.h"

namespace vitrel {

/// Pressure of a hard system at constant volume, from the contact function (after Eppenga & Frenkel, 1984).
///
/// Every pair has a contact function F = μ² (perram_wertheim.h): it touches when all distances shrink by 1/μ, that is,
/// the area (volume) by μ^−D in D dimensions. If the area (volume) shrinks by 1/(1 + x), the probability of no overlap
/// is therefore 1 − n x + …, where n is the mean number of pairs per unit of μ^D at μ → 1. Since βP = ∂ ln Q/∂V with
/// the configuration integral Q,
///
///     Z = βP/ρ = 1 + n/N.
///
/// In the dilute limit pairs are uniform in μ^D, and n/N = B₂ρ.
///
/// The density of pairs over y = (μ^D − 1)/w on 0 … 1 is extrapolated to 0 by its least-squares cubic. Since the
/// Legendre polynomials are orthogonal, this is a plain sum over pairs,
///
///     n ≈ Σ K(y)/w,   K = Σ_k (2k+1)(−1)^k P_k(2y − 1) = 16 − 120 y + 240 y² − 140 y³,
///
/// so that no bins are needed and averages over configurations are unbiased up to the error of the cubic itself, which
/// falls with w⁴. In the first configuration, twice the window w holds 1.5 pairs per particle, but 2w is at most 0.75.
/// A fifteenth of the difference between Z at 2w and at w estimates the error at w. For disks at φ = 0.55, twice the
/// window gives Z 0.26 % too small, and the window a sixteenth of that.
class ContactPressure {
 public:
  /// Adds one configuration and returns its Z; a block consists of many decorrelated ones.
  template <int Dim>
  double add(const Configuration<Dim>& configuration);
  /// Returns Z from all configurations added so far, of which there must be at least one.
  double compressibility() const { return 1 + pairs_ / particles_; }
  /// Returns how far Z may be off because the cubic is not the true density of pairs.
  double extrapolation_error() const { return std::abs(wide_pairs_ - pairs_) / particles_ / 15; }
  /// Discards all configurations but keeps the window, for the next block.
  void clear() { pairs_ = wide_pairs_ = particles_ = 0; }

 private:
  double window_ = 0;
  double pairs_ = 0;       // Σ K(y)/w over pairs, summed over configurations
  double wide_pairs_ = 0;  // Σ K(y)/w for twice the window
  double particles_ = 0;   // N, summed over configurations
};

}  // namespace vitrel

#pragma once

#include <cstddef>

#include "core/state/configuration.h"
#include "core/state/figure_axis.h"

/// @file
/// Tests whether the orientations of a packing are isotropic, by the second-rank orientation tensor.
namespace vitrel {

/// T = ⟨w wᵀ⟩ of the figure axes w (figure_axis.h) of the N bodies that are not round; its trace is 1. Isotropic bodies
/// have T = I/3. Parallel ones have the eigenvalues 1, 0, 0, and axes that take all directions in a plane 1/2, 1/2, 0
/// on the average.
struct OrientationTensor {
  Mat3 matrix = Mat3::Zero();  ///< 0 if all bodies are round
  std::size_t axes = 0;        ///< N

  /// Returns the eigenvalues in ascending order.
  Vec3 eigenvalues() const;
  /// Returns ρ = λ_max/λ_min, from 1 to infinity (fewer than three axes); NaN without axes.
  double ratio() const;
  /// Returns the nematic order S = (3 λ_max − 1)/2. It is 1 if all axes are parallel, and by chance about 1/√N
  /// (order.h).
  double nematic_order() const;
  /// Returns the eigenvector of λ_max, either of two opposite ones.
  Vec3 director() const;
};
OrientationTensor orientation_tensor(const Configuration3& packing);

/// ρ of N independent axes, each isotropic. It is not 1, since T fluctuates by about 1/√N.
struct IsotropicRatio {
  double mean;                ///< infinite for N ≤ 4
  double standard_deviation;  ///< standard deviation of one packing; infinite for N ≤ 6
};

/// Returns the values to 2 % of mean − 1 and 5 % of the deviation.
///
/// 1. Up to 1000 axes they come from 2000 × N drawn axes, which are the same at every call.
/// 2. Beyond that they come from the expansion
///      ⟨ρ⟩ = 1 + 3 ⟨g⟩ + (9/2) ⟨g²⟩ + O(N^−3/2),
///      ⟨ρ²⟩ − ⟨ρ⟩² = 9 (⟨g²⟩ − ⟨g⟩²) + 27 (⟨g³⟩ − ⟨g⟩⟨g²⟩) + O(N⁻²),
///      ⟨g⟩ = 3 √(3/π) s,  ⟨g²⟩ = (19/2) s²,  ⟨g³⟩ = (27 √3 + 4π)/√π s³,  s² = 2/(15 N),
///    hence ⟨ρ⟩ = 1 + 3.21/√N + 5.7/N. Proof: with Δ = T − I/3, ρ = 1 + 3g − 9 y g + …, where g = x − y is the
///    difference of the largest and the smallest eigenvalue x and y of Δ. As ⟨w_i w_j w_k w_l⟩ =
///    (δ_ij δ_kl + δ_ik δ_jl + δ_il δ_jk)/15, Δ is a vector of five uncorrelated components of variance s², Gaussian
/// for N → ∞. Its eigenvalues are √(2/3) r cos(ψ + 2πk/3), where r is distributed as the length of that vector and ψ in
/// (0, π/3) with the density (3/2) sin 3ψ (Vandermonde's determinant); so g = √2 r sin(ψ + π/3), and its moments are
/// those above. By the symmetry Δ → −Δ, ⟨y gⁿ⟩ = −⟨gⁿ⁺¹⟩/2, and the third cumulants of Δ, the only other terms of the
/// orders kept, have no effect.
/// The smallest singular value ε of N random axes has the density ε^(N−3) near 0, and ρ ∝ ε⁻²; hence the infinities.
IsotropicRatio isotropic_ratio(std::size_t axes);

}  // namespace vitrel

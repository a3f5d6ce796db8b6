#pragma once

#include "core/geometry/vector.h"

/// @file
/// Random axes with a given second-rank orientation tensor.
namespace vitrel {

class Stream;

/// Returns ⟨u_k²⟩ of the angular central Gaussian distribution in three dimensions, where u = x/|x| with independent
/// normal x_k of variance λ_k > 0. With 1/|x|² = ∫₀^∞ exp(−s|x|²) ds,
///
///     ⟨u_k²⟩ = √(μ_1 μ_2 μ_3)/3 · R_D(μ_i, μ_j, μ_k),  μ = 1/λ,
///
/// where R_D is Carlson's elliptic integral. It is computed with arithmetic and square roots only and is thus identical
/// on all processors. The relative error is 1e-14. Sources: tyler1987, montgomerysmith2011, carlson1995.
Vec3 angular_gaussian_moments(const Vec3& variances);

/// Returns variances with these moments, whose sum must be 1. The moments determine the variances up to a common
/// factor.
///
/// 1. λ_k → λ_k (⟨u_k²⟩/⟨u_k²⟩_λ)^(3/2) is repeated until the moments agree to 1e-13. ⟨u_k²⟩_λ grows as a power of λ_k
///    between 1/2 (long bodies) and 1 (flat ones), so each step divides the errors of the logarithms by at least two.
/// 2. If a moment is below 1e-9, the axes lie in a plane or on a line, where ⟨u_k²⟩ = √λ_k/Σ√λ.
Vec3 angular_gaussian_variances(const Vec3& moments);

/// Draws unit vectors u, with u and −u equally probable, from the angular central Gaussian distribution with
/// ⟨u uᵀ⟩ = A. It is the distribution of fibres that were isotropic before a homogeneous deformation. In two dimensions
/// the eigenvalues of A are √λ_k/Σ√λ.
template <int Dim>
class AxisDistribution {
 public:
  using Tensor = Eigen::Matrix<double, Dim, Dim>;

  /// `tensor` is A: symmetric, of trace 1, without negative eigenvalues.
  explicit AxisDistribution(const Tensor& tensor);
  Vec<Dim> operator()(Stream& draw) const;

 private:
  Tensor map_;  ///< maps isotropic normal vectors to x
};

}  // namespace vitrel

#pragma once

#include <Eigen/Core>
#include <functional>

namespace vitrel {

/// Fills in residuals r_k = (f_k(p) − y_k)/σ_k and their derivatives J_km = ∂r_k/∂p_m.
using WeightedResiduals =
    std::function<void(const Eigen::VectorXd& p, Eigen::VectorXd& r, Eigen::MatrixXd& j)>;

struct LeastSquares {
  Eigen::VectorXd parameters;
  Eigen::MatrixXd covariance;  ///< (JᵀJ)⁻¹, for independent errors of the stated size
  double chi_square;           ///< Σ r²
  bool converged;
};

/// Minimises Σ r² over p, from a start in the valley of the minimum, by the Levenberg–Marquardt method of GSL. It has
/// converged if the last step was below 1e-10 of p, or if the gradient vanished. It needs at least as many points as
/// parameters.
LeastSquares least_squares(std::size_t points, const Eigen::VectorXd& start,
                           const WeightedResiduals& residuals);

}  // namespace vitrel

#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "analysis/structure/structure_factor.h"
#include "core/state/configuration.h"

/// What is extrapolated from the structure of simulated fluids.
namespace vitrel {

/// c₀ of the Σ c_n x^n, n = 0 … degree, that fits best.
inline double value_at_zero(const std::vector<double>& x, const std::vector<double>& y,
                            const std::vector<double>& weight, int degree) {
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(degree + 1, degree + 1);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(degree + 1);
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (weight[k] == 0) continue;
    Eigen::VectorXd powers(degree + 1);
    for (int n = 0; n <= degree; ++n) powers[n] = std::pow(x[k], n);
    normal += weight[k] * powers * powers.transpose();
    right += weight[k] * y[k] * powers;
  }
  return normal.ldlt().solve(right)[0];
}

/// S₀ of the S₀ + S₂ q² + S₄ q⁴ that fits the mean structure factor of the frames [begin, end) best, each shell weighted
/// by its wave vectors: their S have nearly equal errors, as S varies little at the q of these shells.
template <int Dim>
double structure_factor_at_zero(const ScatteringShells<Dim>& shells,
                                const std::vector<Configuration<Dim>>& frames, std::size_t begin,
                                std::size_t end) {
  std::vector<double> mean, squares;
  StructureFactor s;
  for (std::size_t k = begin; k < end; ++k) {
    s = shells.structure_factor(frames[k]);
    mean.resize(s.total.size(), 0);
    for (std::size_t shell = 0; shell < mean.size(); ++shell)
      mean[shell] += s.total[shell] / static_cast<double>(end - begin);
  }
  for (const double q : s.q) squares.push_back(q * q);
  return value_at_zero(squares, mean, s.modes, 2);
}

}  // namespace vitrel

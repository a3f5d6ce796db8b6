#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/geometry/vector.h"

namespace vitrel::bench {

/// A function's value with its first and second derivatives.
struct SecondOrder {
  double value;
  Vec3 gradient;
  Eigen::Matrix3d hessian;
};

/// Damped Newton minimisation in three variables y; projection keeps 0 ≤ y₀ ≤ 1.
///
///   1. If y₀ is at a bound towards which the function falls, it is held there for the step.
///   2. The eigenvalues of the Hessian are replaced by their absolute values; step = −|H|⁻¹∇f.
///   3. The step is cut to a quarter until f falls by 10⁻⁴ of what the slope predicts. f may be infinite, as outside
///      a barrier.
///
/// It ends when a step is shorter than `shortest`, when no cut makes f fall, or after `max_steps`. The objective has
/// SecondOrder operator()(y) and double value(y). Returns the number of steps.
template <class Objective>
int minimise(const Objective& f, Vec3& y, double shortest, int max_steps) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  for (int step = 1; step <= max_steps; ++step) {
    SecondOrder here = f(y);
    if (!std::isfinite(here.value) || !here.hessian.allFinite()) return step;
    if ((y[0] <= 0 && here.gradient[0] > 0) || (y[0] >= 1 && here.gradient[0] < 0)) {
      here.gradient[0] = 0;
      here.hessian.row(0).setZero();
      here.hessian.col(0).setZero();
      here.hessian(0, 0) = 1;
    }
    eigen.compute(here.hessian);
    const Vec3 values = eigen.eigenvalues().cwiseAbs();
    const double least = std::max(1e-14 * values.maxCoeff(), 1e-300);
    const Vec3 along = eigen.eigenvectors().transpose() * here.gradient;
    const Vec3 full = -eigen.eigenvectors() * along.cwiseQuotient(values.cwiseMax(least));
    const double slope = here.gradient.dot(full);

    Vec3 next = y;
    double fraction = 1;
    for (; fraction > 1e-12; fraction *= 0.25) {
      next = y + fraction * full;
      next[0] = std::clamp(next[0], 0.0, 1.0);
      if (f.value(next) < here.value + 1e-4 * fraction * slope) break;
    }
    if (fraction <= 1e-12) return step;
    const double length = (next - y).norm();
    y = next;
    if (length <= shortest) return step;
  }
  return max_steps;
}

/// Minimises objective(μ) for μ = largest, largest/10, … down to `smallest`, each from the previous minimum and until
/// steps are shorter than `accuracy` μ. Returns the total number of steps.
template <class MakeObjective>
int minimise_for_decreasing(const MakeObjective& objective, double largest, double smallest,
                            double accuracy, Vec3& y) {
  constexpr int max_steps = 200;  // for one value of the parameter
  int steps = 0;
  for (double mu = largest;; mu = std::max(0.1 * mu, smallest)) {
    steps += minimise(objective(mu), y, accuracy * mu, max_steps);
    if (!(mu > smallest)) return steps;
  }
}

}  // namespace vitrel::bench

#pragma once

#include <algorithm>
#include <cmath>

#include "bench/methods/ellipses/scaled_problem.h"

namespace vitrel::bench {

/// The objective of methods that use neither constraints nor derivatives, in the variables of ScaledProblem:
///     f(y) = τ + w (max(0, E₁)² + max(0, E₂)²) + 100 · (distance of τ from [0, 1]).
/// At its minimum Eᵢ = λᵢ/2w with the multipliers λᵢ of the constraints, and the time is early by (λ₁² + λ₂²)/2w in
/// units of the bracket. The exact penalty, without the squares, would not be early, but simplices collapse on its
/// kink, a thousand times farther from the contact. Outside the bracket the ellipses are evaluated at its nearer end.
/// The value is 1e300 instead of NaN or infinity.
class PenalisedTime {
 public:
  PenalisedTime(const ScaledProblem& problem, double weight) : problem_(problem), weight_(weight) {}

  double operator()(const Vec3& y) const {
    constexpr double bound_weight = 100;
    Vec3 inside = y;
    inside[0] = std::clamp(y[0], 0.0, 1.0);
    const double e1 = std::max(0.0, problem_.value1(inside));
    const double e2 = std::max(0.0, problem_.value2(inside));
    const double f =
        inside[0] + weight_ * (e1 * e1 + e2 * e2) + bound_weight * std::abs(y[0] - inside[0]);
    return std::isfinite(f) ? f : 1e300;
  }

 private:
  const ScaledProblem& problem_;
  double weight_;
};

}  // namespace vitrel::bench

#include "bench/methods/ellipses/quadratic_penalty.h"

#include <algorithm>
#include <cmath>

#include "bench/methods/ellipses/newton.h"
#include "bench/methods/ellipses/scaled_problem.h"

namespace vitrel::bench {
namespace {

struct Penalised {
  const ScaledProblem& problem;
  double mu;

  double value(const Vec3& y) const {
    const double e1 = problem.value1(y);
    const double e2 = problem.value2(y);
    return y[0] + (e1 * e1 + e2 * e2) / (2 * mu);
  }

  SecondOrder operator()(const Vec3& y) const {
    SecondOrder f{y[0], Vec3::UnitX(), Eigen::Matrix3d::Zero()};
    for (const EllipseFunction& e : {problem.full1(y), problem.full2(y)}) {
      f.value += e.value * e.value / (2 * mu);
      f.gradient += e.value / mu * e.gradient;
      f.hessian += (e.gradient * e.gradient.transpose() + e.value * e.hessian) / mu;
    }
    return f;
  }
};

}  // namespace

Prediction2 quadratic_penalty(const CollisionCase& asked, double tolerance) {
  const Opening opening = open_search(asked);
  if (opening.answer) return *opening.answer;
  const ScaledProblem problem(asked, opening.bracket);

  Vec3 y = Vec3::Zero();
  const auto penalised = [&](double mu) { return Penalised{problem, mu}; };
  const int steps = minimise_for_decreasing(penalised, 1, tolerance, 1e-3, y);
  if (!y.allFinite()) return without_contact(Outcome::not_converged, steps);
  const double off = std::max(std::abs(problem.value1(y)), std::abs(problem.value2(y)));
  if (!(off <= std::sqrt(tolerance))) return without_contact(Outcome::none, steps);
  return problem.contact(y, steps);
}

}  // namespace vitrel::bench

#include "bench/methods/ellipses/augmented_lagrangian.h"

#include <cmath>
#include <nlopt.hpp>
#include <vector>

#include "bench/methods/ellipses/scaled_problem.h"
#include "bench/methods/ellipses/time_objective.h"

namespace vitrel::bench {
namespace {

constexpr double violated = 1e-6;
constexpr double farthest = 1e6;  // distance of the point from the start, in scaled units
constexpr int max_evaluations = 1000;

template <bool first>
double constraint(unsigned, const double* y, double* gradient, void* data) {
  const ScaledProblem& problem = **static_cast<const ScaledProblem**>(data);
  const Vec3 at(y[0], y[1], y[2]);
  if (!gradient) return first ? problem.value1(at) : problem.value2(at);
  Vec3 slope;
  const double value = first ? problem.value1(at, slope) : problem.value2(at, slope);
  Eigen::Map<Vec3>{gradient} = slope;
  return value;
}

// The memory of the optimiser, which is kept from call to call.
class Solver {
 public:
  Solver() : optimiser_(nlopt::LD_AUGLAG, 3) {
    optimiser_.set_min_objective(time_objective, nullptr);
    optimiser_.add_inequality_constraint(constraint<true>, &problem_, 1e-10);
    optimiser_.add_inequality_constraint(constraint<false>, &problem_, 1e-10);
    optimiser_.set_lower_bounds({0, -farthest, -farthest});
    optimiser_.set_upper_bounds({1, farthest, farthest});
    optimiser_.set_maxeval(max_evaluations);
  }
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  struct Result {
    Vec3 y;
    int evaluations;
  };
  Result run(const ScaledProblem& problem, double tolerance) {
    problem_ = &problem;
    if (tolerance != tolerance_) {
      nlopt::opt inner(nlopt::LD_TNEWTON_PRECOND, 3);
      inner.set_xtol_rel(tolerance);
      inner.set_maxeval(max_evaluations);
      optimiser_.set_local_optimizer(inner);
      optimiser_.set_xtol_rel(tolerance);
      tolerance_ = tolerance;
    }
    y_.assign(3, 0.0);
    try {
      double least;
      optimiser_.optimize(y_, least);
    } catch (const std::exception&) {
      // After a round-off error or a failure, y_ holds the last point.
    }
    return {{y_[0], y_[1], y_[2]}, optimiser_.get_numevals()};
  }

 private:
  nlopt::opt optimiser_;
  const ScaledProblem* problem_ = nullptr;
  double tolerance_ = 0;
  std::vector<double> y_;
};

}  // namespace

Prediction2 augmented_lagrangian(const CollisionCase& asked, double tolerance) {
  const Opening opening = open_search(asked);
  if (opening.answer) return *opening.answer;
  const ScaledProblem problem(asked, opening.bracket);
  thread_local Solver solver;
  const auto [y, evaluations] = solver.run(problem, tolerance);
  if (!y.allFinite()) return {Outcome::not_converged};
  // If there is no contact within reach, the multipliers grow until the optimiser gives up.
  if (!(problem.violation(y) <= violated)) return without_contact(Outcome::none, evaluations);
  return problem.contact(y, evaluations);
}

}  // namespace vitrel::bench

#include "bench/methods/ellipses/log_barrier.h"

#include <cmath>
#include <limits>
#include <optional>

#include "bench/methods/ellipses/newton.h"
#include "bench/methods/ellipses/scaled_problem.h"

namespace vitrel::bench {
namespace {

constexpr int sampled_times = 32;

struct Barrier {
  const ScaledProblem& problem;
  double mu;

  double value(const Vec3& y) const {
    const double e1 = problem.value1(y);
    const double e2 = problem.value2(y);
    if (!(e1 < 0 && e2 < 0)) return std::numeric_limits<double>::infinity();
    return y[0] - mu * (std::log(-e1) + std::log(-e2));
  }

  SecondOrder operator()(const Vec3& y) const {
    SecondOrder f{y[0], Vec3::UnitX(), Eigen::Matrix3d::Zero()};
    for (const EllipseFunction& e : {problem.full1(y), problem.full2(y)}) {
      const double inverse = 1 / e.value;
      f.value -= mu * std::log(-e.value);
      f.gradient -= mu * inverse * e.gradient;
      f.hessian += mu * inverse * (inverse * e.gradient * e.gradient.transpose() - e.hessian);
    }
    return f;
  }
};

std::optional<Vec3> interior_point(const CollisionCase& asked, const Bracket& bracket,
                                   const ScaledProblem& problem) {
  for (int sample = 1; sample <= sampled_times; ++sample) {
    const double time = bracket.earliest + bracket.duration() * sample / sampled_times;
    const PerramWertheim<2> touch = perram_wertheim_at(asked, time);
    if (!(touch.value < 1)) continue;
    const Vec2 centre = asked.one.pose.position + asked.one.motion.velocity * time;
    const Vec3 y = problem.scaled(time, centre + touch.point);
    if (problem.violation(y) < 0) return y;
  }
  return {};
}

}  // namespace

Prediction2 log_barrier(const CollisionCase& asked, double tolerance) {
  const Opening opening = open_search(asked);
  if (opening.answer) return *opening.answer;
  const ScaledProblem problem(asked, opening.bracket);
  const auto inside = interior_point(asked, opening.bracket, problem);
  if (!inside) return {};

  Vec3 y = *inside;
  const auto barrier = [&](double mu) { return Barrier{problem, mu}; };
  const int steps = minimise_for_decreasing(barrier, 0.1, tolerance, 1e-2, y);
  if (!y.allFinite()) return without_contact(Outcome::not_converged, steps);
  return problem.contact(y, steps);
}

}  // namespace vitrel::bench

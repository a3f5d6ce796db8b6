#include "bench/methods/ellipses/slsqp.h"

#include <nlopt.hpp>
#include <vector>

#include "bench/methods/ellipses/ellipse_constraint.h"
#include "bench/methods/ellipses/time_objective.h"
#include "bench/methods/opening.h"

#include "core/geometry/free_flight.h"

namespace vitrel::bench {
namespace {

constexpr double constraint_tolerance = 1e-10;
constexpr double violated = 1e-8;    // violation of a constraint by the result
constexpr double at_the_end = 1e-8;  // distance from an end of the bracket, in units of time
constexpr int max_evaluations = 2000;

double constraint(unsigned, const double* x, double* gradient, void* data) {
  const EllipseConstraint& e = **static_cast<const EllipseConstraint**>(data);
  if (!gradient) return e.value(x[0], {x[1], x[2]});
  Vec3 slope;
  const double value = e.value(x[0], {x[1], x[2]}, slope);
  Eigen::Map<Vec3>{gradient} = slope;
  return value;
}

// The memory of the optimiser, which is kept from call to call.
class Solver {
 public:
  Solver() : optimiser_(nlopt::LD_SLSQP, 3) {
    optimiser_.set_min_objective(time_objective, nullptr);
    optimiser_.add_inequality_constraint(constraint, &one_, constraint_tolerance);
    optimiser_.add_inequality_constraint(constraint, &two_, constraint_tolerance);
    optimiser_.set_xtol_abs(1e-16);
    optimiser_.set_maxeval(max_evaluations);
  }
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  struct Result {
    Vec3 x;
    bool converged;
    int evaluations;
  };
  Result run(const EllipseConstraint& one, const EllipseConstraint& two, const Vec3& lower,
             const Vec3& upper, const Vec3& start, double tolerance) {
    one_ = &one;
    two_ = &two;
    Eigen::Map<Vec3>{lower_.data()} = lower;
    Eigen::Map<Vec3>{upper_.data()} = upper;
    Eigen::Map<Vec3>{x_.data()} = start;
    optimiser_.set_lower_bounds(lower_);
    optimiser_.set_upper_bounds(upper_);
    optimiser_.set_xtol_rel(tolerance);
    bool converged = false;
    try {
      double least;
      converged = optimiser_.optimize(x_, least) != nlopt::MAXEVAL_REACHED;
    } catch (const std::exception&) {
      // After a round-off error or a failure, x_ holds the last point.
    }
    return {Eigen::Map<Vec3>{x_.data()}, converged, optimiser_.get_numevals()};
  }

 private:
  nlopt::opt optimiser_;
  const EllipseConstraint* one_ = nullptr;
  const EllipseConstraint* two_ = nullptr;
  std::vector<double> lower_ = std::vector<double>(3);
  std::vector<double> upper_ = std::vector<double>(3);
  std::vector<double> x_ = std::vector<double>(3);
};

// The box in which both ellipses stay during the bracket.
struct Box {
  Vec2 lower, upper;
};
Box reach(const CollisionCase& asked, const Bracket& bracket) {
  Box box{Vec2::Constant(HUGE_VAL), Vec2::Constant(-HUGE_VAL)};
  for (const auto* flight : {&asked.one, &asked.two})
    for (const double time : {bracket.earliest, bracket.latest}) {
      const Vec2 centre = flight->pose.position + flight->motion.velocity * time;
      const Vec2 radius = Vec2::Constant(body_at(*flight, time).a);
      box.lower = box.lower.cwiseMin(centre - radius);
      box.upper = box.upper.cwiseMax(centre + radius);
    }
  return box;
}

// Where the constraints of the result are checked.
enum class Check { ends_of_bracket, everywhere };

Prediction2 optimised(const CollisionCase& asked, double tolerance, Check check) {
  if (!is_sound(asked)) return {Outcome::not_converged};
  const auto bracket = bracket_contact(asked);
  if (!bracket) return {};

  const EllipseConstraint one(asked.one);
  const EllipseConstraint two(asked.two);
  const Box box = reach(asked, *bracket);
  const Vec2 middle =
      0.5 * (advanced(asked.one.pose, asked.one.motion, bracket->earliest).position +
             advanced(asked.two.pose, asked.two.motion, bracket->earliest).position);
  thread_local Solver solver;
  const auto [x, converged, evaluations] =
      solver.run(one, two, {bracket->earliest, box.lower.x(), box.lower.y()},
                 {bracket->latest, box.upper.x(), box.upper.y()},
                 {bracket->earliest, middle.x(), middle.y()}, tolerance);
  if (!x.allFinite()) return {Outcome::not_converged};

  const double time = x[0];
  const Vec2 point = x.tail<2>();
  Vec3 gradient;
  const bool holds =
      one.value(time, point, gradient) <= violated && two.value(time, point) <= violated;
  if (!converged && !holds) return without_contact(Outcome::not_converged, evaluations);
  const bool is_checked = check == Check::everywhere || time < bracket->earliest + at_the_end ||
                          time > bracket->latest - at_the_end;
  if (is_checked && !holds) return without_contact(Outcome::none, evaluations);
  if (time < at_the_end && overlaps_at_start(asked))
    return without_contact(Outcome::overlap, evaluations);
  return contact_along(gradient.tail<2>(), time, point, evaluations);
}

}  // namespace

Prediction2 slsqp(const CollisionCase& asked, double tolerance) {
  return optimised(asked, tolerance, Check::ends_of_bracket);
}

Prediction2 slsqp_checked(const CollisionCase& asked, double tolerance) {
  return optimised(asked, tolerance, Check::everywhere);
}

}  // namespace vitrel::bench

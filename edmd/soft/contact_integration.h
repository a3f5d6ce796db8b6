#pragma once

#include <algorithm>
#include <array>
#include <boost/math/tools/roots.hpp>
#include <boost/numeric/odeint/algebra/array_algebra.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/elementary.h"
#include "core/error.h"
#include "edmd/soft/restitution.h"

/// @file
/// The integration described in restitution.h. This header is included by the sources that instantiate a force.
namespace vitrel {

template <ContactForce Force>
class ContactIntegration {
 public:
  explicit ContactIntegration(const ScaledImpact& impact)
      : impact_(impact),
        orbital_(std::max(impact.angular_momentum, smallest_offset * impact.distance)),
        kappa_(impact.damping >= 1 ? 1 / impact.damping : 0) {}

  Restitution operator()() const {
    ControlledStepper stepper({min_error, step_error}, {}, blank);
    const auto motion = [this](const State& x, State& slope, double) { set_slope(x, slope); };
    State x{0, 1, 1, 0, 0};
    double at = 0, step = 0.1 / (1 + std::sqrt(centrifugal(1)) + impact_.damping);
    for (int trial = 0; trial < max_steps; ++trial) {
      const State before = x;
      const double begin = at;
      if (stepper.try_step(motion, x, at, step) == boost::numeric::odeint::fail) continue;
      if (excess(x) <= 0) return coefficients(end_of_contact(before, x, at - begin));
    }
    throw InvariantError("a contact does not end");
  }

 private:
  // A state holds s, v, ρ, φ and t of restitution.h as functions of σ.
  using State = std::array<double, 5>;
  using Stepper =
      boost::numeric::odeint::runge_kutta_fehlberg78<State, double, State, double,
                                                     boost::numeric::odeint::array_algebra>;
  // The step adjuster of the library uses std::pow, whose bits depend on the processor.
  struct StepAdjuster : boost::numeric::odeint::default_step_adjuster<double, double> {
    static double factor(double error, int order) {
      return 0.9 * exponential(-logarithm(error) / order);
    }
    double decrease_step(double step, double error, int error_order) const {
      return step * std::max(factor(error, error_order - 1), 0.2);
    }
    double increase_step(double step, double error, int order) const {
      return error < 0.5 ? step * factor(std::max(error, power(0.2, order)), order) : step;
    }
  };
  using ErrorChecker =
      boost::numeric::odeint::default_error_checker<double, boost::numeric::odeint::array_algebra,
                                                    boost::numeric::odeint::default_operations>;
  using ControlledStepper =
      boost::numeric::odeint::controlled_runge_kutta<Stepper, ErrorChecker, StepAdjuster>;

  // Steppers are copied with their scratch memory, which is initialised because this object is static.
  static inline const Stepper blank{};
  static constexpr double step_error = 1e-14;
  // Errors are relative to the integrated quantities; this only prevents 0/0.
  static constexpr double min_error = 1e-100;
  // About 100 steps are usual, and 1000 if particles collide centre to centre.
  static constexpr int max_steps = 100000;
  // Impacts with smaller impact parameters are head-on to rounding.
  static constexpr double smallest_offset = 1e-15;

  double centrifugal(double rho) const {
    const double tangent = orbital_ / impact_.distance;
    return tangent * tangent / (impact_.distance * rho * rho * rho);
  }
  double approach_rate(const State& x) const { return x[1] - kappa_ * Force::elastic(x[0]); }
  // Returns E + c_dis u, to which the force is proportional.
  double excess(const State& x) const {
    if (kappa_ > 0) return impact_.damping * x[1];
    return std::copysign(Force::elastic(std::abs(x[0])), x[0]) + impact_.damping * x[1];
  }

  void set_slope(const State& x, State& slope) const {
    const auto [s, v, rho, angle, time] = x;
    const double u = approach_rate(x);
    const double slow = 2 * s * rho;
    const double push = Force::profile(s) * (kappa_ > 0 ? impact_.damping * v
                                                        : Force::elastic(s) + impact_.damping * v);
    slope[0] = rho * u;
    slope[1] = kappa_ * Force::elastic_slope(s) * rho * u - slow * (centrifugal(rho) + push);
    slope[2] = -slow * u / impact_.distance;
    slope[3] = 2 * s * orbital_ / (impact_.distance * impact_.distance * rho);
    slope[4] = slow;
  }

  // Finds the end of the contact in the step from `before` to `after`, which is beyond it.
  State end_of_contact(const State& before, const State& after, double step) const {
    Stepper stepper;
    State x;
    const auto motion = [this](const State& y, State& slope, double) { set_slope(y, slope); };
    const auto excess_after = [&](double length) {
      stepper.do_step(motion, before, 0, x, length);
      return excess(x);
    };
    std::uintmax_t trials = 100;
    const auto bracket =
        boost::math::tools::toms748_solve(excess_after, 0.0, step, excess(before), excess(after),
                                          boost::math::tools::eps_tolerance<double>(), trials);
    excess_after(bracket.second);
    return x;
  }

  Restitution coefficients(const State& end) const {
    const auto [s, v, rho, swept, time] = end;
    const double angle = impact_.angular_momentum > 0   ? swept
                         : swept < std::numbers::pi / 2 ? 0
                                                        : std::numbers::pi;
    if (impact_.damping == 0) return {1, angle, time, -1};
    // Chooses the more accurate of two equal expressions.
    const double compression = s * s / impact_.distance;
    return {compression < 0.5 ? 1 - compression : rho, angle, time, approach_rate(end)};
  }

  ScaledImpact impact_;
  double orbital_;  // c_φ
  double kappa_;
};

template <ContactForce Force>
Restitution integrate_contact(const ScaledImpact& impact) {
  return ContactIntegration<Force>(impact)();
}

}  // namespace vitrel

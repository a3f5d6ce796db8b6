#include "bench/methods/ellipses/simulated_annealing.h"

#include <gsl/gsl_rng.h>
#include <gsl/gsl_siman.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "analysis/statistics/gsl_errors.h"
#include "bench/methods/ellipses/penalised.h"
#include "core/io/checked.h"

namespace vitrel::bench {
namespace {

constexpr double penalty_weight = 300;
constexpr double violated = 1e-2;
constexpr unsigned long seed = 20;
constexpr gsl_siman_params_t schedule{.n_tries = 1,
                                      .iters_fixed_T = 20,
                                      .step_size = 1,
                                      .k = 1,
                                      .t_initial = 0.3,
                                      .mu_t = 1.03,
                                      .t_min = 0};

// The state that GSL copies as plain memory.
struct State {
  double y[3];
  double smallest_step_log;
  const PenalisedTime* f;
};

double energy(void* state) {
  const State& s = *static_cast<const State*>(state);
  return (*s.f)({s.y[0], s.y[1], s.y[2]});
}

void step(const gsl_rng* random, void* state, double width) {
  State& s = *static_cast<State*>(state);
  const double length = width * std::exp(s.smallest_step_log * gsl_rng_uniform(random));
  for (double& y : s.y) y += length * (2 * gsl_rng_uniform(random) - 1);
}

struct FreeRandom {
  void operator()(gsl_rng* random) const { gsl_rng_free(random); }
};

}  // namespace

Prediction2 simulated_annealing(const CollisionCase& asked, double tolerance) {
  const Opening opening = open_search(asked);
  if (opening.answer) return *opening.answer;
  const ScaledProblem problem(asked, opening.bracket);
  const PenalisedTime f(problem, penalty_weight);

  thread_local const std::unique_ptr<gsl_rng, FreeRandom> random(
      obtained(gsl_rng_alloc(gsl_rng_taus2)));
  gsl_rng_set(random.get(), seed);
  State state{{0, 0, 0}, std::log(tolerance), &f};
  gsl_siman_params_t cooling = schedule;
  cooling.t_min = tolerance;
  gsl_siman_solve(random.get(), &state, energy, step, nullptr, nullptr, nullptr, nullptr, nullptr,
                  sizeof(State), cooling);

  const int trials = static_cast<int>(
      cooling.iters_fixed_T * std::log(cooling.t_initial / tolerance) / std::log(cooling.mu_t));
  Vec3 y(state.y[0], state.y[1], state.y[2]);
  y[0] = std::clamp(y[0], 0.0, 1.0);
  if (!(problem.violation(y) <= violated)) return without_contact(Outcome::none, trials);
  return problem.contact(y, trials);
}

}  // namespace vitrel::bench

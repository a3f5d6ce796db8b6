#include "bench/methods/ellipses/nelder_mead.h"

#include <gsl/gsl_multimin.h>

#include <algorithm>
#include <cmath>

#include "analysis/statistics/gsl_errors.h"
#include "bench/methods/ellipses/penalised.h"
#include "core/io/checked.h"

namespace vitrel::bench {
namespace {

constexpr double first_edge = 0.2;
constexpr int max_iterations = 1000;

double objective(const gsl_vector* y, void* data) {
  const auto& f = *static_cast<const PenalisedTime*>(data);
  return f({gsl_vector_get(y, 0), gsl_vector_get(y, 1), gsl_vector_get(y, 2)});
}

// The memory of the minimiser, which is kept from call to call.
class Simplex {
 public:
  Simplex()
      : minimiser_(obtained(gsl_multimin_fminimizer_alloc(gsl_multimin_fminimizer_nmsimplex2, 3))),
        start_(obtained(gsl_vector_alloc(3))),
        edges_(obtained(gsl_vector_alloc(3))) {}
  ~Simplex() {
    gsl_vector_free(edges_);
    gsl_vector_free(start_);
    gsl_multimin_fminimizer_free(minimiser_);
  }
  Simplex(const Simplex&) = delete;
  Simplex& operator=(const Simplex&) = delete;

  // Runs one search from y with a new simplex. Returns false if the simplex did not shrink to `tolerance`.
  bool run(PenalisedTime& f, Vec3& y, double edge, double tolerance, int& iterations) {
    gsl_multimin_function function{objective, 3, &f};
    for (int k = 0; k < 3; ++k) gsl_vector_set(start_, k, y[k]);
    gsl_vector_set_all(edges_, edge);
    check_gsl(gsl_multimin_fminimizer_set(minimiser_, &function, start_, edges_));
    bool small = false;
    for (int step = 0; step < max_iterations && !small; ++step, ++iterations) {
      if (gsl_multimin_fminimizer_iterate(minimiser_) != GSL_SUCCESS) break;
      small = gsl_multimin_fminimizer_size(minimiser_) < tolerance;
    }
    for (int k = 0; k < 3; ++k) y[k] = gsl_vector_get(minimiser_->x, k);
    return small;
  }

 private:
  gsl_multimin_fminimizer* minimiser_;
  gsl_vector* start_;
  gsl_vector* edges_;
};

}  // namespace

Prediction2 nelder_mead(const CollisionCase& asked, double tolerance) {
  const Opening opening = open_search(asked);
  if (opening.answer) return *opening.answer;
  const ScaledProblem problem(asked, opening.bracket);
  thread_local Simplex simplex;

  Vec3 y = Vec3::Zero();
  double edge = first_edge;
  int iterations = 0;
  bool settled = false;
  for (double weight = 10; weight < 20 / tolerance; weight *= 10) {
    PenalisedTime f(problem, weight);
    const Vec3 before = y;
    settled = simplex.run(f, y, edge, tolerance, iterations);
    edge = std::clamp((y - before).norm(), 10 * tolerance, first_edge);
  }
  if (!y.allFinite() || !settled) return without_contact(Outcome::not_converged, iterations);
  y[0] = std::clamp(y[0], 0.0, 1.0);
  if (!(problem.violation(y) <= std::sqrt(tolerance)))
    return without_contact(Outcome::none, iterations);
  return problem.contact(y, iterations);
}

}  // namespace vitrel::bench

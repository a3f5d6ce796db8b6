#include <limits>

#include "bench/lab/methods/augmented_lagrangian.h"
#include "bench/lab/methods/circles.h"
#include "bench/lab/methods/log_barrier.h"
#include "bench/lab/methods/method.h"
#include "bench/lab/methods/nelder_mead.h"
#include "bench/lab/methods/perram_wertheim_root.h"
#include "bench/lab/methods/psi_root.h"
#include "bench/lab/methods/quadratic_penalty.h"
#include "bench/lab/methods/separating_axis.h"
#include "bench/lab/methods/simulated_annealing.h"
#include "bench/lab/methods/slsqp.h"
#include "bench/lab/methods/unit_circle.h"

namespace vitrel::lab {
namespace {

using Predict = Prediction2(const CollisionCase&, double tolerance);

struct Entry {
  const char* name;
  Predict* predict;
  double usual;
  std::vector<double> series;  ///< coarse to fine
};

std::vector<Entry> entries() {
  constexpr double rounding = 32 * std::numeric_limits<double>::epsilon();
  const std::vector<double> scan_steps{1.0 / 4,   1.0 / 10,  1.0 / 30,
                                       1.0 / 100, 1.0 / 300, 1.0 / 1000};
  return {
      {"separating_axis", separating_axis, rounding, {1e-4, 1e-6, 1e-8, 1e-10, 1e-12, rounding}},
      {"circles", circles, 0, {0}},
      {"slsqp", slsqp, 1e-10, {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}},
      {"slsqp_checked", slsqp_checked, 1e-10, {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}},
      {"nelder_mead", nelder_mead, 1e-10, {1e-2, 1e-4, 1e-6, 1e-8, 1e-10}},
      {"simulated_annealing", simulated_annealing, 1e-4, {1e-1, 1e-2, 1e-4, 1e-6, 1e-8}},
      {"quadratic_penalty", quadratic_penalty, 1e-10, {1e-2, 1e-4, 1e-6, 1e-8, 1e-10}},
      {"log_barrier", log_barrier, 1e-10, {1e-2, 1e-4, 1e-6, 1e-8, 1e-10}},
      {"augmented_lagrangian", augmented_lagrangian, 1e-10, {1e-2, 1e-4, 1e-6, 1e-8, 1e-10}},
      {"psi_root", psi_root, 1.0 / 100, scan_steps},
      {"perram_wertheim_root",
       perram_wertheim_root,
       1.0 / 20,
       {1.0 / 4, 1.0 / 10, 1.0 / 20, 1.0 / 50, 1.0 / 100, 1.0 / 300}},
      {"unit_circle", unit_circle, 1.0 / 100, scan_steps},
  };
}

Method at_tolerance(const Entry& entry, double tolerance) {
  return {entry.name, tolerance, [predict = entry.predict, tolerance](const CollisionCase& asked) {
            return predict(asked, tolerance);
          }};
}

}  // namespace

std::vector<Method> collision_time_methods() {
  std::vector<Method> methods;
  for (const Entry& entry : entries()) methods.push_back(at_tolerance(entry, entry.usual));
  return methods;
}

std::vector<Method> collision_time_methods_by_tolerance() {
  std::vector<Method> methods;
  for (const Entry& entry : entries())
    for (const double tolerance : entry.series) methods.push_back(at_tolerance(entry, tolerance));
  return methods;
}

}  // namespace vitrel::lab

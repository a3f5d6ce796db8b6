#include "bench/methods/ellipses/augmented_lagrangian.h"
#include "bench/methods/ellipses/circles.h"
#include "bench/methods/ellipses/log_barrier.h"
#include "bench/methods/ellipses/nelder_mead.h"
#include "bench/methods/ellipses/perram_wertheim_root.h"
#include "bench/methods/ellipses/psi_root.h"
#include "bench/methods/ellipses/quadratic_penalty.h"
#include "bench/methods/ellipses/separating_axis.h"
#include "bench/methods/ellipses/simulated_annealing.h"
#include "bench/methods/ellipses/slsqp.h"
#include "bench/methods/ellipses/unit_circle.h"
#include "bench/methods/method_list.h"

namespace vitrel::bench {
namespace {

std::vector<MethodEntry<2>> entries() {
  return {
      {"separating_axis", separating_axis, contact_at_rounding, contact_gaps},
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

}  // namespace

std::vector<Method> collision_time_methods() {
  return at_usual_tolerance(entries());
}

std::vector<Method> collision_time_methods_by_tolerance() {
  return by_tolerance(entries());
}

}  // namespace vitrel::bench

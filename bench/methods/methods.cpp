#include <limits>

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
#include "bench/methods/ellipsoids/roots.h"
#include "bench/methods/method.h"

namespace vitrel::bench {
namespace {

/// A method, before its tolerance is chosen.
template <int Dim>
struct Entry {
  const char* name;
  Prediction<Dim> (*predict)(const CollisionCaseOf<Dim>&, double tolerance);
  double usual;
  std::vector<double> series;  ///< from coarse to fine

  MethodOf<Dim> at(double tolerance) const {
    return {name, tolerance, [predict = predict, tolerance](const CollisionCaseOf<Dim>& asked) {
              return predict(asked, tolerance);
            }};
  }
};

constexpr double contact_at_rounding = 32 * std::numeric_limits<double>::epsilon();

template <int Dim>
std::vector<Entry<Dim>> entries() {
  const std::vector<double> coarse{1e-2, 1e-4, 1e-6, 1e-8, 1e-10};
  const std::vector<double> fine{1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12};
  const std::vector<double> gaps{1e-4, 1e-6, 1e-8, 1e-10, 1e-12, contact_at_rounding};
  const std::vector<double> scan{1. / 4, 1. / 10, 1. / 30, 1. / 100, 1. / 300, 1. / 1000};
  const Entry<Dim> default_method{"separating_axis", separating_axis, contact_at_rounding, gaps};
  if constexpr (Dim == 3)
    return {default_method,
            {"eta_root", eta_root, 1. / 100, scan},
            {"perram_wertheim_root", perram_wertheim_root, 1. / 100, scan}};
  else
    return {default_method,
            {"circles", circles, 0, {0}},
            {"slsqp", slsqp, 1e-10, fine},
            {"slsqp_checked", slsqp_checked, 1e-10, fine},
            {"nelder_mead", nelder_mead, 1e-10, coarse},
            {"simulated_annealing", simulated_annealing, 1e-4, {1e-1, 1e-2, 1e-4, 1e-6, 1e-8}},
            {"quadratic_penalty", quadratic_penalty, 1e-10, coarse},
            {"log_barrier", log_barrier, 1e-10, coarse},
            {"augmented_lagrangian", augmented_lagrangian, 1e-10, coarse},
            {"psi_root", psi_root, 1. / 100, scan},
            {"perram_wertheim_root",
             perram_wertheim_root,
             1. / 20,
             {1. / 4, 1. / 10, 1. / 20, 1. / 50, 1. / 100, 1. / 300}},
            {"unit_circle", unit_circle, 1. / 100, scan}};
}

}  // namespace

template <int Dim>
std::vector<MethodOf<Dim>> collision_time_methods() {
  std::vector<MethodOf<Dim>> methods;
  for (const Entry<Dim>& entry : entries<Dim>()) methods.push_back(entry.at(entry.usual));
  return methods;
}

template <int Dim>
std::vector<MethodOf<Dim>> collision_time_methods_by_tolerance() {
  std::vector<MethodOf<Dim>> methods;
  for (const Entry<Dim>& entry : entries<Dim>())
    for (const double tolerance : entry.series) methods.push_back(entry.at(tolerance));
  return methods;
}

template std::vector<Method> collision_time_methods();
template std::vector<MethodOf<3>> collision_time_methods();
template std::vector<Method> collision_time_methods_by_tolerance();
template std::vector<MethodOf<3>> collision_time_methods_by_tolerance();

}  // namespace vitrel::bench

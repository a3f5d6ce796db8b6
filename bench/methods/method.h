#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/methods/collision_case.h"
#include "core/contact/first_contact.h"

namespace vitrel::bench {

/// A method to predict the first contact of two bodies, with a given accuracy.
///
/// `predict` answers contact (time, normal from 1 to 2, point), none, not_converged, or overlap if it finds that the
/// pair overlaps at the start.
template <int Dim>
struct MethodOf {
  std::string name;      ///< for example "slsqp"
  double tolerance = 0;  ///< its meaning depends on the method; see the method's header
  std::function<Prediction<Dim>(const CollisionCaseOf<Dim>&)> predict;
};
using Method = MethodOf<2>;

/// Every method at its usual tolerance. The default method comes first.
template <int Dim = 2>
std::vector<MethodOf<Dim>> collision_time_methods();

/// Every method at a series of tolerances from coarse to fine, which are the points of the chart.
template <int Dim = 2>
std::vector<MethodOf<Dim>> collision_time_methods_by_tolerance();

}  // namespace vitrel::bench

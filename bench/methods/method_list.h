#pragma once

#include <limits>

#include "bench/methods/method.h"

namespace vitrel::bench {

/// A method before its tolerance is chosen.
template <int Dim>
struct MethodEntry {
  const char* name;
  Prediction<Dim> (*predict)(const CollisionCaseOf<Dim>&, double tolerance);
  double usual;
  std::vector<double> series;  ///< coarse to fine

  MethodOf<Dim> at(double tolerance) const {
    return {name, tolerance, [predict = predict, tolerance](const CollisionCaseOf<Dim>& asked) {
              return predict(asked, tolerance);
            }};
  }
};

template <int Dim>
std::vector<MethodOf<Dim>> at_usual_tolerance(const std::vector<MethodEntry<Dim>>& entries) {
  std::vector<MethodOf<Dim>> methods;
  for (const MethodEntry<Dim>& entry : entries) methods.push_back(entry.at(entry.usual));
  return methods;
}

template <int Dim>
std::vector<MethodOf<Dim>> by_tolerance(const std::vector<MethodEntry<Dim>>& entries) {
  std::vector<MethodOf<Dim>> methods;
  for (const MethodEntry<Dim>& entry : entries)
    for (const double tolerance : entry.series) methods.push_back(entry.at(tolerance));
  return methods;
}

/// Of the default method, and of those that scan the bracket in steps: coarse to fine.
inline constexpr double contact_at_rounding = 32 * std::numeric_limits<double>::epsilon();
inline const std::vector<double> contact_gaps{1e-4, 1e-6, 1e-8, 1e-10, 1e-12, contact_at_rounding};
inline const std::vector<double> scan_steps{1.0 / 4,   1.0 / 10,  1.0 / 30,
                                            1.0 / 100, 1.0 / 300, 1.0 / 1000};

}  // namespace vitrel::bench

#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "analysis/structure/structure_options.h"
#include "core/state/configuration.h"

namespace vitrel {

/// Area (volume) between two radii.
template <int Dim>
double shell_volume(double inner, double outer) {
  if constexpr (Dim == 2) return std::numbers::pi * (outer * outer - inner * inner);
  return 4 * std::numbers::pi / 3 * (outer * outer * outer - inner * inner * inner);
}

/// Bins of the distance of two particles, the k-th from k to k + 1 steps, as far as whole bins fit below distance_max
/// and half the shortest side of the box.
template <int Dim>
class DistanceBins {
 public:
  DistanceBins(const Configuration<Dim>& c, const PairCorrelationOptions& options)
      : step_(options.distance_step), volume_(c.box.volume()) {
    const double range = std::min(options.distance_max, 0.5 * c.box.lengths().minCoeff());
    // A quotient that rounding leaves just below a whole number is one.
    count_ = static_cast<std::size_t>(range / step_ * (1 + 1e-12));
  }

  std::size_t count() const { return count_; }
  double range() const { return static_cast<double>(count_) * step_; }

  /// Distances beyond the range have one more bin: cheaper than to tell them apart.
  std::size_t bin(double squared_distance) const {
    const auto at = static_cast<std::int64_t>(scale_ * std::sqrt(squared_distance));
    return std::min(static_cast<std::size_t>(at), count_);
  }

  std::vector<double> middles() const {
    std::vector<double> middles;
    for (std::size_t k = 0; k < count_; ++k) middles.push_back(0.5 * (inner(k) + outer(k)));
    return middles;
  }

  /// `found(k)` pairs in the k-th bin over those of an ideal gas of so many pairs in the box.
  template <class Found>
  std::vector<double> over_ideal_gas(double pairs, Found&& found) const {
    const double density = pairs / volume_;
    std::vector<double> g;
    for (std::size_t k = 0; k < count_; ++k)
      g.push_back(found(k) / (density * shell_volume<Dim>(inner(k), outer(k))));
    return g;
  }

 private:
  double inner(std::size_t k) const { return static_cast<double>(k) * step_; }
  double outer(std::size_t k) const { return inner(k) + step_; }

  double step_, scale_ = 1 / step_, volume_;
  std::size_t count_;
};

}  // namespace vitrel

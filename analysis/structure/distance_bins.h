#pragma once

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <vector>

#include "analysis/structure/structure_options.h"
#include "core/state/configuration.h"

namespace vitrel {

/// Returns the area (volume) between two radii.
template <int Dim>
double shell_volume(double inner, double outer) {
  if constexpr (Dim == 2) return std::numbers::pi * (outer * outer - inner * inner);
  return 4 * std::numbers::pi / 3 * (outer * outer * outer - inner * inner * inner);
}

/// Bins of a distance, the k-th from k to k + 1 steps; there are as many as whole bins fit into the range.
class DistanceBins {
 public:
  DistanceBins(double range, double step)
      // A quotient that rounding leaves just below a whole number is taken as that number.
      : step_(step), count_(static_cast<std::size_t>(range / step * (1 + 1e-12))) {}
  /// Makes bins for the distances of pairs, below distance_max and half the shortest side of the box.
  template <int Dim>
  DistanceBins(const Configuration<Dim>& configuration, const PairCorrelationOptions& options)
      : DistanceBins(std::min(options.distance_max, 0.5 * configuration.box.lengths().minCoeff()),
                     options.distance_step) {}

  std::size_t count() const { return count_; }
  double step() const { return step_; }
  double range() const { return static_cast<double>(count_) * step_; }

  /// Returns the bin of a distance. Distances beyond the range go into one more bin, which is cheaper than to tell them
  /// apart.
  std::size_t bin(double distance) const {
    return static_cast<std::size_t>(std::min(scale_ * distance, static_cast<double>(count_)));
  }

  std::vector<double> middles() const {
    std::vector<double> middles;
    for (std::size_t k = 0; k < count_; ++k) middles.push_back(0.5 * (inner(k) + outer(k)));
    return middles;
  }

  /// Returns g, the `found(k)` pairs in the k-th bin over those of an ideal gas with this number of pairs in the area
  /// (volume) of its box.
  template <int Dim, class Found>
  std::vector<double> over_ideal_gas(double pairs, const PeriodicBox<Dim>& box,
                                     Found&& found) const {
    const double density = pairs / box.volume();
    std::vector<double> g;
    for (std::size_t k = 0; k < count_; ++k)
      g.push_back(found(k) / (density * shell_volume<Dim>(inner(k), outer(k))));
    return g;
  }

 private:
  double inner(std::size_t k) const { return static_cast<double>(k) * step_; }
  double outer(std::size_t k) const { return inner(k) + step_; }

  double step_, scale_ = 1 / step_;
  std::size_t count_;
};

}  // namespace vitrel

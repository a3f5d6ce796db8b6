#pragma once

#include <array>
#include <vector>

#include "core/state/configuration.h"

namespace vitrel {

/// Pressure of a hard system at constant volume by extrapolation of the contact function (after
/// Eppenga & Frenkel, 1984).
///
/// Shrinking box and positions by 1 − ε leaves no overlap with probability 1 − n_c ε + …, where n_c
/// is the mean number of pairs that touch per unit of ε at ε → 0. From βP = ∂ ln Q/∂V,
///     Z = βP/ρ = 1 + n_c/(2N)    (two dimensions).
/// A pair with max F = μ² (perram_wertheim.h) touches at ε = 1 − 1/μ. The density of these ε over
/// all pairs is collected in bins up to `widest` and extrapolated to 0 by a parabola.
class ContactPressure {
 public:
  /// `widest`: largest ε looked at; 0.05 keeps the error of the parabola below 1e-3 in Z.
  explicit ContactPressure(double widest = 0.05) : widest_(widest) {}

  /// Adds one configuration; many of them, decorrelated, make one block.
  void add(const Configuration2& configuration);
  /// Z from all configurations added so far; at least one.
  double compressibility() const;
  /// Forgets all configurations, to begin another block.
  void clear() { *this = ContactPressure(widest_); }

 private:
  static constexpr int bins = 12;

  double widest_;
  std::array<double, bins> pairs_{};
  double particles_ = 0;  // summed over configurations
};

}  // namespace vitrel

#pragma once

#include "core/neighbors/pairs.h"
#include "core/state/configuration.h"

namespace vitrel {

/// Correlations of two configurations. They are 1 if the configurations are equal, unless particles are so close that
/// they share a place, and 0 on average if the configurations are independent.
struct PlaceCorrelations {
  double places;
  double orientations;  ///< 0 if all particles are round
  double sizes;         ///< 0 if all sizes are equal
};

/// Correlates a configuration with later ones of the same particles, place by place, whatever the numbers of the
/// particles: exchanges of equal particles change nothing, and an exchange of unequal ones changes only the sizes.
///
/// The sums run over pairs of a particle i of the first and a particle j of the later configuration whose centres are
/// closer than 0.3 (V/N)^(1/D), after the mean displacement of all particles has been subtracted:
///   - places: Σ 1/N, minus its value by chance, so that 0 remains between independent configurations;
///   - orientations: Σ alignment (figure_axis.h)/N_rot of particles that are not round, cos 2Δθ in the plane;
///   - sizes: Σ δ_i δ_j/Σ δ_i², where δ is the deviation of (a b)^(1/2), in space (a b c)^(1/3), from the mean.
/// In an ordered state the correlations that the order maintains do not decay: S² of the orientations in a nematic, and
/// places in a crystal.
template <int Dim>
class PlaceCorrelation {
 public:
  explicit PlaceCorrelation(const Configuration<Dim>& first);

  /// Shapes and box must be those of the first configuration.
  PlaceCorrelations with(const Configuration<Dim>& later) const;

 private:
  Configuration<Dim> first_;
  CellGrid<Dim> cells_;
  std::vector<double> deviation_;  // deviation of the size of every particle from the mean
  double square_ = 0;              // Σ δ²
  double rotors_, reach_;
};

}  // namespace vitrel

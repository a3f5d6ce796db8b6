#pragma once

#include <concepts>

#include "core/contact/simd_batch.h"

/// @file
/// Lower bounds of the gaps between one body and several others, all at rest: for disks and spheres the
/// distances of the surfaces, for ellipses (ellipse_gap_batch.h) and ellipsoids (ellipsoid_gap_batch.h) the
/// support gap along a good axis (ellipse_gap.h).
namespace vitrel {

/// `set(k, …)` fills lane k, where d runs to the centre of the other body; then `evaluate()` computes
/// `gap(k)` and its `axis(k)`. Axes are improved until all gaps exceed `limit`.
template <class Shape>
class GapBatch;

/// Disks and spheres.
template <class Shape>
requires std::same_as<Shape, Disk> || std::same_as<Shape, Sphere>
class GapBatch<Shape> {
  static constexpr int dimension = Shape::dimension;

 public:
  static constexpr int lanes = 8;

  GapBatch(const Shape& shape, const Orientation<dimension>&, double /*limit*/)
      : radius_(shape.radius) {}

  VITREL_INLINE void set(int k, const Shape& shape, const Orientation<dimension>&,
                         const Vec<dimension>& d) {
    for (int x = 0; x < dimension; ++x) d_[x][k] = d[x];
    radii_[k] = shape.radius;
  }

  void evaluate() {
    Simd<lanes> square = d_[0].load() * d_[0].load() + d_[1].load() * d_[1].load();
    if constexpr (dimension == 3) square += d_[2].load() * d_[2].load();
    gap_.store(sqrt(square) - (radii_.load() + radius_));
  }

  double gap(int k) const { return gap_[k]; }
  /// Round bodies need no axis.
  Vec<dimension> axis(int) const { return Vec<dimension>::Zero(); }

 private:
  using Numbers = detail::BatchBuffer<lanes>;

  double radius_;
  Numbers d_[dimension], radii_, gap_;
};

}  // namespace vitrel

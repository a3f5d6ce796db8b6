#pragma once

#include "core/contact/simd_batch.h"

/// @file
/// Lower bounds of the gaps between one body and several others, all at rest. For disks and spheres they are the
/// distances of the surfaces; for ellipses (ellipse_gap_batch.h) and ellipsoids (ellipsoid_gap_batch.h), the support
/// gaps along a good axis (ellipse_gap.h).
namespace vitrel {

/// `set(k, …)` fills lane k, where d points to the centre of the other body; then `evaluate()` computes `gap(k)` and
/// its `axis(k)`. Axes are improved until all gaps exceed `limit`.
template <class Shape>
class GapBatch;

/// The batch for disks and spheres.
template <int Dim>
class GapBatch<Ball<Dim>> {
 public:
  static constexpr int lanes = 8;

  GapBatch(const Ball<Dim>& shape, const Orientation<Dim>&, double /*limit*/)
      : radius_(shape.radius) {}

  VITREL_INLINE void set(int k, const Ball<Dim>& shape, const Orientation<Dim>&,
                         const Vec<Dim>& d) {
    for (int x = 0; x < Dim; ++x) d_[x][k] = d[x];
    radii_[k] = shape.radius;
  }

  void evaluate() {
    Simd<lanes> square = d_[0].load() * d_[0].load() + d_[1].load() * d_[1].load();
    if constexpr (Dim == 3) square += d_[2].load() * d_[2].load();
    gap_.store(sqrt(square) - (radii_.load() + radius_));
  }

  double gap(int k) const { return gap_[k]; }
  /// Round bodies need no axis.
  Vec<Dim> axis(int) const { return Vec<Dim>::Zero(); }

 private:
  using Numbers = detail::BatchBuffer<lanes>;

  double radius_;
  Numbers d_[Dim], radii_, gap_;
};

}  // namespace vitrel

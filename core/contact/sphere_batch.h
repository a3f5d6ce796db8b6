#pragma once

#include <utility>

#include "core/contact/simd_batch.h"

namespace vitrel {

/// A batch of bodies at rest, represented by their circumspheres and inspheres (circles in the plane). An empty lane
/// holds a body far away.
template <int Dim>
struct SphereBatch {
  static constexpr double far_away = 1e150;  // its square is finite

  detail::BatchBuffer<simd_width> centre[Dim], outer,
      inner;  ///< radii of circumspheres and inspheres

  SphereBatch() {
    for (int lane = 0; lane < simd_width; ++lane) clear(lane);
  }
  void clear(int lane) {
    move(lane, Vec<Dim>::Constant(far_away));
    outer[lane] = inner[lane] = 0;
  }
  template <class Body>
  void set(int lane, const Body& body, const Vec<Dim>& position) {
    move(lane, position);
    outer[lane] = body.shape.circumradius();
    inner[lane] = body.shape.inradius();
  }
  void move(int lane, const Vec<Dim>& position) {
    for (int k = 0; k < Dim; ++k) centre[k][lane] = position[k];
  }
  template <class Body>
  void turn(int /*lane*/, const Body& /*body*/) {}  // spheres look the same at every orientation
  void copy(int lane, const SphereBatch& from, int from_lane) {
    move(lane, from.position(from_lane));
    outer[lane] = from.outer[from_lane];
    inner[lane] = from.inner[from_lane];
  }
  /// Exchanges the shapes of two lanes; positions stay.
  void swap_shapes(int lane, SphereBatch& other, int other_lane) {
    std::swap(outer[lane], other.outer[other_lane]);
    std::swap(inner[lane], other.inner[other_lane]);
  }

  SimdBatch circumradii() const { return outer.load(); }
  template <int k>
  SimdBatch coordinate() const {
    return centre[k].load();
  }
  /// Returns the squared lengths of the positions plus `offset`.
  SimdBatch squared_distances(const Vec<Dim>& offset) const {
    const SimdBatch dx = coordinate<0>() + offset.x(), dy = coordinate<1>() + offset.y();
    if constexpr (Dim == 2) {
      return dx * dx + dy * dy;
    } else {
      const SimdBatch dz = coordinate<2>() + offset.z();
      return dx * dx + dy * dy + dz * dz;
    }
  }

  Vec<Dim> position(int lane) const {
    Vec<Dim> position;
    for (int k = 0; k < Dim; ++k) position[k] = centre[k][lane];
    return position;
  }
};

}  // namespace vitrel

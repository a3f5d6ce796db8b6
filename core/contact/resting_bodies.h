#pragma once

#include <utility>

#include "core/contact/ellipse_free_path_batch.h"
#include "core/contact/ellipse_overlap_batch.h"
#include "core/contact/ellipsoid_free_path_batch.h"
#include "core/contact/ellipsoid_overlap_batch.h"
#include "core/contact/pair_free_paths.h"
#include "core/contact/pair_overlaps.h"

/// @file
/// Bodies at rest in Monte Carlo: how each shape is stored, and how its overlaps and free paths are found.
namespace vitrel {

/// The types for any shape with `separated` and `support_gap` (contact_queries.h):
///
///     Body        one body, without its position
///     Batch       several bodies, in SIMD lanes
///     Overlaps    whether one body keeps a margin to others
///     FreePaths   how far one body can move along x, y or z before it touches another
template <class Shape>
struct RestingBodies {
  using Body = OrientedBody<Shape>;
  using Batch = SphereBatch<Shape::dimension>;
  using Overlaps = PairOverlaps<Shape>;
  template <int direction>
  using FreePaths = PairFreePaths<Shape, direction>;

  static Body body(const Shape& shape, const Orientation<Shape::dimension>& orientation) {
    return {shape, orientation};
  }
};

template <>
struct RestingBodies<Ellipse> {
  using Body = OrientedEllipse;
  using Batch = EllipseBatch;
  using Overlaps = EllipseOverlapBatch;
  template <int direction>
  using FreePaths = EllipseFreePathBatch<direction>;

  static Body body(const Ellipse& shape, double angle) { return {shape, direction(angle)}; }
};

template <>
struct RestingBodies<Ellipsoid> {
  using Body = OrientedEllipsoid;
  using Batch = SphereBatch<3>;
  using Overlaps = EllipsoidOverlapBatch;
  template <int direction>
  using FreePaths = EllipsoidFreePathBatch<direction>;

  static Body body(const Ellipsoid& shape, const Quaternion& orientation) {
    return {shape, orientation};
  }
};

// These are the functions of oriented_body.h except `support_gap`, which the free paths of these shapes do not need.
inline bool separated(const OrientedEllipse& one, const OrientedEllipse& two, const Vec2& d,
                      double margin) {
  return separated(one.shape, one.axis, two.shape, two.axis, d, margin);
}
inline bool separated(const OrientedEllipsoid& one, const OrientedEllipsoid& two, const Vec3& d,
                      double margin) {
  return separated(one.shape, one.orientation, two.shape, two.orientation, d, margin);
}

inline OrientedEllipse with_shape(const OrientedEllipse& body, const Ellipse& shape) {
  return {shape, body.axis};
}
inline OrientedEllipsoid with_shape(const OrientedEllipsoid& body, const Ellipsoid& shape) {
  return {shape, body.orientation};
}

inline void swap_orientations(OrientedEllipse& one, OrientedEllipse& two) {
  std::swap(one.axis, two.axis);
}
inline void swap_orientations(OrientedEllipsoid& one, OrientedEllipsoid& two) {
  if (one.shape.is_round() &&
      two.shape.is_round()) {  // orientations do not change their shape matrices
    std::swap(one.orientation, two.orientation);
    return;
  }
  const Quaternion of_one = one.orientation;
  one = {one.shape, two.orientation};
  two = {two.shape, of_one};
}

}  // namespace vitrel

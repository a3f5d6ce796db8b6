#pragma once

#include <utility>

#include "core/contact/contact_queries.h"

/// @file
/// The data of a body at rest, without its position, that overlap tests and free paths need. For most shapes this is
/// the orientation; for ellipses (ellipse_batch.h) and ellipsoids (ellipsoid_overlap_batch.h) it is computed from the
/// orientation.
namespace vitrel {

template <class Shape>
struct OrientedBody {
  Shape shape;
  Orientation<Shape::dimension> orientation;
};

namespace detail {

/// Returns the pose of a body whose centre is the origin.
template <class Shape>
Pose<Shape::dimension> pose_of(const OrientedBody<Shape>& body) {
  return {Vec<Shape::dimension>::Zero(), body.orientation};
}

}  // namespace detail

/// Returns whether two bodies keep a margin (contact_queries.h).
template <class Shape>
bool separated(const OrientedBody<Shape>& one, const OrientedBody<Shape>& two,
               const Vec<Shape::dimension>& d, double margin) {
  return separated(one.shape, detail::pose_of(one), two.shape, detail::pose_of(two), d, margin);
}

/// Returns the support gap of two bodies (contact_queries.h).
template <class Shape>
SupportGapOf<Shape::dimension> support_gap(const OrientedBody<Shape>& one,
                                           const OrientedBody<Shape>& two,
                                           const Vec<Shape::dimension>& d) {
  return support_gap(one.shape, detail::pose_of(one), two.shape, detail::pose_of(two), d);
}

/// Returns the body with another shape.
template <class Shape>
OrientedBody<Shape> with_shape(const OrientedBody<Shape>& body, const Shape& shape) {
  return {shape, body.orientation};
}

template <class Shape>
void swap_orientations(OrientedBody<Shape>& one, OrientedBody<Shape>& two) {
  std::swap(one.orientation, two.orientation);
}

}  // namespace vitrel

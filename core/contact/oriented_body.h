#pragma once

#include <utility>

#include "core/contact/contact_queries.h"

/// @file
/// What overlap tests and free paths need of a body at rest, apart from its place: of most shapes the orientation, of
/// ellipses (ellipse_batch.h) and ellipsoids (ellipsoid_overlap_batch.h) what is computed from it.
namespace vitrel {

template <class Shape>
struct OrientedBody {
  Shape shape;
  Orientation<Shape::dimension> orientation;
};

namespace detail {

/// The pose of a body whose centre is the origin.
template <class Shape>
Pose<Shape::dimension> pose_of(const OrientedBody<Shape>& body) {
  return {Vec<Shape::dimension>::Zero(), body.orientation};
}

}  // namespace detail

/// Whether two bodies keep a margin (contact_queries.h).
template <class Shape>
bool separated(const OrientedBody<Shape>& one, const OrientedBody<Shape>& two,
               const Vec<Shape::dimension>& d, double margin) {
  return separated(one.shape, detail::pose_of(one), two.shape, detail::pose_of(two), d, margin);
}

/// The support gap of two bodies (contact_queries.h).
template <class Shape>
SupportGapOf<Shape::dimension> support_gap(const OrientedBody<Shape>& one,
                                           const OrientedBody<Shape>& two,
                                           const Vec<Shape::dimension>& d) {
  return support_gap(one.shape, detail::pose_of(one), two.shape, detail::pose_of(two), d);
}

/// The same body with another shape.
template <class Shape>
OrientedBody<Shape> with_shape(const OrientedBody<Shape>& body, const Shape& shape) {
  return {shape, body.orientation};
}

template <class Shape>
void swap_orientations(OrientedBody<Shape>& one, OrientedBody<Shape>& two) {
  std::swap(one.orientation, two.orientation);
}

}  // namespace vitrel

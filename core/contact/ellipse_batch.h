#pragma once

#include <utility>

#include "core/contact/simd_batch.h"

namespace vitrel {

/// An ellipse at rest, without its position.
struct OrientedEllipse {
  Ellipse shape;
  Vec2 axis;  ///< unit vector along the major axis
};

/// A batch of ellipses at rest. An empty lane holds an ellipse far away.
struct EllipseBatch {
  static constexpr double far_away = 1e150;  // its square is finite

  detail::BatchBuffer<simd_width> x, y, a, b, ux, uy;

  EllipseBatch() {
    for (int lane = 0; lane < simd_width; ++lane) clear(lane);
  }
  void clear(int lane) { set(lane, {0, 0}, Vec2(far_away, far_away), Vec2(1, 0)); }
  void set(int lane, const OrientedEllipse& body, const Vec2& position) {
    set(lane, body.shape, position, body.axis);
  }
  void set(int lane, const Ellipse& shape, const Vec2& position, const Vec2& axis) {
    x[lane] = position.x(), y[lane] = position.y();
    a[lane] = shape.a, b[lane] = shape.b;
    ux[lane] = axis.x(), uy[lane] = axis.y();
  }

  /// Copies a lane of another batch.
  void copy(int lane, const EllipseBatch& from, int from_lane) {
    set(lane, from.shape(from_lane), from.position(from_lane), from.axis(from_lane));
  }
  void move(int lane, const Vec2& position) { x[lane] = position.x(), y[lane] = position.y(); }
  /// Sets only the axis, since reading numbers as a batch is slow just after they were written one by one.
  void turn(int lane, const OrientedEllipse& body) {
    ux[lane] = body.axis.x(), uy[lane] = body.axis.y();
  }
  /// Exchanges the shapes of two lanes; positions and axes stay.
  void swap_shapes(int lane, EllipseBatch& other, int other_lane) {
    std::swap(a[lane], other.a[other_lane]);
    std::swap(b[lane], other.b[other_lane]);
  }

  SimdBatch circumradii() const { return a.load(); }
  template <int k>
  SimdBatch coordinate() const {
    return (k == 0 ? x : y).load();
  }
  template <int k>
  SimdBatch axis_component() const {
    return (k == 0 ? ux : uy).load();
  }
  /// Returns the squared lengths of the positions plus `offset`.
  SimdBatch squared_distances(const Vec2& offset) const {
    const SimdBatch dx = x.load() + offset.x(), dy = y.load() + offset.y();
    return dx * dx + dy * dy;
  }

  Ellipse shape(int lane) const { return {a[lane], b[lane]}; }
  Vec2 position(int lane) const { return {x[lane], y[lane]}; }
  Vec2 axis(int lane) const { return {ux[lane], uy[lane]}; }
  OrientedEllipse body(int lane) const { return {shape(lane), axis(lane)}; }
};

}  // namespace vitrel

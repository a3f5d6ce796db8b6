#pragma once

#include "core/contact/simd_batch.h"

namespace vitrel {

/// A batch of ellipses at rest. An empty lane holds an ellipse far away.
struct EllipseBatch {
  static constexpr double far_away = 1e150;  // its square is finite

  detail::BatchBuffer<simd_width> x, y, a, b, ux, uy;

  EllipseBatch() {
    for (int lane = 0; lane < simd_width; ++lane) clear(lane);
  }
  void clear(int lane) { set(lane, {0, 0}, Vec2(far_away, far_away), Vec2(1, 0)); }
  void set(int lane, const Ellipse& shape, const Vec2& position, const Vec2& axis) {
    x[lane] = position.x(), y[lane] = position.y();
    a[lane] = shape.a, b[lane] = shape.b;
    ux[lane] = axis.x(), uy[lane] = axis.y();
  }

  Ellipse shape(int lane) const { return {a[lane], b[lane]}; }
  Vec2 position(int lane) const { return {x[lane], y[lane]}; }
  Vec2 axis(int lane) const { return {ux[lane], uy[lane]}; }
};

}  // namespace vitrel

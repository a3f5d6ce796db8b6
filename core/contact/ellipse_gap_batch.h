#pragma once

#include "core/contact/ellipse_pair.h"
#include "core/contact/gap_batch.h"

namespace vitrel {

/// The batch for ellipses computes the gap along C⁻¹d with the λ of circles (detail::initial_axis) and the gap along
/// this axis turned by one Newton step, and keeps the larger of the two.
template <>
class GapBatch<Ellipse> {
  using Batch = Simd<2 * simd_width>;

 public:
  static constexpr int lanes = 2 * simd_width;

  GapBatch(const Ellipse& shape, double angle, double /*limit*/) : coefficients_(shape) {
    const Vec2 u = direction(angle);
    ux_ = u.x();
    uy_ = u.y();
  }

  VITREL_INLINE void set(int k, const Ellipse& shape, double angle, const Vec2& d) {
    dx_[k] = d.x();
    dy_[k] = d.y();
    angle_[k] = angle;
    const double bb = shape.b * shape.b;
    bb_[k] = bb;
    aa_minus_bb_[k] = shape.aa_minus_bb();
    aabb_[k] = shape.a * shape.a * bb;
  }

  VITREL_FLATTEN void evaluate() {
    const Body one{coefficients_.bb, coefficients_.aa_minus_bb, coefficients_.aabb, ux_, uy_};
    Body two{bb_.load(), aa_minus_bb_.load(), aabb_.load(), {}, {}};
    directions<Batch>(angle_.load(), two.ux, two.uy);
    const Batch dx = dx_.load(), dy = dy_.load();
    Batch nx, ny;
    initial_axes(one, two, dx, dy, nx, ny);
    const Gap first = gap_along(one, two, dx, dy, nx, ny);
    Batch turned_nx = nx, turned_ny = ny;
    detail::newton_rotate(turned_nx, turned_ny, first.slope, first.curvature);
    const Gap second = gap_along(one, two, dx, dy, turned_nx, turned_ny);
    const auto better = second.gap > first.gap;
    nx = select(better, turned_nx, nx);
    ny = select(better, turned_ny, ny);
    gap_.store(max(first.gap, second.gap));
    nx_.store(nx);
    ny_.store(ny);
  }

  double gap(int k) const { return gap_[k]; }
  Vec2 axis(int k) const { return {nx_[k], ny_[k]}; }

 private:
  struct Body {
    Batch bb, aa_minus_bb, aabb, ux, uy;
  };
  struct Gap {
    Batch gap, slope, curvature;
  };

  VITREL_INLINE static Gap gap_along(const Body& one, const Body& two, const Batch& dx,
                                     const Batch& dy, const Batch& nx, const Batch& ny) {
    const auto h1 = support_along<Batch>(one.bb, one.aa_minus_bb, one.aabb, one.ux, one.uy, nx, ny);
    const auto h2 = support_along<Batch>(two.bb, two.aa_minus_bb, two.aabb, two.ux, two.uy, nx, ny);
    const Batch gap = nx * dx + ny * dy - (h1.height + h2.height);
    return {gap, nx * dy - ny * dx - (h1.turning + h2.turning), gap + (h1.radius + h2.radius)};
  }

  // Computes w = adj(Σ) d and p = d·w.
  VITREL_INLINE static void adjugate_times(const Body& body, const Batch& dx, const Batch& dy,
                                           Batch& wx, Batch& wy, Batch& p) {
    const Batch along = body.ux * dx + body.uy * dy;
    const Batch across = body.ux * dy - body.uy * dx;
    const Batch b = body.bb * along, a = (body.bb + body.aa_minus_bb) * across;
    wx = b * body.ux - a * body.uy;
    wy = b * body.uy + a * body.ux;
    p = b * along + a * across;
  }

  VITREL_INLINE static void initial_axes(const Body& one, const Body& two, const Batch& dx,
                                         const Batch& dy, Batch& nx, Batch& ny) {
    Batch wx1, wy1, p1, wx2, wy2, p2;
    adjugate_times(one, dx, dy, wx1, wy1, p1);
    adjugate_times(two, dx, dy, wx2, wy2, p2);
    const Batch x = two.aabb * p1, y = one.aabb * p2;
    const Batch weight1 = 3. * x + y, weight2 = x + 3. * y;
    nx = weight1 * wx1 + weight2 * wx2;
    ny = weight1 * wy1 + weight2 * wy2;
    const Batch square = nx * nx + ny * ny;
    const Batch scale = 1. / sqrt(square);
    // Where the centres coincide, any axis gives a lower bound.
    const auto coincide = square == Batch(0.);
    nx = select(coincide, Batch(1.), nx * scale);
    ny = select(coincide, Batch(0.), ny * scale);
  }

  using Numbers = detail::BatchBuffer<lanes>;

  ShapeCoefficients<Ellipse> coefficients_;
  double ux_, uy_;
  Numbers dx_, dy_, angle_, bb_, aa_minus_bb_, aabb_, gap_, nx_, ny_;
};

}  // namespace vitrel

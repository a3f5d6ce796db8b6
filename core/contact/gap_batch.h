#pragma once

#include <concepts>

#include "core/contact/several.h"

/// The gaps between one body and several others that stand still: for disks the distances of the
/// surfaces, for ellipses the gap along a good axis (support_gap.h), a lower bound of the distance.
/// That axis is C⁻¹d with λ as for circles (likely_axis), turned by one step of Newton's method if
/// that improves it.
namespace vitrel {

template <class Shape>
class GapLook;

template <>
class GapLook<Ellipse> {
 public:
  static constexpr int lanes = many;

  GapLook(const Ellipse& shape, double angle, double /*limit*/) : outline_(shape) {
    Lanes x, y;
    directions<Lanes>({angle, angle}, x, y);
    ux_ = x[0];
    uy_ = y[0];
  }

  /// Puts another body into a lane; d runs to its centre.
  VITREL_INLINE void set(int k, const Ellipse& shape, double angle, const Vec2& d) {
    dx_[k] = d.x();
    dy_[k] = d.y();
    angle_[k] = angle;
    const double bb = shape.b * shape.b;
    bb_[k] = bb;
    stretch_[k] = shape.stretch();
    aabb_[k] = shape.a * shape.a * bb;
  }

  [[gnu::flatten]] void look() {
    const Body one{outline_.bb, outline_.stretch, outline_.aabb, ux_, uy_};
    Body two{bb_.all(), stretch_.all(), aabb_.all(), {}, {}};
    directions<Many>(angle_.all(), two.ux, two.uy);
    const Many dx = dx_.all(), dy = dy_.all();
    Many nx, ny;
    likely_axes(one, two, dx, dy, nx, ny);
    const Gap first = gap_along(one, two, dx, dy, nx, ny);
    Many turned_nx = nx, turned_ny = ny;
    detail::turn(turned_nx, turned_ny, first.slope, first.curvature);
    const Gap second = gap_along(one, two, dx, dy, turned_nx, turned_ny);
    const auto better = second.gap > first.gap;
    where(better, nx) = turned_nx;
    where(better, ny) = turned_ny;
    gap_.store(max(first.gap, second.gap));
    nx_.store(nx);
    ny_.store(ny);
  }

  double gap(int k) const { return gap_[k]; }
  Vec2 axis(int k) const { return {nx_[k], ny_[k]}; }

 private:
  struct Body {
    Many bb, stretch, aabb, ux, uy;
  };
  struct Gap {
    Many gap, slope, curvature;
  };

  VITREL_INLINE static Gap gap_along(const Body& one, const Body& two, const Many& dx,
                                     const Many& dy, const Many& nx, const Many& ny) {
    const auto h1 = support_along<Many>(one.bb, one.stretch, one.aabb, one.ux, one.uy, nx, ny);
    const auto h2 = support_along<Many>(two.bb, two.stretch, two.aabb, two.ux, two.uy, nx, ny);
    const Many gap = nx * dx + ny * dy - (h1.height + h2.height);
    return {gap, nx * dy - ny * dx - (h1.turning + h2.turning), gap + (h1.radius + h2.radius)};
  }

  // w = adj(Σ) d and p = d·w.
  VITREL_INLINE static void weigh(const Body& body, const Many& dx, const Many& dy, Many& wx,
                                  Many& wy, Many& p) {
    const Many along = body.ux * dx + body.uy * dy;
    const Many across = body.ux * dy - body.uy * dx;
    const Many b = body.bb * along, a = (body.bb + body.stretch) * across;
    wx = b * body.ux - a * body.uy;
    wy = b * body.uy + a * body.ux;
    p = b * along + a * across;
  }

  VITREL_INLINE static void likely_axes(const Body& one, const Body& two, const Many& dx,
                                        const Many& dy, Many& nx, Many& ny) {
    Many wx1, wy1, p1, wx2, wy2, p2;
    weigh(one, dx, dy, wx1, wy1, p1);
    weigh(two, dx, dy, wx2, wy2, p2);
    const Many x = two.aabb * p1, y = one.aabb * p2;
    const Many weight1 = 3. * x + y, weight2 = x + 3. * y;
    nx = weight1 * wx1 + weight2 * wx2;
    ny = weight1 * wy1 + weight2 * wy2;
    const Many scale = 1. / sqrt(nx * nx + ny * ny);
    nx *= scale;
    ny *= scale;
  }

  using Numbers = detail::NumbersOf<many>;

  Outline<Ellipse> outline_;
  double ux_, uy_;
  Numbers dx_, dy_, angle_, bb_, stretch_, aabb_, gap_, nx_, ny_;
};

/// Disks and spheres.
template <class Shape>
requires std::same_as<Shape, Disk> || std::same_as<Shape, Sphere>
class GapLook<Shape> {
  static constexpr int dimension = Shape::dimension;

 public:
  static constexpr int lanes = 8;

  GapLook(const Shape& shape, const Orientation<dimension>&, double /*limit*/)
      : radius_(shape.radius) {}

  VITREL_INLINE void set(int k, const Shape& shape, const Orientation<dimension>&,
                         const Vec<dimension>& d) {
    for (int x = 0; x < dimension; ++x) d_[x][k] = d[x];
    radii_[k] = shape.radius;
  }

  void look() {
    detail::Simd<lanes> square = d_[0].all() * d_[0].all() + d_[1].all() * d_[1].all();
    if constexpr (dimension == 3) square += d_[2].all() * d_[2].all();
    gap_.store(sqrt(square) - (radii_.all() + radius_));
  }

  double gap(int k) const { return gap_[k]; }
  /// Round bodies need none.
  Vec<dimension> axis(int) const { return Vec<dimension>::Zero(); }

 private:
  using Numbers = detail::NumbersOf<lanes>;

  double radius_;
  Numbers d_[dimension], radii_, gap_;
};

}  // namespace vitrel

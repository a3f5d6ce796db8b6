#pragma once

#include <experimental/simd>
#include <limits>

#include "core/contact/ellipse_pair.h"
#include "core/geometry/disk.h"
#include "core/geometry/ellipsoid.h"
#include "core/geometry/sphere.h"

/// What the looks of one body at several others share (first_look.h, gap_look.h): numbers in lanes,
/// one lane for each pair.
namespace vitrel {

/// What a look needs to know of a shape (at size 1).
template <class Shape>
struct Outline;

template <>
struct Outline<Disk> {
  double radius = 1;
  explicit Outline(const Disk& disk) : radius(disk.radius) {}
};

template <>
struct Outline<Sphere> {
  double radius = 1;
  explicit Outline(const Sphere& sphere) : radius(sphere.radius) {}
};

template <>
struct Outline<Ellipsoid> {
  Vec3 semi_axes;
  double stretch, shortest_squared;  ///< a² − c², c²
  explicit Outline(const Ellipsoid& ellipsoid)
      : semi_axes(ellipsoid.semi_axes),
        stretch((ellipsoid.circumradius() - ellipsoid.inradius()) *
                (ellipsoid.circumradius() + ellipsoid.inradius())),
        shortest_squared(ellipsoid.inradius() * ellipsoid.inradius()) {}
};

template <>
struct Outline<Ellipse> {
  double bb, stretch, aabb;  ///< b², a² − b², a² b²
  double bend;               ///< (a² − b²)/b, the largest h''
  explicit Outline(const Ellipse& ellipse)
      : bb(ellipse.b * ellipse.b),
        stretch(ellipse.stretch()),
        aabb(ellipse.a * ellipse.a * bb),
        bend(stretch / ellipse.b) {}
};

namespace detail {

template <int lanes>
using Simd = std::experimental::fixed_size_simd<double, lanes>;

/// One number of each of several pairs, filled one by one.
template <int lanes>
struct NumbersOf {
  alignas(std::experimental::memory_alignment_v<Simd<lanes>>) double lane[lanes] = {};
  double& operator[](int k) { return lane[k]; }
  double operator[](int k) const { return lane[k]; }
  Simd<lanes> all() const { return {lane, std::experimental::vector_aligned}; }
  void store(const Simd<lanes>& x) { x.copy_to(lane, std::experimental::vector_aligned); }
};

/// 0, 1, 2 …
template <int lanes>
const Simd<lanes> lane_numbers([](int k) { return k; });

/// Unit vectors, turned by one step of Newton's method in the angle, as far as it can be trusted.
VITREL_INLINE void turn(Many& nx, Many& ny, const Many& slope, const Many& curvature) {
  const Many angle = min(max(slope / curvature, Many(-0.5)), Many(0.5));
  const Many q = 0.5 * angle;
  const Many scale = 1. / (1. + q * q);
  const Many cosine = (1. - q * q) * scale, sine = angle * scale;
  const Many old_nx = nx;
  nx = cosine * nx - sine * ny;
  ny = cosine * ny + sine * old_nx;
}

}  // namespace detail
}  // namespace vitrel

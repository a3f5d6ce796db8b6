#pragma once

#include <cstring>

#include "core/contact/ellipse_pair.h"
#include "core/geometry/asymmetric_top.h"
#include "core/geometry/ball.h"

/// @file
/// The parts that all SIMD batches share: precomputed shape coefficients, and buffers that are filled lane by lane. One
/// lane holds one pair.
namespace vitrel {

/// The coefficients of a shape, at size 1, that batched formulas need.
template <class Shape>
struct ShapeCoefficients;

template <int Dim>
struct ShapeCoefficients<Ball<Dim>> {
  double radius = 1;
  explicit ShapeCoefficients(const Ball<Dim>& ball) : radius(ball.radius) {}
};

template <>
struct ShapeCoefficients<Ellipsoid> {
  Vec3 semi_axes;
  double aa_minus_cc, cc;           ///< a² − c², c²
  double max_angular_acceleration;  ///< maximum for a tumbling body, over Ω² (asymmetric_top.h)
  /// A tumbling body has ḧ ≤ max_tumbling Ω² with Ω = max |ω|. In the frame of space, ḧ is at most Ω²(a² − c²)/c, the
  /// bound for constant ω, plus |dω/dt| (a − c).
  double max_tumbling;
  explicit ShapeCoefficients(const Ellipsoid& ellipsoid)
      : semi_axes(ellipsoid.semi_axes),
        aa_minus_cc((ellipsoid.circumradius() - ellipsoid.inradius()) *
                    (ellipsoid.circumradius() + ellipsoid.inradius())),
        cc(ellipsoid.inradius() * ellipsoid.inradius()),
        max_angular_acceleration(AsymmetricTop::max_acceleration_factor(ellipsoid)),
        max_tumbling(aa_minus_cc / ellipsoid.inradius() +
                     max_angular_acceleration * ellipsoid.max_support_rate()) {}
};

template <>
struct ShapeCoefficients<Ellipse> {
  double bb, aa_minus_bb, aabb;  ///< b², a² − b², a² b²
  double max_second_derivative;  ///< (a² − b²)/b, the maximum of h''
  explicit ShapeCoefficients(const Ellipse& ellipse)
      : bb(ellipse.b * ellipse.b),
        aa_minus_bb(ellipse.aa_minus_bb()),
        aabb(ellipse.a * ellipse.a * bb),
        max_second_derivative(aa_minus_bb / ellipse.b) {}
};

namespace detail {

/// Reads four records of at least `rows` numbers (rows even): lane k of column r is number r of record k.
template <int rows>
VITREL_INLINE void load_columns(const double* const (&record)[simd_width],
                                SimdBatch (&column)[rows]) {
  using Two [[gnu::vector_size(2 * sizeof(double))]] = double;
  for (int r = 0; r < rows; r += 2) {
    Two two[simd_width];
    for (int k = 0; k < simd_width; ++k) std::memcpy(&two[k], record[k] + r, sizeof(Two));
#ifdef __AVX__
    const SimdBatch::Register even = __builtin_shufflevector(two[0], two[2], 0, 1, 2, 3);
    const SimdBatch::Register odd = __builtin_shufflevector(two[1], two[3], 0, 1, 2, 3);
    column[r].part[0] = __builtin_shufflevector(even, odd, 0, 4, 2, 6);
    column[r + 1].part[0] = __builtin_shufflevector(even, odd, 1, 5, 3, 7);
#else
    for (int half = 0; half < 2; ++half) {
      column[r].part[half] = __builtin_shufflevector(two[2 * half], two[2 * half + 1], 0, 2);
      column[r + 1].part[half] = __builtin_shufflevector(two[2 * half], two[2 * half + 1], 1, 3);
    }
#endif
  }
}
template <int rows, int lanes, class Record>
VITREL_INLINE void load_columns(const Record* const (&record)[lanes], Simd<lanes> (&column)[rows]) {
  for (int first = 0; first < lanes; first += simd_width) {
    const double* numbers[simd_width];
    for (int k = 0; k < simd_width; ++k) numbers[k] = record[first + k]->numbers();
    SimdBatch four[rows];
    load_columns(numbers, four);
    for (int r = 0; r < rows; ++r)
      for (int p = 0; p < SimdBatch::parts; ++p)
        column[r].part[first / Simd<lanes>::width + p] = four[r].part[p];
  }
}

/// One number per lane. A buffer is written lane by lane, and loaded and stored as a batch.
template <int lanes>
struct BatchBuffer {
  alignas(Simd<lanes>) double lane[lanes] = {};
  double& operator[](int k) { return lane[k]; }
  double operator[](int k) const { return lane[k]; }
  Simd<lanes> load() const { return Simd<lanes>::load(lane); }
  void store(const Simd<lanes>& x) { x.store(lane); }
};

/// Returns the numbers 0, 1, 2 …
template <int lanes>
VITREL_INLINE Simd<lanes> lane_indices() {
  static constexpr double indices[] = {0, 1, 2, 3, 4, 5, 6, 7};
  return Simd<lanes>::load(indices);
}

/// Returns true in all lanes but one.
VITREL_INLINE SimdBatch::Mask all_lanes_but(int lane) {
  return !(lane_indices<simd_width>() == lane);
}

/// Rotates unit vectors by one Newton step in the angle, of at most 1/2.
template <class T>
VITREL_INLINE void newton_rotate(T& nx, T& ny, const T& slope, const T& curvature) {
  const T angle = min(max(slope / curvature, T(-0.5)), T(0.5));
  const T q = 0.5 * angle;
  const T scale = 1. / (1. + q * q);
  const T cosine = (1. - q * q) * scale, sine = angle * scale;
  const T old_nx = nx;
  nx = cosine * nx - sine * ny;
  ny = cosine * ny + sine * old_nx;
}

}  // namespace detail
}  // namespace vitrel

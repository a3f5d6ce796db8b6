#pragma once

#include "core/contact/ellipsoid_pair.h"
#include "core/contact/simd_batch.h"

/// @file
/// Vectors and ellipsoids in SIMD batches.
namespace vitrel::detail {

using BatchVec3 = Vec3Of<SimdBatch>;

/// One vector per lane.
struct Vec3Buffer {
  BatchBuffer<simd_width> x, y, z;
  void set(int k, const Vec3& v) { x[k] = v.x(), y[k] = v.y(), z[k] = v.z(); }
  Vec3 operator[](int k) const { return {x[k], y[k], z[k]}; }
  BatchVec3 load() const { return {x.load(), y.load(), z.load()}; }
  void store(const BatchVec3& v) { x.store(v.x), y.store(v.y), z.store(v.z); }
};

struct BatchQuaternion {
  SimdBatch w;
  BatchVec3 xyz;
};

/// Returns the unit vectors along the axes of the body.
VITREL_INLINE AxesOf<SimdBatch> directions_of(const BatchQuaternion& q) {
  const auto& [x, y, z] = q.xyz;
  const SimdBatch x2 = 2. * x, y2 = 2. * y, z2 = 2. * z;
  const SimdBatch xx = x * x2, yy = y * y2, zz = z * z2;
  const SimdBatch xy = x * y2, xz = x * z2, yz = y * z2;
  const SimdBatch wx = q.w * x2, wy = q.w * y2, wz = q.w * z2;
  return {{1. - (yy + zz), xy + wz, xz - wy},
          {xy - wz, 1. - (xx + zz), yz + wx},
          {xz + wy, yz - wx, 1. - (xx + yy)}};
}

/// Returns the orientation after rotating by ω t: exp(ω t/2) q, normalised.
VITREL_INLINE BatchQuaternion rotated(const BatchQuaternion& q, const BatchVec3& omega,
                                      const SimdBatch& time) {
  constexpr double at_rest = 1e-300;
  const SimdBatch speed = sqrt(dot(omega, omega));
  SimdBatch cosine, sine;
  directions<SimdBatch>(0.5 * speed * time, cosine, sine);
  const SimdBatch along = sine / max(speed, SimdBatch(at_rest));
  const BatchVec3 u{along * omega.x, along * omega.y, along * omega.z};
  const auto& [x, y, z] = q.xyz;
  const BatchQuaternion product{
      cosine * q.w - (u.x * x + u.y * y + u.z * z),
      {cosine * x + q.w * u.x + (u.y * z - u.z * y), cosine * y + q.w * u.y + (u.z * x - u.x * z),
       cosine * z + q.w * u.z + (u.x * y - u.y * x)}};
  const SimdBatch scale = 1. / sqrt(product.w * product.w + dot(product.xyz, product.xyz));
  return {scale * product.w, {scale * product.xyz.x, scale * product.xyz.y, scale * product.xyz.z}};
}

/// One ellipsoid per lane.
struct EllipsoidBuffer {
  BatchBuffer<simd_width> w;  ///< real part of the quaternions; xyz is the vector part
  Vec3Buffer xyz, semi_axes;
  void set(int k, const Quaternion& q, const Vec3& axes) {
    w[k] = q.w();
    xyz.set(k, q.vec());
    semi_axes.set(k, axes);
  }
  BatchQuaternion orientations() const { return {w.load(), xyz.load()}; }
};

template <class T>
VITREL_INLINE Vec3Of<T> times(const T& factor, const Vec3Of<T>& v) {
  return {factor * v.x, factor * v.y, factor * v.z};
}

template <class T>
VITREL_INLINE AxesOf<T> scaled(const AxesOf<T>& directions, const Vec3Of<T>& lengths) {
  return {times(lengths.x, directions.first), times(lengths.y, directions.second),
          times(lengths.z, directions.third)};
}

inline AxesOf<double> axes_of(const Quaternion& orientation, const Vec3& semi_axes) {
  const Mat3 turn = rotation_matrix(orientation);
  return {components(semi_axes[0] * turn.col(0)), components(semi_axes[1] * turn.col(1)),
          components(semi_axes[2] * turn.col(2))};
}

/// Rotates unit vectors by one Newton step on the sphere, of length at most 1/2. The step is C⁻¹ s in the plane of e₁
/// and e₂, or s/h where C is not positive definite; s is the gradient and h the sum of the heights.
VITREL_INLINE BatchVec3 turned(const AxisOf<SimdBatch>& axis, const SimdBatch& s1,
                               const SimdBatch& s2, const SimdBatch& c11, const SimdBatch& c12,
                               const SimdBatch& c22, const SimdBatch& h) {
  constexpr double longest = 0.5;
  const SimdBatch det = c11 * c22 - c12 * c12;
  const auto peaked = det > 0 && c11 + c22 > 0;
  const SimdBatch inverse = 1. / h;
  SimdBatch step1 = inverse * s1, step2 = inverse * s2;
  step1 = select(peaked, (c22 * s1 - c12 * s2) / det, step1);
  step2 = select(peaked, (c11 * s2 - c12 * s1) / det, step2);
  const SimdBatch length = sqrt(step1 * step1 + step2 * step2);
  SimdBatch kept = 1;
  kept = select(length > longest, longest / length, kept);
  step1 *= kept;
  step2 *= kept;
  const SimdBatch q = 0.25 * (step1 * step1 + step2 * step2);
  const SimdBatch scale = 1. / (1. + q);
  const SimdBatch on = (1. - q) * scale, f1 = scale * step1, f2 = scale * step2;
  return {on * axis.n.x + f1 * axis.e1.x + f2 * axis.e2.x,
          on * axis.n.y + f1 * axis.e1.y + f2 * axis.e2.y,
          on * axis.n.z + f1 * axis.e1.z + f2 * axis.e2.z};
}

}  // namespace vitrel::detail

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "core/elementary.h"

/// @file
/// Small vectors, matrices and rotations, and the arithmetic on them whose result depends on the order of its terms.
///
/// Lengths are in the program's unit of length (the reference species has semi-axes a b = 1). `Shift` counts whole box
/// lengths.
///
/// Eigen leaves open in which order it sums: that depends on its version and on the instructions of the processor, and
/// some of its kernels fuse products into sums. Here, every sum that affects a trajectory runs from the first component
/// to the last. Operations on single components (sums and multiples of vectors, cwiseProduct, cross, asDiagonal)
/// involve no such order, so Eigen's are used. Within the namespace, overload resolution prefers the products of
/// fixed-size matrices and of quaternions below to Eigen's, since they take their operands without a conversion to a
/// base class. scripts/check_arithmetic refuses Eigen's own reductions in core, mc, edmd and the stages of the
/// workflow.
namespace vitrel {

template <int Dim>
using Vec = Eigen::Matrix<double, Dim, 1>;
using Vec2 = Vec<2>;
using Vec3 = Vec<3>;
using Mat2 = Eigen::Matrix2d;
using Mat3 = Eigen::Matrix3d;
/// A rotation; its norm is 1 to rounding.
using Quaternion = Eigen::Quaterniond;

/// Whole box lengths per direction: the image of a particle at r lies at r + shift ∘ L.
template <int Dim>
using Shift = Eigen::Matrix<std::int32_t, Dim, 1>;

/// A matrix or vector whose size is known at compile time, or an expression of such matrices or vectors.
template <class M>
concept FixedSize = (M::SizeAtCompileTime != Eigen::Dynamic) &&
                    std::is_class_v<decltype(std::declval<M>().cwiseAbs2())>;

template <FixedSize A, FixedSize B>
auto operator*(const A& one, const B& two) {
  constexpr int rows = A::RowsAtCompileTime, columns = B::ColsAtCompileTime,
                terms = A::ColsAtCompileTime;
  static_assert(terms == B::RowsAtCompileTime);
  const typename A::PlainObject& a = one;
  const typename B::PlainObject& b = two;
  Eigen::Matrix<typename A::Scalar, rows, columns> result;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      result(i, j) = a(i, 0) * b(0, j);
      for (int k = 1; k < terms; ++k) result(i, j) += a(i, k) * b(k, j);
    }
  return result;
}

template <FixedSize V>
typename V::Scalar sum(const V& v) {
  typename V::Scalar result = v.coeff(0);
  for (int k = 1; k < V::SizeAtCompileTime; ++k) result += v.coeff(k);
  return result;
}

/// The product of all components.
template <FixedSize V>
typename V::Scalar prod(const V& v) {
  typename V::Scalar result = v.coeff(0);
  for (int k = 1; k < V::SizeAtCompileTime; ++k) result *= v.coeff(k);
  return result;
}

template <FixedSize U, FixedSize V>
typename U::Scalar dot(const U& u, const V& v) {
  return sum(u.cwiseProduct(v));
}

/// In the plane, angular velocities and changes of orientation are numbers; these overloads serve code for both
/// dimensions.
inline double dot(double u, double v) {
  return u * v;
}
inline double norm(double u) {
  return std::abs(u);
}

template <FixedSize V>
typename V::Scalar squared_norm(const V& v) {
  return sum(v.cwiseAbs2());
}

template <FixedSize V>
typename V::Scalar norm(const V& v) {
  using std::sqrt;
  return sqrt(squared_norm(v));
}

/// Returns v/|v|, or v itself if it is the zero vector.
template <FixedSize V>
typename V::PlainObject normalized(const V& v) {
  const typename V::PlainObject& plain = v;
  const typename V::Scalar length = norm(plain);
  return length > 0 ? typename V::PlainObject(plain / length) : plain;
}

/// The z component of the three-dimensional cross product: u × v = u_x v_y − u_y v_x.
inline double cross(const Vec2& u, const Vec2& v) {
  return u.x() * v.y() - u.y() * v.x();
}

inline Vec3 cross(const Vec3& u, const Vec3& v) {
  return u.cross(v);
}

/// The unit vector at `angle`.
inline Vec2 direction(double angle) {
  const auto [cosine, sine] = cosine_and_sine(angle);
  return {cosine, sine};
}

/// Returns u turned by +90°.
inline Vec2 perpendicular(const Vec2& u) {
  return {-u.y(), u.x()};
}

/// Returns det(m) m⁻¹.
inline Mat2 adjugate(const Mat2& m) {
  Mat2 result;
  result << m(1, 1), -m(0, 1), -m(1, 0), m(0, 0);
  return result;
}
inline Mat3 adjugate(const Mat3& m) {
  Mat3 result;
  for (int k = 0; k < 3; ++k) result.row(k) = m.col((k + 1) % 3).cross(m.col((k + 2) % 3));
  return result;
}

inline double determinant(const Mat2& m) {
  return cross(Vec2(m.col(0)), Vec2(m.col(1)));
}
inline double determinant(const Mat3& m) {
  return dot(m.col(0), m.col(1).cross(m.col(2)));
}

template <FixedSize M>
M inverse(const M& m) {
  return adjugate(m) / determinant(m);
}

template <class T>
Eigen::Quaternion<T> operator*(const Eigen::Quaternion<T>& p, const Eigen::Quaternion<T>& q) {
  return {p.w() * q.w() - p.x() * q.x() - p.y() * q.y() - p.z() * q.z(),
          p.w() * q.x() + p.x() * q.w() + p.y() * q.z() - p.z() * q.y(),
          p.w() * q.y() + p.y() * q.w() + p.z() * q.x() - p.x() * q.z(),
          p.w() * q.z() + p.z() * q.w() + p.x() * q.y() - p.y() * q.x()};
}

/// Returns v rotated by q.
template <class T, FixedSize V>
Eigen::Matrix<T, 3, 1> operator*(const Eigen::Quaternion<T>& q, const V& v) {
  const Eigen::Matrix<T, 3, 1> plain = v, twice = 2 * q.vec().cross(plain);
  return plain + q.w() * twice + q.vec().cross(twice);
}

inline double norm(const Quaternion& q) {
  return norm(q.coeffs());
}

inline Quaternion normalized(const Quaternion& q) {
  return Quaternion(normalized(q.coeffs()));
}

/// The matrix of the rotation q; its columns are the images of the unit vectors.
inline Mat3 rotation_matrix(const Quaternion& q) {
  const double x2 = 2 * q.x(), y2 = 2 * q.y(), z2 = 2 * q.z();
  const double xx = q.x() * x2, yy = q.y() * y2, zz = q.z() * z2;
  const double xy = q.x() * y2, xz = q.x() * z2, yz = q.y() * z2;
  const double wx = q.w() * x2, wy = q.w() * y2, wz = q.w() * z2;
  Mat3 m;
  m << 1 - (yy + zz), xy - wz, xz + wy, xy + wz, 1 - (xx + zz), yz - wx, xz - wy, yz + wx,
      1 - (xx + yy);
  return m;
}

/// Returns the unit quaternion of a rotation matrix. The largest of its components comes from the diagonal, so that
/// nothing is lost by cancellation (shepperd1978).
inline Quaternion quaternion_of(const Mat3& m) {
  const double trace = m(0, 0) + m(1, 1) + m(2, 2);
  if (trace > 0)
    return normalized(
        Quaternion(1 + trace, m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)));
  int i = 0;
  for (int k = 1; k < 3; ++k)
    if (m(k, k) > m(i, i)) i = k;
  const int j = (i + 1) % 3, k = (i + 2) % 3;
  Quaternion q;
  q.w() = m(k, j) - m(j, k);
  q.vec()[i] = 1 + m(i, i) - m(j, j) - m(k, k);
  q.vec()[j] = m(j, i) + m(i, j);
  q.vec()[k] = m(k, i) + m(i, k);
  return normalized(q);
}

}  // namespace vitrel

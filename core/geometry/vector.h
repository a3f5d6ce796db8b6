#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>

/// @file
/// Small fixed-size vectors. Lengths are in the program's unit of length (the reference species has
/// semi-axes a b = 1), whole box lengths are counted in `Shift`.
namespace vitrel {

template <int Dim>
using Vec = Eigen::Matrix<double, Dim, 1>;
using Vec2 = Vec<2>;
using Vec3 = Vec<3>;
using Mat2 = Eigen::Matrix2d;
using Mat3 = Eigen::Matrix3d;
/// A rotation, of norm 1 to rounding.
using Quaternion = Eigen::Quaterniond;

/// Whole box lengths per direction: the image of a particle at r lies at r + shift ∘ L.
template <int Dim>
using Shift = Eigen::Matrix<std::int32_t, Dim, 1>;

/// The z component of the three-dimensional cross product: u × v = u_x v_y − u_y v_x.
inline double cross(const Vec2& u, const Vec2& v) {
  return u.x() * v.y() - u.y() * v.x();
}

inline Vec3 cross(const Vec3& u, const Vec3& v) {
  return u.cross(v);
}

/// u turned by +90°.
inline Vec2 perpendicular(const Vec2& u) {
  return {-u.y(), u.x()};
}

}  // namespace vitrel

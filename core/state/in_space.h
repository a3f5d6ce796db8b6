#pragma once

#include "core/elementary.h"
#include "core/state/configuration.h"

/// @file
/// Particles of either dimension in the form that three-dimensional programs need: particles of the plane lie in the
/// plane z = 0.
namespace vitrel {

/// Returns a vector (coordinates, or numbers of boxes) in three dimensions; one of the plane gets z = 0.
template <class Vector>
Eigen::Matrix<typename Vector::Scalar, 3, 1> in_space(const Vector& vector) {
  Eigen::Matrix<typename Vector::Scalar, 3, 1> result;
  result.setZero();
  result.template head<Vector::SizeAtCompileTime>() = vector;
  return result;
}

inline Vec3 angular_velocity_in_space(double angular_velocity) {
  return {0, 0, angular_velocity};
}
inline const Vec3& angular_velocity_in_space(const Vec3& angular_velocity) {
  return angular_velocity;
}

inline Quaternion orientation_in_space(const Configuration2& configuration, std::size_t i) {
  const auto [cosine, sine] = cosine_and_sine(0.5 * configuration.angle[i]);
  return {cosine, 0, 0, sine};
}
inline const Quaternion& orientation_in_space(const Configuration3& configuration, std::size_t i) {
  return configuration.orientation[i];
}

/// A particle of the plane becomes as thick as its shorter axis, since programs that draw bodies in space do not accept
/// flat ones.
inline Vec3 half_lengths_in_space(const ParticleShape<2>& shape) {
  const Vec2 half = shape.half_lengths();
  return {half.x(), half.y(), half.y()};
}
inline const Vec3& half_lengths_in_space(const ParticleShape<3>& shape) {
  return shape.half_lengths();
}

}  // namespace vitrel

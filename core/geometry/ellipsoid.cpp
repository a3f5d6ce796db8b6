#include "core/geometry/ellipsoid.h"

namespace vitrel {

Vec3 Ellipsoid::full_inertia_per_mass() const {
  const Vec3 squares = semi_axes.cwiseAbs2();
  return 0.2 * (Vec3::Constant(sum(squares)) - squares);
}

Vec3 Ellipsoid::inertia_per_mass() const {
  const Vec3 moments = full_inertia_per_mass();
  const int axis = symmetry_axis();
  return axis == no_axis ? moments : Vec3::Constant(moments[(axis + 1) % 3]);
}

Vec3 half_extents(const Ellipsoid& ellipsoid, const Quaternion& orientation) {
  const Mat3 axes = rotation_matrix(orientation) * ellipsoid.semi_axes.asDiagonal();
  return {norm(Vec3(axes.row(0))), norm(Vec3(axes.row(1))), norm(Vec3(axes.row(2)))};
}

Mat3 shape_matrix(const Ellipsoid& ellipsoid, const Quaternion& orientation) {
  const Mat3 axes = rotation_matrix(orientation) * ellipsoid.semi_axes.asDiagonal();
  return axes * axes.transpose();
}

}  // namespace vitrel

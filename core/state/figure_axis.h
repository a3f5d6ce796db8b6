#pragma once

#include "core/elementary.h"
#include "core/state/configuration.h"

namespace vitrel {

/// Returns the unit vector w along which a body is oriented, with an arbitrary sign. For a spheroid it is the axis of
/// symmetry: the short axis of an oblate and the long axis of a prolate one. For a scalene body it is the longest axis,
/// which is a convention. The body must not be round.
inline Vec3 figure_axis(const ParticleShape<3>& body, const Quaternion& orientation) {
  int axis = body.symmetry_axis();
  if (axis == no_axis) body.half_lengths().maxCoeff(&axis);
  return orientation * Vec3::Unit(axis);
}

/// Returns how well particle i of one configuration and particle j of another are aligned: cos 2(θ_j − θ_i) in the
/// plane, P₂ of the cosine between their figure axes in space. The particles must not be round.
inline double alignment(const Configuration2& one, std::size_t i, const Configuration2& other,
                        std::size_t j) {
  return cosine_and_sine(2 * (other.angle[j] - one.angle[i])).cosine;
}
inline double alignment(const Configuration3& one, std::size_t i, const Configuration3& other,
                        std::size_t j) {
  const double cosine = dot(figure_axis(other.shape[j], other.orientation[j]),
                            figure_axis(one.shape[i], one.orientation[i]));
  return 1.5 * cosine * cosine - 0.5;
}

}  // namespace vitrel

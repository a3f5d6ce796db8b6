#pragma once

#include <type_traits>

#include "core/contact/ellipse_vieillard_baron.h"
#include "core/contact/ellipsoid_eta.h"
#include "core/extended.h"
#include "core/geometry/particle_shape.h"

/// @file
/// The overlap and the gap of two particles in extended arithmetic, for the exact check (check.h). The templates are
/// instantiated for long double and DoubleDouble.
namespace vitrel::exact {

template <int Dim, class Real = Extended>
using Point = Eigen::Matrix<Real, Dim, 1>;

template <int Dim, class Real = Extended>
struct Particle {
  Point<Dim, Real> centre;
  std::conditional_t<Dim == 2, EllipseAxes<Real>, EllipsoidAxes<Real>> axes;
  Real circumradius;
  bool is_round;
};

/// Returns the body at its pose; its position and semi-axes are converted without rounding.
template <class Real = Extended>
Particle<2, Real> particle(const Ellipse& shape, const Pose2& pose);
template <class Real = Extended>
Particle<3, Real> particle(const Ellipsoid& shape, const Pose3& pose);

template <class Real>
struct Finding {
  bool overlap;
  /// The distance between the surfaces, or minus the depth of the overlap (check.h). If it is at least `enough`, `gap`
  /// may be any number that is at least `enough`.
  Real gap;
};

/// Examines two particles, where d points from centre 1 to centre 2. This is fast for round bodies, and for bodies that
/// a separating axis in double precision proves to be more than `enough` apart.
template <int Dim, class Real>
Finding<Real> examine(const Particle<Dim, Real>& one, const Particle<Dim, Real>& two,
                      const std::type_identity_t<Point<Dim, Real>>& d,
                      std::type_identity_t<Real> enough);

}  // namespace vitrel::exact

#pragma once

#include <type_traits>

#include "core/contact/ellipse_vieillard_baron.h"
#include "core/contact/ellipsoid_eta.h"
#include "core/extended.h"
#include "core/geometry/particle_shape.h"

/// @file
/// Two particles in extended arithmetic, as the exact check (check.h) judges and measures them. Instantiated for long
/// double and DoubleDouble.
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

/// The body at its pose, unchanged.
template <class Real = Extended>
Particle<2, Real> particle(const Ellipse& shape, const Pose2& pose);
template <class Real = Extended>
Particle<3, Real> particle(const Ellipsoid& shape, const Pose3& pose);

template <class Real>
struct Finding {
  bool overlap;
  /// The distance of the surfaces, or minus the depth (check.h). If that is not below `enough`, any number
  /// that is not below it either.
  Real gap;
};

/// d from centre 1 to centre 2. Fast for round bodies, and for bodies that a separating axis in double
/// precision proves to be more than `enough` apart.
template <int Dim, class Real>
Finding<Real> examine(const Particle<Dim, Real>& one, const Particle<Dim, Real>& two,
                      const std::type_identity_t<Point<Dim, Real>>& d,
                      std::type_identity_t<Real> enough);

}  // namespace vitrel::exact

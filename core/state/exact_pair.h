#pragma once

#include <limits>
#include <type_traits>

#include "core/contact/ellipse_vieillard_baron.h"
#include "core/contact/ellipsoid_eta.h"
#include "core/state/configuration.h"

/// @file
/// Two particles in 80-bit arithmetic, as the exact check (check.h) judges and measures them.
namespace vitrel::exact {

using Real = long double;
static_assert(std::numeric_limits<Real>::digits >= 64, "the exact check needs 80-bit arithmetic");

template <int Dim>
using Point = Eigen::Matrix<Real, Dim, 1>;

template <int Dim>
struct Particle {
  Point<Dim> centre;
  std::conditional_t<Dim == 2, EllipseAxes<Real>, EllipsoidAxes<Real>> axes;
  Real circumradius;
};

/// The body at its pose, unchanged; particle i of a configuration.
Particle<2> particle(const Ellipse& shape, const Pose2& pose);
Particle<3> particle(const Ellipsoid& shape, const Pose3& pose);
Particle<2> particle(const Configuration2& configuration, std::size_t i);
Particle<3> particle(const Configuration3& configuration, std::size_t i);

struct Finding {
  bool overlap;
  /// The distance of the surfaces, or minus the depth (check.h). If that is not below `enough`, any number
  /// that is not below it either.
  Real gap;
};

/// d from centre 1 to centre 2. Fast for round bodies, and for bodies that a separating axis in double
/// precision proves to be more than `enough` apart.
Finding examine(const Particle<2>& one, const Particle<2>& two, const Point<2>& d, Real enough);
Finding examine(const Particle<3>& one, const Particle<3>& two, const Point<3>& d, Real enough);

}  // namespace vitrel::exact

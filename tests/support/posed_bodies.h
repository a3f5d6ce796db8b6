#pragma once

#include <ostream>

#include "core/geometry/particle_shape.h"
#include "core/geometry/pose.h"

namespace vitrel {

/// Two ellipses or ellipsoids are at rest, as tests of overlap ask about them. A turn is an angle
/// or a quaternion.
template <int Dim>
struct PosedBodies {
  ParticleShape<Dim> one, two;
  Orientation<Dim> turn1, turn2;
  Vec<Dim> d;  // from centre 1 to 2

  PosedBodies with(const Vec<Dim>& separation) const {
    return {one, two, turn1, turn2, separation};
  }
  PosedBodies swapped() const { return {two, one, turn2, turn1, -d}; }
  double extent() const { return one.circumradius() + two.circumradius(); }
  Pose<Dim> pose1() const { return {Vec<Dim>::Zero(), turn1}; }
  Pose<Dim> pose2() const { return {d, turn2}; }
};
using PosedPair = PosedBodies<2>;
using PosedSolids = PosedBodies<3>;

template <int Dim>
std::ostream& operator<<(std::ostream& out, const PosedBodies<Dim>& pair) {
  const auto print = [&](const ParticleShape<Dim>& shape, const Orientation<Dim>& turn) {
    out << "(" << shape.half_lengths().transpose() << ") turned by ";
    if constexpr (Dim == 2)
      out << turn << ", ";
    else
      out << "(" << turn.coeffs().transpose() << "), ";
  };
  out.precision(17);
  print(pair.one, pair.turn1);
  print(pair.two, pair.turn2);
  return out << "d = (" << pair.d.transpose() << ")";
}

}  // namespace vitrel

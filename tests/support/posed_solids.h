#pragma once

#include <ostream>

#include "core/geometry/ellipsoid.h"

/// Two ellipsoids at rest, as tests of overlap ask about them.
namespace vitrel {

struct PosedSolids {
  Ellipsoid one, two;
  Quaternion turn1, turn2;
  Vec3 d;  // from centre 1 to 2

  PosedSolids with(const Vec3& separation) const { return {one, two, turn1, turn2, separation}; }
  PosedSolids swapped() const { return {two, one, turn2, turn1, -d}; }
  double extent() const { return one.circumradius() + two.circumradius(); }
};

inline std::ostream& operator<<(std::ostream& out, const PosedSolids& pair) {
  out.precision(17);
  return out << "one (" << pair.one.semi_axes.transpose() << ") turned by ("
             << pair.turn1.coeffs().transpose() << "), two (" << pair.two.semi_axes.transpose()
             << ") turned by (" << pair.turn2.coeffs().transpose() << "), d = ("
             << pair.d.transpose() << ")";
}

}  // namespace vitrel

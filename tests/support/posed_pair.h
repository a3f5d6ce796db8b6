#pragma once

#include <ostream>

#include "core/geometry/ellipse.h"
#include "core/geometry/vector.h"

/// Two ellipses at rest, as tests of overlap ask about them.
namespace vitrel {

struct PosedPair {
  Ellipse one, two;
  double angle1, angle2;
  Vec2 d;  // from centre 1 to 2

  PosedPair with(const Vec2& separation) const { return {one, two, angle1, angle2, separation}; }
  PosedPair swapped() const { return {two, one, angle2, angle1, -d}; }
};

inline std::ostream& operator<<(std::ostream& out, const PosedPair& pair) {
  out.precision(17);
  return out << "one (" << pair.one.a << ", " << pair.one.b << ") at angle " << pair.angle1
             << ", two (" << pair.two.a << ", " << pair.two.b << ") at angle " << pair.angle2
             << ", d = (" << pair.d.x() << ", " << pair.d.y() << ")";
}

}  // namespace vitrel

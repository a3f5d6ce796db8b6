#pragma once

#include <Eigen/Core>

#include "core/geometry/growing_ellipse.h"

namespace vitrel {

/// A number for each of the two bodies of a pair; arithmetic on both is one instruction.
using Lanes = Eigen::Array2d;

constexpr double largest_small_angle = 1.5;

/// Unit vectors (x, y) at two angles: cosine and sine to within 4 units in the last place of 1.
void directions(const Lanes& angle, Lanes& x, Lanes& y);
/// The same for |angle| ≤ largest_small_angle.
void small_directions(const Lanes& angle, Lanes& x, Lanes& y);

/// Two ellipses at one instant, in the form that the support gap computes with. Lane 0 is body 1.
struct EllipsePair {
  Lanes bb;       ///< b²
  Lanes stretch;  ///< a² − b²
  Lanes aabb;     ///< a²b²
  Lanes size;     ///< by which a and b are multiplied
  Lanes ux, uy;   ///< unit vectors along the major axes
  Vec2 d;         ///< from centre 1 to centre 2

  EllipsePair() = default;
  EllipsePair(const Ellipse& one, const Vec2& u1, const Ellipse& two, const Vec2& u2,
              const Vec2& centre_to_centre)
      : bb(one.b * one.b, two.b * two.b),
        stretch(one.stretch(), two.stretch()),
        aabb(one.a * one.a * bb[0], two.a * two.a * bb[1]),
        size(1, 1),
        ux(u1.x(), u2.x()),
        uy(u1.y(), u2.y()),
        d(centre_to_centre) {}
};

/// The support gap g = n·d − σ₁h₁ − σ₂h₂ at a unit vector n, σ the sizes, with what its change
/// needs. φ is the angle of n; h, h' = dh/dφ and ρ are those at size 1.
struct GapAlongAxis {
  double gap = 0;
  double slope = 0;      ///< dg/dφ
  double curvature = 0;  ///< −d²g/dφ² = g + σ₁ρ₁ + σ₂ρ₂
  Lanes along, across;   ///< u·n and u·dn/dφ
  Lanes height;          ///< h
  Lanes turning;         ///< h'
  Lanes radius;          ///< ρ = h + h'', the radius of curvature where n is the normal

  /// What one Newton step in φ would add to g, to second order (only meaningful if curvature > 0).
  double gain() const { return 0.5 * slope * slope / curvature; }
};

inline GapAlongAxis gap_along(const EllipsePair& pair, const Vec2& n) {
  GapAlongAxis g;
  g.along = n.x() * pair.ux + n.y() * pair.uy;
  g.across = n.x() * pair.uy - n.y() * pair.ux;
  const Lanes hh = pair.bb + pair.stretch * g.along.square();
  g.height = hh.sqrt();
  const Lanes inverse = 1 / g.height;
  g.turning = pair.stretch * g.along * g.across * inverse;
  g.radius = pair.aabb * inverse / hh;
  g.gap = n.dot(pair.d) - (pair.size * g.height).sum();
  g.slope = cross(n, pair.d) - (pair.size * g.turning).sum();
  g.curvature = g.gap + (pair.size * g.radius).sum();
  return g;
}

}  // namespace vitrel

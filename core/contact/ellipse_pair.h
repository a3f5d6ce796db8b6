#pragma once

#include <Eigen/Core>

#include "core/geometry/growing_ellipse.h"

namespace vitrel {

/// A number for each of the two bodies of a pair; arithmetic on both is one instruction.
using Lanes = Eigen::Array2d;

namespace detail {

// The series of sine and cosine for |x| ≤ π/2, to 2e-17, in parts that need not wait for each other
// (Estrin's scheme). xx = x².
inline Lanes sine_series(const Lanes& x, const Lanes& xx) {
  const Lanes x4 = xx * xx;
  const Lanes part1 = 1. / 120 * xx - 1. / 6;
  const Lanes part2 = 1. / 362880 * xx - 1. / 5040;
  const Lanes part3 = 1. / 6227020800 * xx - 1. / 39916800;
  const Lanes part4 = 1. / 355687428096000 * xx - 1. / 1307674368000;
  const Lanes part5 = 1. / 51090942171709440000. * xx - 1. / 121645100408832000;
  const Lanes x8 = x4 * x4;
  return x + x * xx * ((part1 + x4 * part2) + x8 * ((part3 + x4 * part4) + x8 * part5));
}

inline Lanes cosine_series(const Lanes& xx) {
  const Lanes x4 = xx * xx;
  const Lanes part1 = 1. / 24 - 1. / 720 * xx;
  const Lanes part2 = 1. / 40320 - 1. / 3628800 * xx;
  const Lanes part3 = 1. / 479001600 - 1. / 87178291200 * xx;
  const Lanes part4 = 1. / 20922789888000 - 1. / 6402373705728000 * xx;
  const Lanes x8 = x4 * x4;
  const Lanes part5 = x8 * (1. / 2432902008176640000);
  return (1 - 0.5 * xx) + x4 * ((part1 + x4 * part2) + x8 * ((part3 + x4 * part4) + part5));
}

/// The same as directions, by the library: for angles of which a multiple of π is no longer taken
/// off exactly.
void far_directions(const Lanes& angle, Lanes& x, Lanes& y);
constexpr double far_angle = 1e6;

}  // namespace detail

/// Unit vectors (x, y) at two angles: cosine and sine to within 4 units in the last place of 1.
inline void directions(const Lanes& angle, Lanes& x, Lanes& y) {
  if (!(angle.abs().maxCoeff() < detail::far_angle)) return detail::far_directions(angle, x, y);
  // Adding and subtracting this rounds to a whole number. π is taken off in three parts; a multiple
  // of the first is exact.
  constexpr double rounder = 0x1.8p52;
  constexpr double pi_high = 0x1.921fb544p1;
  constexpr double pi_middle = 0x1.0b4611a6p-33;
  constexpr double pi_low = 0x1.3198a2e037073p-68;
  const Lanes k = (angle * 0.31830988618379067154 + rounder) - rounder;
  const Lanes rest = ((angle - k * pi_high) - k * pi_middle) - k * pi_low;
  const Lanes half = (0.5 * k + rounder) - rounder;
  const Lanes sign = 1 - 2 * (k - 2 * half).abs();
  const Lanes square = rest * rest;
  x = sign * detail::cosine_series(square);
  y = sign * detail::sine_series(rest, square);
}

constexpr double largest_small_angle = 1.5;

/// The same for |angle| ≤ largest_small_angle.
inline void small_directions(const Lanes& angle, Lanes& x, Lanes& y) {
  const Lanes square = angle * angle;
  x = detail::cosine_series(square);
  y = detail::sine_series(angle, square);
}

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
  Lanes inverse_square;  ///< 1/h²
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
  g.inverse_square = 1 / hh;  // beside the root, not after it
  const Lanes inverse = g.height * g.inverse_square;
  g.turning = pair.stretch * g.along * g.across * inverse;
  g.radius = pair.aabb * g.inverse_square * inverse;
  g.gap = n.dot(pair.d) - (pair.size * g.height).sum();
  g.slope = cross(n, pair.d) - (pair.size * g.turning).sum();
  g.curvature = g.gap + (pair.size * g.radius).sum();
  return g;
}

}  // namespace vitrel

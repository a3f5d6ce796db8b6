#pragma once

#include "core/contact/simd.h"
#include "core/geometry/growing.h"

namespace vitrel {

/// Two ellipses at one instant, in the form that the support gap uses. Element 0 belongs to body 1.
struct EllipsePair {
  SimdPair bb;           ///< b²
  SimdPair aa_minus_bb;  ///< a² − b²
  SimdPair aabb;         ///< a²b²
  SimdPair size;         ///< factor of a and b
  SimdPair ux, uy;       ///< unit vectors along the major axes
  Vec2 d;                ///< from centre 1 to centre 2

  EllipsePair() = default;
  EllipsePair(const Ellipse& one, const Vec2& u1, const Ellipse& two, const Vec2& u2,
              const Vec2& centre_to_centre)
      : bb(one.b * one.b, two.b * two.b),
        aa_minus_bb(one.aa_minus_bb(), two.aa_minus_bb()),
        aabb(one.a * one.a * bb[0], two.a * two.a * bb[1]),
        size(1, 1),
        ux(u1.x(), u2.x()),
        uy(u1.y(), u2.y()),
        d(centre_to_centre) {}
};

/// The support function h of an ellipse with major axis u at the angle φ of a unit vector n, and its derivatives.
/// T holds the two bodies of a pair, or one body of each pair of a batch.
template <class T>
struct SupportAlong {
  T along, across;   ///< u·n and u·dn/dφ
  T height;          ///< h
  T inverse_square;  ///< 1/h²
  T turning;         ///< h' = dh/dφ
  T radius;          ///< ρ = h + h'', the radius of curvature where n is the normal
};

template <class T>
VITREL_INLINE SupportAlong<T> support_along(const T& bb, const T& aa_minus_bb, const T& aabb,
                                            const T& ux, const T& uy, const T& nx, const T& ny) {
  SupportAlong<T> s;
  s.along = nx * ux + ny * uy;
  s.across = nx * uy - ny * ux;
  const T hh = bb + aa_minus_bb * (s.along * s.along);
  s.height = sqrt(hh);
  s.inverse_square = 1. / hh;  // does not wait for the square root
  const T inverse = s.height * s.inverse_square;
  s.turning = aa_minus_bb * s.along * s.across * inverse;
  s.radius = aabb * s.inverse_square * inverse;
  return s;
}

/// Returns a bound K ω² of d²h/dt² while a body rotates at angular velocity ω for `duration`, which may be negative
/// (backwards). `s` is evaluated at the present n, and `largest` = ω² (a² − b²)/b.
///
/// The body rotates by Δ = ω t, and |u·n| changes from p = |u·n| with the initial slope r = −ω (u·dn/dφ) sgn(u·n). From
/// cos Δ ≥ 1 − Δ²/2 and, where it is positive, 0 ≤ sin |Δ| ≤ |Δ|, it follows that
///
///     |u·n| ≥ max(0, p (1 − Δ²/2) + min(0, r t)),
///
/// which bounds h² = b² + (a² − b²)(u·n)² from below. Let q be the ratio of this bound to the present h². Then
/// ρ = a²b²/h³ rises to at most q^(−3/2) ρ ≤ ρ/q², and h falls to at least q^(1/2) h ≥ q h, so that
///
///     h'' ≤ K = min(ρ/q² − q h, (a² − b²)/b),
///
/// where (a² − b²)/b is the global maximum of h''. K may be negative.
template <class T>
VITREL_INLINE T support_acceleration_bound(const SupportAlong<T>& s, const T& bb,
                                           const T& aa_minus_bb, const T& omega, const T& largest,
                                           const T& duration) {
  const T present = abs(s.along);
  const T slope = -omega * s.across * detail::signs(s.along);
  const T rotation = omega * duration;
  const T falling = detail::positive_part(-slope * duration);
  const T min_along =
      detail::positive_part((present - present * (0.5 * rotation * rotation)) - falling);
  const T q = (bb + aa_minus_bb * (min_along * min_along)) * s.inverse_square;
  const T rise = 1. / q;
  return min(omega * omega * (s.radius * (rise * rise) - s.height * q), largest);
}

/// The support gap g = n·d − σ₁h₁ − σ₂h₂ at a unit vector n, where σ are the sizes and φ is the angle of n; h, h' and ρ
/// are those at size 1.
struct GapAlongAxis : SupportAlong<SimdPair> {
  double gap = 0;
  double slope = 0;      ///< dg/dφ
  double curvature = 0;  ///< −d²g/dφ² = g + σ₁ρ₁ + σ₂ρ₂

  bool is_concave() const { return curvature > 0; }
  /// The Newton step in φ to the maximum.
  double newton() const { return slope / curvature; }
  /// The gain in g of the Newton step, to second order (meaningful only if g is concave).
  double gain() const { return 0.5 * slope * slope / curvature; }
  /// det C and (det C) C⁻¹ t, where C is the curvature as a 1 × 1 matrix.
  double determinant() const { return curvature; }
  double adjugate(double t) const { return t; }
};

/// `sized` says whether the sizes may differ from 1.
template <bool sized = true>
VITREL_INLINE GapAlongAxis gap_along(const EllipsePair& pair, const Vec2& n) {
  const auto total = [&](const SimdPair& of) {
    if constexpr (sized) return reduce(pair.size * of);
    return reduce(of);
  };
  GapAlongAxis g;
  static_cast<SupportAlong<SimdPair>&>(g) =
      support_along<SimdPair>(pair.bb, pair.aa_minus_bb, pair.aabb, pair.ux, pair.uy, n.x(), n.y());
  g.gap = dot(n, pair.d) - total(g.height);
  g.slope = cross(n, pair.d) - total(g.turning);
  g.curvature = g.gap + total(g.radius);
  return g;
}

}  // namespace vitrel

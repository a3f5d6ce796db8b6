#pragma once

#include "core/contact/ellipsoid_pair.h"

/// The support gap of two ellipsoids, as that of ellipses (support_gap.h): for a unit vector n,
/// g(n) = n·d − h₁(n) − h₂(n) with h(n) = √(nᵀΣn). If g(n) > 0, n separates them, whatever n is; max g is
/// their distance, attained at the normal of the closest points.
///
/// The directions with g > 0 form a convex cone, on which g along great circles is strictly concave:
/// Newton's method on the sphere converges quadratically to the one maximum. A start comes from the
/// function of Perram and Wertheim (1985), F(λ) = λ(1−λ) dᵀC⁻¹d with C = (1−λ)Σ₁ + λΣ₂ and w = C⁻¹d:
/// F > 1 makes w a separating direction, and
///     dF/dλ = (1−λ)² wᵀΣ₁w − λ² wᵀΣ₂w,
/// so that at the maximum λ : 1−λ = h₁(w) : h₂(w).
namespace vitrel {

struct SupportGap3 {
  double gap;   ///< the distance if positive; otherwise only its sign counts (overlap or touching)
  Vec3 normal;  ///< as in SupportGap
};

/// The largest support gap, to rounding; d from centre 1 to centre 2.
SupportGap3 support_gap(const Ellipsoid& one, const Quaternion& orientation1, const Ellipsoid& two,
                        const Quaternion& orientation2, const Vec3& d);

/// True exactly if an axis with g ≥ margin exists (margin ≥ 0; to rounding): the surfaces are at
/// least `margin` apart. Decides as soon as any axis proves it, spheres first.
bool separated(const Ellipsoid& one, const Quaternion& orientation1, const Ellipsoid& two,
               const Quaternion& orientation2, const Vec3& d, double margin);

/// The surface point with outward unit normal n, relative to the centre.
Vec3 surface_point(const Ellipsoid& body, const Quaternion& orientation, const Vec3& n);

namespace detail {

/// The axis turned by a step in its tangent plane.
inline Axis3 turned(const Axis3& axis, const Tangent& step) {
  const double q = 0.5 * step.norm();
  const double scale = 1 / (1 + q * q);
  const Vec3 n = (1 - q * q) * scale * vector(axis.n) +
                 scale * (step[0] * vector(axis.e1) + step[1] * vector(axis.e2));
  return completed(components(n));
}

inline Tangent clamped(const Tangent& step, double longest) {
  const double length = step.norm();
  return length <= longest ? step : Tangent(longest / length * step);
}

/// C(λ)⁻¹d at λ : 1 − λ as the radii along d.
Axis3 initial_axis(const EllipsoidPair& pair);

/// C(λ)⁻¹d on the ascent of F(λ) from there: the first that separates, or, of an overlapping pair, that
/// of the largest F: the common normal of the ellipsoids scaled to touch.
struct SeparatingAxis3 {
  Axis3 n;
  bool separates;
};
SeparatingAxis3 find_separating_axis(const EllipsoidPair& pair);

/// One damped Newton step of n towards the maximum of g; `here` is gap_along at n on entry and at the
/// new n on return. False (and nothing changed) if no step improves g.
bool improve_axis(const EllipsoidPair& pair, Axis3& n, GapAlongAxis3& here);

/// Newton's method on ∇g = 0 from an axis that is optimal as far as g can tell, which is good to √ε
/// only; the slope makes it good to ε.
void polish_axis(const EllipsoidPair& pair, Axis3& n, const GapAlongAxis3& here);

}  // namespace detail
}  // namespace vitrel

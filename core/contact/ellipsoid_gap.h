#pragma once

#include "core/contact/ellipsoid_pair.h"

/// @file
/// The support gap of two ellipsoids, as of ellipses (ellipse_gap.h): for a unit vector n,
/// g(n) = n·d − h₁(n) − h₂(n) with h(n) = √(nᵀΣn). If g(n) > 0, n separates the ellipsoids. max g is their distance,
/// attained at the normal of the closest points.
///
/// The directions with g > 0 form a convex cone, on which g is strictly concave along great circles: Newton's
/// method on the sphere converges quadratically to the only maximum. The Perram–Wertheim function (1985),
/// F(λ) = λ(1−λ) dᵀC⁻¹d with C = (1−λ)Σ₁ + λΣ₂ and w = C⁻¹d, gives a start: where F > 1, w separates, and
///
///     dF/dλ = (1−λ)² wᵀΣ₁w − λ² wᵀΣ₂w,
///
/// so that at the maximum λ : 1−λ = h₁(w) : h₂(w).
namespace vitrel {

struct SupportGap3 {
  double
      gap;  ///< the distance if positive; otherwise the bodies touch or overlap, and only the sign counts
  Vec3 normal;  ///< as in SupportGap
};

/// The largest support gap, to rounding; d from centre 1 to centre 2.
SupportGap3 support_gap(const Ellipsoid& one, const Quaternion& orientation1, const Ellipsoid& two,
                        const Quaternion& orientation2, const Vec3& d);

/// True if and only if an axis with g ≥ margin exists (margin ≥ 0; to rounding): the surfaces are at least
/// `margin` apart. Returns as soon as one axis proves it; tests the spheres first.
bool separated(const Ellipsoid& one, const Quaternion& orientation1, const Ellipsoid& two,
               const Quaternion& orientation2, const Vec3& d, double margin);

/// The surface point with outward unit normal n, relative to the centre.
Vec3 surface_point(const Ellipsoid& body, const Quaternion& orientation, const Vec3& n);

namespace detail {

/// The axis rotated by a step in its tangent plane.
inline Axis3 turned(const Axis3& axis, const Tangent& step) {
  const double q = 0.5 * norm(step);
  const double scale = 1 / (1 + q * q);
  const Vec3 n = (1 - q * q) * scale * vector(axis.n) +
                 scale * (step[0] * vector(axis.e1) + step[1] * vector(axis.e2));
  return completed(components(n));
}

inline Tangent clamped(const Tangent& step, double longest) {
  const double length = norm(step);
  return length <= longest ? step : Tangent(longest / length * step);
}

/// C(λ)⁻¹d with λ : 1 − λ in the ratio of the radii along d.
Axis3 initial_axis(const EllipsoidPair& pair);

/// The first separating axis C(λ)⁻¹d found while maximising F(λ) from there; for an overlapping pair the axis at
/// the maximum of F, which is the common normal of the ellipsoids scaled to touch.
struct SeparatingAxis3 {
  Axis3 n;
  bool separates;
};
SeparatingAxis3 find_separating_axis(const EllipsoidPair& pair);

/// One damped Newton step of n towards the maximum of g. `here` is gap_along at n, before and after. Returns
/// false, and changes nothing, if no step improves g.
bool improve_axis(const EllipsoidPair& pair, Axis3& n, GapAlongAxis3& here);

/// Newton iteration on ∇g = 0 from an axis that maximises g to rounding, which is accurate to √ε only; the
/// gradient makes it accurate to ε.
void polish_axis(const EllipsoidPair& pair, Axis3& n, const GapAlongAxis3& here);

}  // namespace detail
}  // namespace vitrel

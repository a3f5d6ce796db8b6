#pragma once

#include "core/contact/gap_search.h"

/// @file
/// The support gap of two ellipsoids, defined as for ellipses (ellipse_gap.h): for a unit vector n,
/// g(n) = n·d − h₁(n) − h₂(n) with h(n) = √(nᵀΣn). If g(n) > 0, n separates the ellipsoids. Then max g is their
/// distance, attained at the normal of the closest points.
///
/// The directions with g > 0 form a convex cone, on which g is strictly concave along great circles: Newton's
/// method on the sphere converges quadratically to the only maximum. The Perram–Wertheim function (1985),
/// F(λ) = λ(1−λ) dᵀC⁻¹d with C = (1−λ)Σ₁ + λΣ₂ and w = C⁻¹d, gives a starting point: where F > 1, w separates, and
///
///     dF/dλ = (1−λ)² wᵀΣ₁w − λ² wᵀΣ₂w,
///
/// so that at the maximum λ : 1−λ = h₁(w) : h₂(w).
namespace vitrel {

/// Returns the largest support gap, to rounding; d points from centre 1 to centre 2.
SupportGap3 support_gap(const Ellipsoid& one, const Quaternion& orientation1, const Ellipsoid& two,
                        const Quaternion& orientation2, const Vec3& d);

/// Returns true if and only if, to rounding, an axis with g ≥ margin exists (margin ≥ 0), which means that the surfaces
/// are at least `margin` apart. Tests the spheres first, and returns as soon as one axis proves the separation.
bool separated(const Ellipsoid& one, const Quaternion& orientation1, const Ellipsoid& two,
               const Quaternion& orientation2, const Vec3& d, double margin);

/// The surface point with outward unit normal n, relative to the centre.
Vec3 surface_point(const Ellipsoid& body, const Quaternion& orientation, const Vec3& n);

}  // namespace vitrel

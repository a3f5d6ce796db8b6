#pragma once

#include <cmath>

#include "core/contact/gap_search.h"

/// @file
/// The support gap of two ellipses. For a unit vector n, g(n) = n·d − h₁(n) − h₂(n) with the support functions
/// h(n) = √(b² + (a² − b²)(u·n)²), where u points along the major axis and d from centre 1 to centre 2. If g(n) > 0, n
/// separates the ellipses. Then max g is their distance, attained at the normal of the closest points.
///
/// As a function of the angle φ of n, g'' = −(g + ρ₁ + ρ₂), where ρ = a²b²/h³ is the radius of curvature at the point
/// with normal n. On the arc with g > 0, g is strictly concave, and Newton's method in φ converges quadratically to the
/// only maximum. The Perram–Wertheim function (1985), F(λ) = λ(1−λ) dᵀC⁻¹d with C = (1−λ)Σ₁ + λΣ₂, gives a starting
/// point on this arc: where F(λ) > 1, the direction C⁻¹d separates the ellipses (Cauchy–Schwarz), and max F > 1 exactly
/// for disjoint ellipses.
namespace vitrel {

/// Returns the support function, along the unit vector n, of an ellipse with unit major axis u.
inline double support(const Ellipse& ellipse, const Vec2& u, const Vec2& n) {
  const double along = dot(u, n);
  return std::sqrt(ellipse.b * ellipse.b + ellipse.aa_minus_bb() * along * along);
}

/// Returns the largest support gap, to rounding, for ellipses with unit major axes u1 and u2.
SupportGap support_gap(const Ellipse& one, const Vec2& u1, const Ellipse& two, const Vec2& u2,
                       const Vec2& d);
/// Returns the largest support gap for ellipses whose major axes have the given angles.
SupportGap support_gap(const Ellipse& one, double angle1, const Ellipse& two, double angle2,
                       const Vec2& d);

/// Returns true if and only if, to rounding, an axis with g ≥ margin exists (margin ≥ 0), which means that the surfaces
/// are at least `margin` apart. Tests the circles first, and returns as soon as one axis proves the separation.
bool separated(const Ellipse& one, const Vec2& u1, const Ellipse& two, const Vec2& u2,
               const Vec2& d, double margin);

/// The point of an ellipse's surface with outward unit normal n, relative to its centre.
inline Vec2 surface_point(const Ellipse& ellipse, const Vec2& u, const Vec2& n) {
  const Vec2 sigma_n = ellipse.b * ellipse.b * n + ellipse.aa_minus_bb() * dot(u, n) * u;
  return sigma_n / support(ellipse, u, n);
}

}  // namespace vitrel

#pragma once

#include "bench/methods/collision_case.h"
#include "core/contact/first_contact.h"

namespace vitrel::bench {

/// Where ellipse 1 is made the unit circle about the origin, by x̄ = T (x − r₁), T = diag(1/a₁, 1/b₁)
/// R(θ₁)ᵀ, ellipse 2 is the image {c + M w : |w| ≤ 1}, c = T d, M = T R(θ₂) diag(a₂, b₂).
struct ClosestPoint {
  /// Distance of ellipse 2 from the origin; if the origin lies inside, minus that of its boundary. The
  /// ellipses overlap iff it is below 1.
  double distance;
  Vec2 point;  ///< the closest point of the boundary, in the transformed coordinates
};

/// Closest point to the origin by an eigenvalue problem.
///
/// The extremes of |c + M w|² on |w| = 1 satisfy (S − μ) w = −g with S = MᵀM, g = Mᵀc and a multiplier
/// μ, and |(S − μ)⁻¹ g| = 1. With z = (S − μ)⁻² g, gᵀz = 1, this is the quadratic eigenvalue problem
///     (S − μ)² z = g gᵀ z,
/// which u = (S − μ) z/|g| turns into a linear one of twice the size, with ĝ = g/|g|:
///     ⎛   S      −|g| I ⎞ ⎛z⎞     ⎛z⎞
///     ⎝ −|g| ĝĝᵀ    S    ⎠ ⎝u⎠ = μ ⎝u⎠
/// The smallest μ belongs to the minimum (gander1989), and it has the smallest real part of all: for complex μ with a smaller real part, |Σ gᵢ²/(λᵢ − μ)²| < 1 in the eigenbasis of
/// S. Rounding that makes a complex pair of a double root therefore does no harm. In that basis wᵢ =
/// −gᵢ/(λᵢ − μ); should a denominator vanish (the origin on an axis of the ellipse), |w| = 1 gives that
/// component. Sources: woetzel2012, section 3.2.2; gander1989.
ClosestPoint closest_to_origin(const Vec2& c, const Mat2& m);

/// The root of the distance minus 1 (figure 3.11 of the thesis): scan of the bracket in steps of
/// `tolerance` times its length (usual 1/100), then algorithm 748 to double precision. The distance
/// comes from eigenvalues, good to about 1e-15 of the square of the largest of |c|, |M|. A contact
/// shorter than a step can be missed. The normal is Tᵀ times the closest point.
Prediction2 unit_circle(const CollisionCase& asked, double tolerance);

}  // namespace vitrel::bench

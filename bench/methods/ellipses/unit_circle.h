#pragma once

#include "bench/methods/collision_case.h"
#include "core/contact/first_contact.h"

namespace vitrel::bench {

/// The map x̄ = T (x − r₁), T = diag(1/a₁, 1/b₁) R(θ₁)ᵀ, turns ellipse 1 into the unit circle about the origin and
/// ellipse 2 into the set {c + M w : |w| ≤ 1} with c = T d and M = T R(θ₂) diag(a₂, b₂).
struct ClosestPoint {
  /// The distance of ellipse 2 from the origin or, if it contains the origin, minus that to its boundary. The
  /// ellipses overlap if and only if it is below 1.
  double distance;
  Vec2 point;  ///< the closest point of the boundary, in the transformed coordinates
};

/// Finds the point closest to the origin by an eigenvalue problem.
///
/// The extremes of |c + M w|² on |w| = 1 satisfy (S − μ) w = −g with S = MᵀM, g = Mᵀc and a multiplier
/// μ, and |(S − μ)⁻¹ g| = 1. With z = (S − μ)⁻² g, gᵀz = 1, this is the quadratic eigenvalue problem
///     (S − μ)² z = g gᵀ z,
/// and u = (S − μ) z/|g| turns it into a linear one of twice the size, with ĝ = g/|g|:
///     ⎛   S      −|g| I ⎞ ⎛z⎞     ⎛z⎞
///     ⎝ −|g| ĝĝᵀ    S    ⎠ ⎝u⎠ = μ ⎝u⎠
/// The smallest μ belongs to the minimum (gander1989), and it has the smallest real part of all eigenvalues: for a
/// complex μ with a smaller real part, |Σ gᵢ²/(λᵢ − μ)²| < 1 in the eigenbasis of S. Rounding that turns a double
/// root into a complex pair therefore does no harm. In that basis wᵢ = −gᵢ/(λᵢ − μ); if a denominator vanishes (the
/// origin lies on an axis of the ellipse), |w| = 1 gives that component. Sources: woetzel2012, section 3.2.2;
/// gander1989.
ClosestPoint closest_to_origin(const Vec2& c, const Mat2& m);

/// The root of the distance minus 1 (figure 3.11 of the thesis). The bracket is scanned in steps of `tolerance` times
/// its length (usually 1/100), then algorithm 748 refines the root to double precision. The distance comes from
/// eigenvalues and is accurate to about 1e-15 of the square of the largest of |c| and |M|. A contact shorter than a
/// step can be missed. The normal is Tᵀ times the closest point.
Prediction2 unit_circle(const CollisionCase& asked, double tolerance);

}  // namespace vitrel::bench

#pragma once

#include "core/geometry/ellipse.h"
#include "core/geometry/ellipsoid.h"

/// The contact function of Perram and Wertheim (1985) for two ellipses or ellipsoids:
///
///     F(λ) = λ(1−λ) dᵀ C(λ)⁻¹ d,   C(λ) = (1−λ)Σ₁ + λΣ₂,   0 < λ < 1,
///
/// d from centre 1 to centre 2. F is concave; its maximum is μ², where μ is the factor by which
/// both bodies must be scaled about their centres to touch from outside. Disjoint iff F > 1.
///
/// At the maximum t = λ/(1−λ) = h₁(n)/h₂(n), the ratio of the support functions along the common normal
/// n; the bounds of this ratio bracket it, and d ln F/d ln t falls from positive to negative through its
/// only root, which Newton's method in ln t finds, safeguarded by the bracket.
///
/// Ellipses: with Dᵢ = aᵢ²bᵢ², pᵢ = dᵀ adj(Σᵢ) d and m = tr(Σ₁ adj Σ₂), all sums of
/// positive terms,
///     F = t (p₁ + p₂t) / ((1 + t)(D₁ + m t + D₂t²)).
/// F is good to about 10 κ ε, that is, the surfaces' distance to 10 κ ε (a₁ + a₂).
///
/// Ellipsoids: with y = (Σ₁ + tΣ₂)⁻¹d, hᵢ² = yᵀΣᵢy and e = yᵀΣ₂(Σ₁ + tΣ₂)⁻¹Σ₂y,
///     d ln F/d ln t = (h₁² − t²h₂²)/((1 + t) d·y),   d·y = h₁² + t h₂²,
///     −d² ln F/d(ln t)² = t/(1 + t)² + w − 2t²e/d·y + w²,   w = t h₂²/d·y.
/// Finally F = (n·d/(h₁(n) + h₂(n)))², which is the largest over all unit vectors n, so that an error of
/// n counts only squared: F, that is, the surfaces' distance, is good to some ε (a₁ + a₂), a the longest
/// semi-axes.
/// Source: perram1985.
namespace vitrel {

template <int Dim>
struct PerramWertheim {
  double value;     ///< max F = μ²
  double lambda;    ///< where F is largest
  Vec<Dim> normal;  ///< unit vector from 1 to 2, common normal of the bodies scaled by μ
  Vec<Dim> point;   ///< where these touch, relative to centre 1; the contact point if F = 1

  bool disjoint() const { return value > 1; }
};

/// Coinciding centres single out no normal: then value is 0, normal along x and point 0.
PerramWertheim<2> perram_wertheim(const Ellipse& one, double angle1, const Ellipse& two,
                                  double angle2, const Vec2& d);
PerramWertheim<3> perram_wertheim(const Ellipsoid& one, const Quaternion& orientation1,
                                  const Ellipsoid& two, const Quaternion& orientation2,
                                  const Vec3& d);

/// The distance of the centres at which the bodies touch when centre 2 lies along `direction`
/// (any length but 0) from centre 1. Scaling both by μ is the same as scaling d by 1/μ, so
/// it is |d|/√F for whatever d along the direction.
double contact_distance(const Ellipse& one, double angle1, const Ellipse& two, double angle2,
                        const Vec2& direction);
double contact_distance(const Ellipsoid& one, const Quaternion& orientation1, const Ellipsoid& two,
                        const Quaternion& orientation2, const Vec3& direction);

}  // namespace vitrel

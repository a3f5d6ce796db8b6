#pragma once

#include "core/geometry/ellipse.h"
#include "core/geometry/ellipsoid.h"

/// @file
/// The contact function of Perram and Wertheim (1985) for two ellipses or ellipsoids:
///
///     F(λ) = λ(1−λ) dᵀ C(λ)⁻¹ d,   C(λ) = (1−λ)Σ₁ + λΣ₂,   0 < λ < 1,
///
/// where d points from centre 1 to centre 2. F is concave. Its maximum is μ², where μ is the factor by which both
/// bodies must be scaled about their centres to touch from outside. The bodies are disjoint if and only if this maximum
/// exceeds 1.
///
/// At the maximum, t = λ/(1−λ) = h₁(n)/h₂(n) is the ratio of the support functions along the common normal n. The
/// bounds of this ratio bracket the maximum, and d ln F/d ln t falls from positive to negative through its only root;
/// bracketed Newton iteration in ln t finds it.
///
/// For ellipses, Dᵢ = aᵢ²bᵢ², pᵢ = dᵀ adj(Σᵢ) d and m = tr(Σ₁ adj Σ₂) are sums of positive terms, and
///
///     F = t (p₁ + p₂t) / ((1 + t)(D₁ + m t + D₂t²)).
///
/// F is accurate to about 10 κ ε, that is, the distance of the surfaces to 10 κ ε (a₁ + a₂).
///
/// For ellipsoids, with y = (Σ₁ + tΣ₂)⁻¹d, hᵢ² = yᵀΣᵢy and e = yᵀΣ₂(Σ₁ + tΣ₂)⁻¹Σ₂y,
///
///     d ln F/d ln t = (h₁² − t²h₂²)/((1 + t) d·y),   d·y = h₁² + t h₂²,
///     −d² ln F/d(ln t)² = t/(1 + t)² + w − 2t²e/d·y + w²,   w = t h₂²/d·y.
///
/// Finally F = (n·d/(h₁(n) + h₂(n)))², which is the maximum over all unit vectors n, so an error of n enters squared.
/// The distance of the surfaces is accurate to a few ε (a₁ + a₂), where a are the longest semi-axes.
///
/// Source: perram1985.
namespace vitrel {

template <int Dim>
struct PerramWertheim {
  double value;     ///< max F = μ²
  double lambda;    ///< λ at the maximum of F
  Vec<Dim> normal;  ///< unit vector from 1 to 2, common normal of the bodies scaled by μ
  Vec<Dim> point;   ///< where the scaled bodies touch, from centre 1; the contact point if F = 1

  bool disjoint() const { return value > 1; }
};

/// If the centres coincide, the normal is undefined; the result is then value = 0, normal = x and point = 0.
PerramWertheim<2> perram_wertheim(const Ellipse& one, double angle1, const Ellipse& two,
                                  double angle2, const Vec2& d);
PerramWertheim<3> perram_wertheim(const Ellipsoid& one, const Quaternion& orientation1,
                                  const Ellipsoid& two, const Quaternion& orientation2,
                                  const Vec3& d);

/// Returns the distance of the centres at which the bodies touch when centre 2 lies along `direction` (of any length
/// except 0) from centre 1. Scaling both bodies by μ is the same as scaling d by 1/μ, so the distance is |d|/√F for any
/// d along the direction.
double contact_distance(const Ellipse& one, double angle1, const Ellipse& two, double angle2,
                        const Vec2& direction);
double contact_distance(const Ellipsoid& one, const Quaternion& orientation1, const Ellipsoid& two,
                        const Quaternion& orientation2, const Vec3& direction);

}  // namespace vitrel

#pragma once

#include "core/geometry/ellipse.h"

/// The contact function of Perram and Wertheim (1985) for two ellipses:
///
///     F(λ) = λ(1−λ) dᵀ C(λ)⁻¹ d,   C(λ) = (1−λ)Σ₁ + λΣ₂,   0 < λ < 1,
///
/// d from centre 1 to centre 2. F is concave; its maximum is μ², where μ is the factor by which
/// both ellipses must be scaled about their centres to touch from outside. Disjoint iff F > 1.
///
/// Steps: with t = λ/(1−λ), Dᵢ = aᵢ²bᵢ², pᵢ = dᵀ adj(Σᵢ) d and m = tr(Σ₁ adj Σ₂), all sums of
/// positive terms,
///     F = t (p₁ + p₂t) / ((1 + t)(D₁ + m t + D₂t²)).
/// At the maximum t = h₁(n)/h₂(n), the ratio of the support functions along the common normal n, so
/// that b₁/a₂ ≤ t ≤ a₁/b₂; there d ln F/d ln t falls from positive to negative through its only
/// root, which Newton's method in ln t finds, safeguarded by the bracket.
///
/// F is good to about 10 κ ε, that is, the surfaces' distance to 10 κ ε (a₁ + a₂).
/// Source: perram1985.
namespace vitrel {

struct PerramWertheim {
  double value;   ///< max F = μ²
  double lambda;  ///< where F is largest
  Vec2 normal;    ///< unit vector from 1 to 2, common normal of the ellipses scaled by μ
  Vec2 point;     ///< where these touch, relative to centre 1; the contact point if F = 1

  bool disjoint() const { return value > 1; }
};

/// Coinciding centres single out no normal: then value is 0, normal (1, 0) and point 0.
PerramWertheim perram_wertheim(const Ellipse& one, double angle1, const Ellipse& two, double angle2,
                               const Vec2& d);

/// The distance of the centres at which the ellipses touch when centre 2 lies along `direction`
/// (any length but 0) from centre 1. Scaling both ellipses by μ is the same as scaling d by 1/μ, so
/// it is |d|/√F for whatever d along the direction.
double contact_distance(const Ellipse& one, double angle1, const Ellipse& two, double angle2,
                        const Vec2& direction);

}  // namespace vitrel

#pragma once

#include "core/geometry/ellipse.h"

/// @file
/// The contact function of Vieillard-Baron (1972) for two ellipses of any sizes, with the complete
/// criterion: two ellipses are disjoint iff
///
///     Ψ > 0 and (G₁ < 0 or G₂ < 0),
///
///     G₁ = 1 + tr(Σ₁A₂) − dᵀA₂d,   G₂ = 1 + tr(Σ₂A₁) − dᵀA₁d,   q = (a₂b₂)²/(a₁b₁)²,
///     Ψ = G₁²G₂² + 18 G₁G₂ − 4 q G₁³ − 4 G₂³/q − 27,
///
/// where Σ is the shape matrix, A = Σ⁻¹, and d points from centre 1 to centre 2.
///
/// Both conditions are needed. With E(x) = xᵀAx − 1 about its own centre, the pencil tE₁ + E₂ degenerates at the roots
/// of p(t) = t³ + G₁t² + (G₂/q)t + 1/q, and Ψ/q² is the discriminant of p. The product of the roots is negative, so one
/// root is negative. The other two are different and positive for disjoint ellipses, a double positive root for
/// touching ones, and a complex pair for ellipses with two intersections. Crossed ellipses (four intersections) and
/// ellipses one inside the other have three negative roots; for them Ψ > 0 too, but all coefficients of p are positive.
/// At a double positive root, G₁ < 0 or G₂ < 0 holds with a margin, so rounding can affect only Ψ.
///
/// Rounding: tr(Σ₁A₂) and dᵀAd are sums of positive terms. The terms of G₁ may cancel, but near its double root p is no
/// more sensitive to an error of G than to an error of the same relative size in d², since p = (t² + tr(Σ₁A₂)
/// t + 1/q)(1 + t)(1 − F(t)) with the Perram–Wertheim function F. The verdict is therefore right unless the surfaces
/// are closer than about 100 ε (a₁ + a₂), where ε is the unit roundoff of Real. Lengths enter only as ratios, so a pair
/// may be given in any unit.
///
/// Source: vieillardbaron1972, completed (the sign condition) and corrected (the trace).
namespace vitrel {

/// The semi-axes, and the direction (cosine, sine) of the major one.
template <class Real>
struct EllipseAxes {
  Real a, b;
  Real cosine, sine;
};

template <class Real>
struct VieillardBaron {
  Real psi;
  Real g1, g2;

  bool disjoint() const { return psi > 0 && has_separating_sign(); }
  /// Also true for ellipses that touch from outside, where Ψ = 0 and the sign condition holds.
  bool disjoint_or_touching() const { return psi >= 0 && has_separating_sign(); }

 private:
  bool has_separating_sign() const { return g1 < 0 || g2 < 0; }
};

/// Instantiated for double, long double and DoubleDouble.
template <class Real>
VieillardBaron<Real> vieillard_baron(const EllipseAxes<Real>& one, const EllipseAxes<Real>& two,
                                     Real dx, Real dy);

VieillardBaron<double> vieillard_baron(const Ellipse& one, double angle1, const Ellipse& two,
                                       double angle2, const Vec2& d);

}  // namespace vitrel

#pragma once

#include "core/geometry/ellipsoid.h"

/// @file
/// The characteristic polynomial of two ellipsoids and its criterion of overlap by five signs, η₁ … η₅
/// (Wang, Wang & Kim 2001; Jia et al. 2011; Ghossein & Lévesque 2013), completed.
///
/// With the 4 × 4 quadrics A of both bodies (xᵀAx = 0 on the surface, negative inside) and λ = στ, where
/// σ² = (a₁b₁c₁)/(a₂b₂c₂), det(λA₁ + A₂) divided by its leading coefficient and by σ⁴ is
///
///     q(τ) = τ⁴ − 4p̄₁τ³ + 6p̄₂τ² − 4p̄₃τ + 1 = P(τ) − τU(τ),
///     P(τ) = τ⁴ + e₃τ³ + e₂τ² + e₁τ + 1,   τU(τ) = u₃τ³ + u₂τ² + u₁τ,
///
///     e₃ = (1 + T₁)/σ,  e₂ = T₁/σ² + σ²T₂,  e₁ = σ(1 + T₂),   T₁ = tr(Σ₁A₂), T₂ = tr(Σ₂A₁),
///     u₃ = dᵀA₂d/σ,   u₁ = σ dᵀA₁d,   u₂ = dᵀMd/(a₁b₁c₁a₂b₂c₂),
///     M = Σ_kl x_kl x_klᵀ,  x_kl the cross product of semi-axis k of body 1 and semi-axis l of body 2,
///
/// where Σ and A = Σ⁻¹ are 3 × 3 matrices and d points from centre 1 to centre 2. All e and u are sums of positive sums
/// and ratios of lengths, and exchanging the bodies reverses the polynomial. P is (λ + 1) det(λ + Σ₁A₂), and τU/P = F
/// is the function of Perram and Wertheim at t = λ (perram_wertheim.h), so that
///
///     q = P (1 − F).
///
/// Two roots of q are always real and negative. Disjoint bodies also have two different positive roots, between which
/// F > 1; touching bodies have a double positive root, and overlapping bodies have no positive root.
///
/// The criterion uses β₁ and β₂ as in the .cpp file, the discriminant η₁ = β₁³ − 27β₂² (over 256), and the
/// subdiscriminants η₂ and η₅ (over 64 and 48). The bodies are disjoint iff
///
///     η₁ > 0, η₂ > 0, η₅ > 0 and (p̄₁ > 0 or p̄₂ < 0 or p̄₃ > 0).
///
/// Proof: the first three conditions say that all four roots are real and different. By Descartes' rule, which is exact
/// when all roots are real, there are positive roots iff some coefficient is negative. Their number is even, because
/// the product of all roots is 1 and two roots are negative. Ghossein and Lévesque omit the last condition, and so call
/// crossed bodies, and one inside the other, separate. If the roots are a double positive root τ₀, −x and −y, the last
/// condition holds with a margin: p̄₃ > 0 if τ₀ is below the harmonic mean of x and y, p̄₁ > 0 if it is above the
/// arithmetic mean, and in between 6p̄₂ = τ₀² − 2τ₀(x + y) + xy ≤ −(τ₀² + xy).
///
/// η₁ does not decide where two roots are equal, which makes it vanish. The two negative roots are equal, whatever the
/// distance, for two spheres and for parallel ellipsoids of one shape, and thus for a particle and its own image:
/// Σ₁ = sΣ₂ gives q = (τ + s^¼)² × a quadratic polynomial. They are also equal for spheroids with a common axis of
/// symmetry and d along it. Near these cases, and near touching, rounding exceeds η₁ and hides its sign. Then the sign
/// of q at the τ > 0 where F is largest decides: as P > 0, q < 0 there iff F > 1 somewhere, that is, iff there are two
/// positive roots. d ln F/d ln τ changes its sign once, as F is concave in λ/(1 + λ), and the maximum lies between the
/// smallest and the largest possible ratio h₁/h₂ of the support functions.
///
/// Rounding: the verdict is right unless the surfaces are closer than about 20 ε (a₁ + a₂), where a are the longest
/// semi-axes and ε is the unit roundoff of Real, for aspect ratios up to 100 and size ratios up to 1000 (measured,
/// docs/validation.md: 4 ε at most among 10⁷ pairs). Lengths enter only as ratios.
///
/// Sources: wang2001, jia2011, ghossein2013 (completed; its table 1 lacks the last condition).
namespace vitrel {

/// The semi-axes, and the unit vectors along them as columns.
template <class Real>
struct EllipsoidAxes {
  Eigen::Matrix<Real, 3, 1> lengths;
  Eigen::Matrix<Real, 3, 3> directions;

  EllipsoidAxes(const Ellipsoid& ellipsoid, const Quaternion& orientation)
      : lengths(ellipsoid.semi_axes.cast<Real>()),
        directions(orientation.cast<Real>().normalized().toRotationMatrix()) {}
};

/// The characteristic polynomial q(τ) of two ellipsoids.
template <class Real>
struct CharacteristicPolynomial {
  Real sigma;                 ///< λ = στ
  Real positive[5];           ///< 1, e₁, e₂, e₃, 1: P(τ) = Σ positive_k τᵏ
  Real negative[5];           ///< 0, u₁, u₂, u₃, 0: τU(τ)
  Real min_ratio, max_ratio;  ///< the bounds of h₁/h₂ in units of τ

  Real coefficient(int k) const { return positive[k] - negative[k]; }
  Real operator()(Real tau) const;
  /// The τ at which F is largest. The centres must not coincide, as F = 0 then.
  Real maximizer() const;
};

template <class Real>
CharacteristicPolynomial<Real> characteristic_polynomial(const EllipsoidAxes<Real>& one,
                                                         const EllipsoidAxes<Real>& two,
                                                         const Eigen::Matrix<Real, 3, 1>& d);

template <class Real>
struct EllipsoidEta {
  Real eta1, eta2, eta3, eta4, eta5;
  Real p1, p2, p3;  ///< p̄; p̄₄ = 1
  Real rounding;    ///< error of η₁, whose sign is not used where |η₁| is not larger
  Real min_value;   ///< q where F is largest, if η₁ does not decide

  bool decides() const { return eta1 > rounding || eta1 < -rounding; }
  bool disjoint() const { return decides() ? has_separating_signs() : min_value < 0; }
  /// Also true for ellipsoids that touch from outside.
  bool disjoint_or_touching() const { return decides() ? has_separating_signs() : min_value <= 0; }

 private:
  bool has_separating_signs() const {
    return eta1 > 0 && eta2 > 0 && eta5 > 0 && (p1 > 0 || p2 < 0 || p3 > 0);
  }
};

/// All templates of this file are instantiated for double, long double and DoubleDouble.
template <class Real>
EllipsoidEta<Real> ellipsoid_eta(const EllipsoidAxes<Real>& one, const EllipsoidAxes<Real>& two,
                                 const Eigen::Matrix<Real, 3, 1>& d);

/// The contact of two ellipsoids that touch from outside. With the double root λ of the characteristic polynomial, the
/// point x, relative to centre 1, is the solution of (λA₁ + A₂) x = 0 for the 4 × 4 quadrics (the article's equation 14
/// has a minus). In three dimensions,
///
///     x = Σ₁y,   y = (Σ₁ + λΣ₂)⁻¹d,
///
/// with the normal y/|y| from 1 to 2. The double root is where F is largest, and λ is taken there also for ellipsoids
/// that do not touch. The normal of disjoint ellipsoids then separates them (F > 1 and the Cauchy–Schwarz inequality).
/// The centres must differ.
template <class Real>
struct EllipsoidTouch {
  Eigen::Matrix<Real, 3, 1> point, normal;
};
template <class Real>
EllipsoidTouch<Real> ellipsoid_touch(const EllipsoidAxes<Real>& one, const EllipsoidAxes<Real>& two,
                                     const Eigen::Matrix<Real, 3, 1>& d);

EllipsoidEta<double> ellipsoid_eta(const Ellipsoid& one, const Quaternion& orientation1,
                                   const Ellipsoid& two, const Quaternion& orientation2,
                                   const Vec3& d);

}  // namespace vitrel

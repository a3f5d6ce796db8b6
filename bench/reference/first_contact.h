#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "core/geometry/growing.h"

namespace vitrel::bench {

/// The true first contact of two ellipses in free flight, growing or not, slowly but with a
/// guarantee; it shares no code with the methods compared with it.
///
/// Criterion, free of any division by a size. With semi-axes aᵢ, bᵢ at size 1, sizes σᵢ(t), sᵢ =
/// σᵢ², shape matrices Σᵢ at size 1, Dᵢ = det Σᵢ = (aᵢbᵢ)², Eᵢ = dᵀ adj(Σᵢ) d, W = tr(Σ₁ adj Σ₂),
///     H₁ = s₂D₂ + s₁W − E₂,   H₂ = s₁D₁ + s₂W − E₁,
///     R(x, y) = s₂D₁ x³ + H₂ x²y + H₁ xy² + s₁D₂ y³,
/// the ellipses are disjoint iff R < 0 for some x, y > 0: with λ/(1 − λ) = (y/s₂)/(x/s₁), R is
/// Perram and Wertheim's det C (1 − F(λ)) times a positive factor, where F > 1 makes C⁻¹d a
/// separating axis (Cauchy–Schwarz). The discriminant of R is
///     Φ = H₁²H₂² + 18 s₁s₂D₁D₂H₁H₂ − 4 s₂D₁H₁³ − 4 s₁D₂H₂³ − 27 s₁²s₂²D₁²D₂²
///       = (s₁s₂D₁D₂)² Ψ,
/// Ψ of Vieillard-Baron: same sign, but a polynomial in the sizes that stays positive for a
/// disjoint pair of size zero (Φ = H₁²H₂² − 4 s₂D₁H₁³ with H₁ < 0 for s₁ = 0, E₁²E₂² for both),
/// so that growth from a point needs no special start.
///
/// Steps, from the start of the horizon to its end.
/// 1. Circumcircles: the roots of their quadratic bound the part to be searched.
/// 2. Over a piece of it, x : y is fixed where R is least at the middle m, and interval arithmetic
///    with two derivatives encloses R(t) ∈ R(m) + R'(m)(t − m) + ½ R''(piece)(t − m)². If that is
///    negative throughout, the piece is passed.
/// 3. Else, if Φ < 0 at the piece's end and Φ' < 0 all over it, it holds one root of Φ, the first
///    contact (a disjoint pair can overlap only through Φ = 0). Interval Newton steps enclose it.
/// 4. Any other piece is shortened and tried again.
/// There is no fixed scan that a short overlap could slip through. The steps are done in double
/// (intervals rounded outwards, so no less rigorous) as far as that decides, then in Real.
///
/// `undecided`: a piece can be neither passed nor shortened further: the surfaces touch, or miss
/// each other by less than about the rounding of Real, without crossing. `time` then is where.
///
/// Sizes must not become negative within the horizon. Real is long double or Float128.
template <int Dim>
struct TrueContactOf {
  enum class Outcome { contact, none, undecided, overlap_at_start };
  Outcome outcome = Outcome::none;
  long double time = 0;
  long double uncertainty = 0;  ///< the contact lies within `time` ± this
  int pieces = 0;               ///< pieces of the horizon looked at
  /// At the contact, or where it is undecided: the unit vector from 1 to 2 normal to the surfaces,
  /// and the speed at which the surfaces approach along it, growth included.
  Vec<Dim> normal = Vec<Dim>::Zero();
  double approach_speed = 0;
};
using TrueContact = TrueContactOf<2>;

/// 113 bits of mantissa on every platform.
using Float128 = boost::multiprecision::cpp_bin_float_quad;

template <class Real = long double>
TrueContact true_first_contact(const Flight<GrowingEllipse>& one, const Flight<GrowingEllipse>& two,
                               double horizon);
TrueContact true_first_contact(const Flight<Ellipse>& one, const Flight<Ellipse>& two,
                               double horizon);

}  // namespace vitrel::bench

#pragma once

#include "core/geometry/tumbling_ellipsoid.h"

namespace vitrel::bench {

enum class TruthOutcome { contact, none, undecided, overlap_at_start };

template <int Dim>
struct TrueContactOf {
  using Outcome = TruthOutcome;
  Outcome outcome = Outcome::none;
  long double time = 0;
  long double uncertainty = 0;  ///< the contact lies within `time` ± this
  int pieces = 0;               ///< number of steps of the search
  /// The unit vector from 1 to 2 normal to the surfaces, and the speed at which the surfaces approach along it,
  /// growth included; both at the contact or, if it is undecided, at the time in question.
  Vec<Dim> normal = Vec<Dim>::Zero();
  double approach_speed = 0;
};
using TrueContact = TrueContactOf<2>;
using TrueEllipsoidContact = TrueContactOf<3>;

/// The true first contact of two ellipses or ellipsoids in free flight, which may grow or tumble. The search is slow,
/// uses 80-bit arithmetic, and takes no step that could pass over a short overlap. It shares no code with the engine.
///
/// An ellipse with semi-axes a ≥ b is the section of the spheroid (a, b, a). For any n in the plane both have the
/// same support function, and no n out of the plane separates two such spheroids by more, because their third
/// semi-axis is the longest. The spheroids therefore touch when the ellipses do.
///
/// The bodies are disjoint at a time if there is an axis n along which the support gap
///     G(n, t) = n·d − s₁h₁ − s₂h₂,   hᵢ = √(nᵀΣᵢn),   Σᵢ the shape matrix at size 1, sᵢ the size,
/// is positive; n may come from any source (here ellipsoid_touch, core/contact/ellipsoid_eta.h). They overlap by the
/// completed criterion of η₁ … η₅ in 80-bit arithmetic. In between lies a gap of about the rounding, for which
/// nothing is decided.
///
/// From a time with G > 0, the same axis separates the bodies up to the root of
///     G + Ġ s − ½ M s²,   M = Σᵢ ( most of sᵢ · ½‖[Ωᵢ, [Ωᵢ, Σᵢ]]‖/cᵢ + 2 |γᵢ ωᵢ| (aᵢ − cᵢ) ) ≥ −G̈,
/// since Σ̇ = [Ω, Σ] with Ωx = ω × x, since the Frobenius norm of [Ω, [Ω, Σ]] does not change as the body turns, and
/// since ḧ = (½ nᵀΣ̈n − ḣ²)/h with h ≥ c. A scalene body that tumbles (bench/reference/taylor_top.h; other bodies
/// keep their ω) contributes instead
///
///     (1 + 1/√12) (a² − c²) Ω²/c,   Ω² = 2E/I₁ ≤ (L/I₁)², I₁ the smallest moment:
///
/// n moves in the frame of the body with ṅ = −ω × n and n̈ = ω × (ω × n) − ω̇ × n, where |ω| ≤ Ω, and |ω̇| ≤ Ω²/√3 by
/// Euler's equations, since |Iⱼ − Iₖ| ≤ Iᵢ. In ½ d²(nᵀΣn)/dt² = ṅᵀΣṅ + nᵀΣn̈, (a² + c²)/2 may be subtracted from Σ
/// because |n| = 1, so that its norm is (a² − c²)/2. The times approach the first contact from below, and close to it
/// with Newton's speed. Where G has become as small as rounding, the search tests for an overlap at the time by which
/// the surfaces must have crossed, and bisects for the beginning of the overlap. The uncertainty is the time since
/// the bodies were last disjoint by more than rounding: |n·d| is accurate to 4 ε|d|, and hᵢ to 8 ε aᵢ
/// (core/state/exact_pair.cpp).
///
/// The rounding of the attitude is estimated (TaylorTop::sensitivity), not bounded by a proof. Near the separatrix of
/// flat bodies it makes the uncertainty of a contact as large as 1e-6, which is far more than the error of the time.
///
/// The result is `undecided` if no overlap is found there: the surfaces touch, or miss each other by less than the
/// rounding. Sizes must not become negative within the horizon.
///
/// The function is instantiated for GrowingEllipse, GrowingEllipsoid and TumblingEllipsoid.
template <class B>
TrueContactOf<B::dimension> true_first_contact(const Flight<B>& one, const Flight<B>& two,
                                               double horizon);

/// The distance of the surfaces at `time`, or minus the depth of the overlap, by the arithmetic of the exact check
/// (core/state/exact_pair.h).
template <class B>
long double true_gap(const Flight<B>& one, const Flight<B>& two, long double time);

}  // namespace vitrel::bench

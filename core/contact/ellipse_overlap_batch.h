#pragma once

#include <cstdint>

#include "core/contact/ellipse_batch.h"
#include "core/contact/ellipse_gap.h"

/// @file
/// The overlap test of trial moves for ellipses, in SIMD batches: whether one ellipse keeps a margin to all of several
/// others at rest. Each answer is proved; the cheapest proofs come first.
///
///   1. Circumcircles a margin apart prove the pair separated; overlapping incircles prove an overlap.
///   2. The complete criterion of Vieillard-Baron (ellipse_vieillard_baron.h) is evaluated without divisions and roots:
///      with Kᵢ = aᵢ²bᵢ², g₁ = K₂G₁ and g₂ = K₁G₂,
///          (K₁K₂)² Ψ = (g₁g₂)² + 18 K₁K₂ g₁g₂ − 4 (K₁g₁³ + K₂g₂³) − 27 (K₁K₂)².
///      It does not decide if this is so small that rounding or the margin might change its sign. Both act as relative
///      errors η of the terms of g₁ and g₂, which change a sum of their products by no more than 4η Σ, where Σ is the
///      same sum with all signs positive. The margin has η ≤ 2 margin/b, and η = 10⁻¹¹ is far above the rounding up to
///      aspect ratios of 1000.
///   3. separated() (ellipse_gap.h) decides the remaining pairs one by one; they touch to about nine digits.
///
/// Every step therefore gives the answer of separated(): the largest support gap is at least the margin, to the
/// rounding of the gap. The answer depends on the pair alone, not on the other lanes. Exchanging the bodies changes it
/// only where the gap equals the margin to rounding.
///
/// Source: vieillardbaron1972.
namespace vitrel {

class EllipseOverlapBatch {
 public:
  /// A set of lanes: bit k is lane k. Such sets are combined and tested, but never used to select.
  using Lanes = unsigned;
  static constexpr Lanes all_lanes = (1u << simd_width) - 1;

  /// Requires margin ≥ 0.
  EllipseOverlapBatch(const OrientedEllipse& body, const OrientedEllipse* /*bodies*/, double margin)
      : shape_(body.shape),
        axis_(body.axis),
        margin_(margin),
        aa_(shape_.a * shape_.a),
        bb_(shape_.b * shape_.b),
        aa_minus_bb_(shape_.aa_minus_bb()) {}

  /// Returns whether the body keeps the margin to all ellipses in these lanes; the separations d are `offset` + their
  /// positions. Adds the number of pairs that step 3 decided to `scalar_tests`.
  VITREL_INLINE bool may_be_clear_of(const EllipseBatch& group, const Vec2& offset, Lanes lanes,
                                     std::uint64_t& scalar_tests) const {
    const SimdBatch dx = group.x.load() + offset.x(), dy = group.y.load() + offset.y();
    const SimdBatch distance_squared = dx * dx + dy * dy;
    const SimdBatch a = group.a.load();
    const SimdBatch outer = a + (shape_.a + margin_);
    Lanes undecided = lanes & (distance_squared < outer * outer).bits();
    if (!undecided) return true;
    const SimdBatch b = group.b.load();
    const SimdBatch inner = b + shape_.b;
    if (undecided & (distance_squared < inner * inner).bits()) return false;

    const Verdict verdict = compare(group, dx, dy, a, b);
    if (undecided & verdict.certain & ~verdict.disjoint) return false;
    undecided &= ~verdict.certain;
    return !undecided || clear_by_scalar_tests(group, offset, undecided, scalar_tests);
  }
  /// No pairs wait for a full batch, so the answer is always yes.
  bool rest_is_clear(std::uint64_t& /*scalar_tests*/) const { return true; }

 private:
  // Bounds of the error of Ψ relative to the sum of its terms: from rounding, and from the margin in units of margin/b.
  static constexpr double psi_error = 1e-10, psi_error_of_margin = 16;

  struct Verdict {
    Lanes certain, disjoint;
  };

  VITREL_INLINE Verdict compare(const EllipseBatch& group, const SimdBatch& dx, const SimdBatch& dy,
                                const SimdBatch& a, const SimdBatch& b) const {
    const SimdBatch ux = group.ux.load(), uy = group.uy.load();
    const SimdBatch along1 = axis_.x() * dx + axis_.y() * dy,
                    across1 = axis_.x() * dy - axis_.y() * dx;
    const SimdBatch along2 = ux * dx + uy * dy, across2 = ux * dy - uy * dx;
    const SimdBatch sine = axis_.x() * uy - axis_.y() * ux;
    const SimdBatch aa = a * a, bb = b * b;
    const SimdBatch k2 = aa * bb;
    const double k1 = aa_ * bb_;
    // K₂ tr(Σ₁A₂) = K₁ tr(Σ₂A₁)
    const SimdBatch trace =
        aa_ * bb + bb_ * aa + sine * sine * (aa_minus_bb_ * ((a - b) * (a + b)));
    const SimdBatch quadric1 = bb_ * (along1 * along1) + aa_ * (across1 * across1);
    const SimdBatch quadric2 = bb * (along2 * along2) + aa * (across2 * across2);
    const SimdBatch sum1 = k2 + trace, sum2 = k1 + trace;
    const SimdBatch g1 = sum1 - quadric2, g2 = sum2 - quadric1;
    const SimdBatch m1 = sum1 + quadric2, m2 = sum2 + quadric1;
    const SimdBatch kk = k1 * k2, constant = 27 * (kk * kk);
    const SimdBatch gg = g1 * g2, mm = m1 * m2;
    const SimdBatch psi =
        gg * (gg + 18 * kk) - 4 * (k1 * (g1 * g1 * g1) + k2 * (g2 * g2 * g2)) - constant;
    const SimdBatch terms =
        mm * (mm + 18 * kk) + 4 * (k1 * (m1 * m1 * m1) + k2 * (m2 * m2 * m2)) + constant;
    const SimdBatch width = min(b, shape_.b);
    const SimdBatch limit = (psi_error * width + psi_error_of_margin * margin_) * terms;
    return {(abs(psi) * width > limit).bits(),
            (psi > 0).bits() & ((g1 < 0).bits() | (g2 < 0).bits())};
  }

  [[gnu::noinline]] bool clear_by_scalar_tests(const EllipseBatch& group, const Vec2& offset,
                                               Lanes undecided, std::uint64_t& scalar_tests) const {
    for (int lane = 0; lane < simd_width; ++lane) {
      if (!(undecided & (1u << lane))) continue;
      ++scalar_tests;
      if (!separated(shape_, axis_, group.shape(lane), group.axis(lane),
                     group.position(lane) + offset, margin_))
        return false;
    }
    return true;
  }

  Ellipse shape_;
  Vec2 axis_;
  double margin_;
  double aa_, bb_, aa_minus_bb_;  // a², b², a² − b²
};

}  // namespace vitrel

#pragma once

#include <cstdint>

#include "core/contact/ellipse_batch.h"
#include "core/contact/ellipse_gap.h"

/// @file
/// Does one ellipse keep a margin to all of several others at rest? The overlap test of trial moves, in SIMD
/// batches. Each answer is proved; the cheapest proofs come first.
///
///   1. Circumcircles a margin apart prove the pair separated; overlapping incircles prove an overlap.
///   2. For weights w₁, w₂ > 0 let C = w₁Σ₁ + w₂Σ₂, n = C⁻¹d, hᵢ = √(nᵀΣᵢn), d from centre 1 to 2.
///      Separated if n·d > h₁ + h₂ + margin |n|: any such n separates (ellipse_gap.h).
///      Overlap if w₁h₁ ≤ 1 and w₂h₂ ≤ 1: w₁Σ₁n = d − w₂Σ₂n is a point of both ellipses.
///      The first weights are w₁ = w₂; they decide most pairs.
///   3. Repeat with w₁ : w₂ = h₂ : h₁, towards the maximum of the Perram–Wertheim function. At the maximum
///      one of the two proofs holds, or the gap is between 0 and the margin.
///      1 to 3 % of all pairs with overlapping circumcircles remain.
///   4. separated() decides these one by one.
///
/// Since |n| ≤ hᵢ/bᵢ, margin |n| is replaced by margin h₁/b₁: this saves a square root and is still a proof. The
/// proof of an overlap must hold with a safety margin of 1e-10, far above the rounding of C⁻¹ up to aspect
/// ratios of 1000: every pair reported as overlapping has a common point. C⁻¹ det C and det C are sums of
/// positive terms, without cancellation.
///
/// Every step therefore gives the answer of separated(): the largest support gap is at least the margin, to the
/// rounding of the gap. The answer depends on the pair alone, not on the other lanes. Exchanging the bodies
/// changes it only where the gap equals the margin to rounding.
/// Source: perram1985.
namespace vitrel {

class OverlapBatch {
 public:
  /// Bit k is lane k: these are combined and tested, but never select.
  using Lanes = unsigned;
  static constexpr Lanes all_lanes = (1u << simd_width) - 1;

  /// `axis` is the unit vector along the major axis; margin ≥ 0.
  OverlapBatch(const Ellipse& shape, const Vec2& axis, double margin)
      : shape_(shape),
        axis_(axis),
        margin_(margin),
        bb_(shape.b * shape.b),
        aa_minus_bb_(shape.aa_minus_bb()),
        enlargement_(1 + margin / shape.b) {}

  /// Whether the body keeps the margin to all ellipses in these lanes; the separations d are `offset` +
  /// their positions. Adds the number of pairs that step 4 decided to `scalar_tests`.
  VITREL_INLINE bool clear_of(const EllipseBatch& group, const Vec2& offset, Lanes lanes,
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

    const SimdBatch bb = b * b, aa_minus_bb = (a - b) * (a + b);
    const Pairs pairs(*this, group.ux.load(), group.uy.load(), bb, aa_minus_bb, dx, dy);
    Heights heights;
    if (!pairs.decide(SimdBatch(1), SimdBatch(1), heights, undecided)) return false;
    if (!undecided) return true;
    const SimdBatch weight1 = heights.two, weight2 = heights.one;
    if (!pairs.decide(weight1, weight2, heights, undecided)) return false;
    return !undecided || clear_by_scalar_tests(group, offset, undecided, scalar_tests);
  }

 private:
  static constexpr double overlap_safety = 1 - 1e-10;

  struct Heights {
    SimdBatch one, two;
  };

  // The body and the ellipses of a batch: what does not depend on the weights.
  struct Pairs {
    const OverlapBatch& body;
    SimdBatch ux, uy, bb, aa_minus_bb, dx, dy;
    SimdBatch across1, across2;  // components of d across the major axes
    SimdBatch sine_squared;      // of the angle between the axes

    VITREL_INLINE Pairs(const OverlapBatch& one, const SimdBatch& group_ux,
                        const SimdBatch& group_uy, const SimdBatch& group_bb,
                        const SimdBatch& group_stretch, const SimdBatch& group_dx,
                        const SimdBatch& group_dy)
        : body(one),
          ux(group_ux),
          uy(group_uy),
          bb(group_bb),
          aa_minus_bb(group_stretch),
          dx(group_dx),
          dy(group_dy),
          across1(one.axis_.x() * dy - one.axis_.y() * dx),
          across2(ux * dy - uy * dx) {
      const SimdBatch sine = one.axis_.x() * uy - one.axis_.y() * ux;
      sine_squared = sine * sine;
    }

    // False if an undecided pair is proved to overlap; removes the pairs that are proved separated.
    VITREL_INLINE bool decide(const SimdBatch& weight1, const SimdBatch& weight2, Heights& heights,
                              Lanes& undecided) const {
      const SimdBatch beta = weight1 * body.bb_ + weight2 * bb;
      const SimdBatch along1 = weight1 * body.aa_minus_bb_, along2 = weight2 * aa_minus_bb;
      const SimdBatch det = beta * (beta + along1 + along2) + along1 * along2 * sine_squared;
      // det C times C⁻¹d
      const SimdBatch turned1 = along1 * across1, turned2 = along2 * across2;
      const SimdBatch nx = beta * dx - turned1 * body.axis_.y() - turned2 * uy;
      const SimdBatch ny = beta * dy + turned1 * body.axis_.x() + turned2 * ux;
      const SimdBatch square = nx * nx + ny * ny;
      const SimdBatch n1 = nx * body.axis_.x() + ny * body.axis_.y(), n2 = nx * ux + ny * uy;
      heights.one = sqrt(body.bb_ * square + body.aa_minus_bb_ * (n1 * n1));
      heights.two = sqrt(bb * square + aa_minus_bb * (n2 * n2));
      const SimdBatch limit = overlap_safety * det;
      if (undecided & (weight1 * heights.one <= limit && weight2 * heights.two <= limit).bits())
        return false;
      undecided &= ~(nx * dx + ny * dy > body.enlargement_ * heights.one + heights.two).bits();
      return true;
    }
  };

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
  double bb_, aa_minus_bb_;  // b², a² − b²
  double enlargement_;       // 1 + margin/b
};

}  // namespace vitrel

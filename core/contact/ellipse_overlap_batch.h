#pragma once

#include <cstdint>

#include "core/contact/several.h"
#include "core/contact/support_gap.h"

/// One ellipse beside several others at rest, `many` at a time: is it clear of them all, that is, are
/// the surfaces at least a margin apart? The question of a trial move, decided by proofs for either
/// answer, the cheapest first.
///
///   1. Circumcircles a margin apart prove the pair clear; incircles that meet prove an overlap.
///   2. For weights w₁, w₂ > 0 let C = w₁Σ₁ + w₂Σ₂, n = C⁻¹d, hᵢ = √(nᵀΣᵢn), d from centre 1 to 2.
///      Clear if n·d > h₁ + h₂ + margin |n|: n separates (support_gap.h), whatever n is.
///      Overlap if w₁h₁ ≤ 1 and w₂h₂ ≤ 1: w₁Σ₁n = d − w₂Σ₂n is a point of both ellipses.
///      First w₁ = w₂, which settles most.
///   3. Once more with w₁ : w₂ = h₂ : h₁, towards the maximum of the function of Perram and Wertheim
///      (there one of the two proofs holds, or the pair is between touching and a margin apart).
///      1 to 3 % of all within the circumcircles are left.
///   4. These go to separated() one by one.
///
/// |n| ≤ hᵢ/bᵢ, so margin |n| is replaced by margin h₁/b₁: one root less, and clear is still proved. The
/// proof of an overlap must hold with a reserve of 1e-10, far above the rounding of C⁻¹ up to aspect
/// ratios of 1000: every pair that gets this answer has a common point. C⁻¹ det C and det C are sums
/// of positive matrices and numbers, without cancellation.
///
/// So whichever step answers, the answer is that of separated(): the largest support gap is at least
/// the margin, to the rounding of the gap. It depends on the pair alone, not on the other lanes, and
/// changes if the bodies change places only where the gap is the margin to rounding.
/// Source: perram1985.
namespace vitrel {

/// Up to `many` ellipses at rest. A lane that holds none is out of everybody's reach.
struct EllipseGroup {
  static constexpr double nowhere = 1e150;  // its square is finite

  detail::NumbersOf<many> x, y, a, b, ux, uy;

  EllipseGroup() {
    for (int lane = 0; lane < many; ++lane) clear(lane);
  }
  void clear(int lane) { set(lane, {0, 0}, Vec2(nowhere, nowhere), Vec2(1, 0)); }
  void set(int lane, const Ellipse& shape, const Vec2& position, const Vec2& axis) {
    x[lane] = position.x(), y[lane] = position.y();
    a[lane] = shape.a, b[lane] = shape.b;
    ux[lane] = axis.x(), uy[lane] = axis.y();
  }

  Ellipse shape(int lane) const { return {a[lane], b[lane]}; }
  Vec2 position(int lane) const { return {x[lane], y[lane]}; }
  Vec2 axis(int lane) const { return {ux[lane], uy[lane]}; }
};

class OverlapLook {
 public:
  /// Lanes of a group.
  using Asked = Many::mask_type;

  /// `axis` is the unit vector along the major axis; margin ≥ 0.
  OverlapLook(const Ellipse& shape, const Vec2& axis, double margin)
      : shape_(shape),
        axis_(axis),
        margin_(margin),
        bb_(shape.b * shape.b),
        stretch_(shape.stretch()),
        enlarged_(1 + margin / shape.b) {}

  /// Whether the body is clear of all in the group that are asked about; `offset` + their positions
  /// are the separations d. Adds the number of pairs that step 4 decided to `alone`.
  VITREL_INLINE bool clear_of(const EllipseGroup& group, const Vec2& offset, Asked asked,
                              std::uint64_t& alone) const {
    const Many dx = group.x.all() + offset.x(), dy = group.y.all() + offset.y();
    const Many distance_squared = dx * dx + dy * dy;
    const Many a = group.a.all();
    const Many outer = a + (shape_.a + margin_);
    Asked open = asked && distance_squared < outer * outer;
    if (none_of(open)) return true;
    const Many b = group.b.all();
    const Many inner = b + shape_.b;
    if (any_of(open && distance_squared < inner * inner)) return false;

    const Many bb = b * b, stretch = (a - b) * (a + b);
    const Pairs pairs(*this, group.ux.all(), group.uy.all(), bb, stretch, dx, dy);
    Heights heights;
    if (!pairs.settle(Many(1), Many(1), heights, open)) return false;
    if (none_of(open)) return true;
    const Many weight1 = heights.two, weight2 = heights.one;
    if (!pairs.settle(weight1, weight2, heights, open)) return false;
    return none_of(open) || clear_alone(group, offset, open, alone);
  }

 private:
  static constexpr double surely = 1 - 1e-10;

  struct Heights {
    Many one, two;
  };

  // The body and those of a group, with what does not depend on the weights.
  struct Pairs {
    const OverlapLook& body;
    Many ux, uy, bb, stretch, dx, dy;
    Many across1, across2;  // of d to the axes
    Many sine_squared;      // of the angle between the axes

    VITREL_INLINE Pairs(const OverlapLook& one, const Many& group_ux, const Many& group_uy,
                        const Many& group_bb, const Many& group_stretch, const Many& group_dx,
                        const Many& group_dy)
        : body(one),
          ux(group_ux),
          uy(group_uy),
          bb(group_bb),
          stretch(group_stretch),
          dx(group_dx),
          dy(group_dy),
          across1(one.axis_.x() * dy - one.axis_.y() * dx),
          across2(ux * dy - uy * dx) {
      const Many sine = one.axis_.x() * uy - one.axis_.y() * ux;
      sine_squared = sine * sine;
    }

    // False if one of the open pairs is proved to overlap; closes those that are proved clear.
    VITREL_INLINE bool settle(const Many& weight1, const Many& weight2, Heights& heights,
                              Asked& open) const {
      const Many beta = weight1 * body.bb_ + weight2 * bb;
      const Many along1 = weight1 * body.stretch_, along2 = weight2 * stretch;
      const Many det = beta * (beta + along1 + along2) + along1 * along2 * sine_squared;
      // det C times C⁻¹d
      const Many turned1 = along1 * across1, turned2 = along2 * across2;
      const Many nx = beta * dx - turned1 * body.axis_.y() - turned2 * uy;
      const Many ny = beta * dy + turned1 * body.axis_.x() + turned2 * ux;
      const Many square = nx * nx + ny * ny;
      const Many n1 = nx * body.axis_.x() + ny * body.axis_.y(), n2 = nx * ux + ny * uy;
      heights.one = sqrt(body.bb_ * square + body.stretch_ * (n1 * n1));
      heights.two = sqrt(bb * square + stretch * (n2 * n2));
      const Many limit = surely * det;
      if (any_of(open && weight1 * heights.one <= limit && weight2 * heights.two <= limit))
        return false;
      open = open && !(nx * dx + ny * dy > body.enlarged_ * heights.one + heights.two);
      return true;
    }
  };

  [[gnu::noinline]] bool clear_alone(const EllipseGroup& group, const Vec2& offset, Asked open,
                                     std::uint64_t& alone) const {
    for (int lane = 0; lane < many; ++lane) {
      if (!open[lane]) continue;
      ++alone;
      if (!separated(shape_, axis_, group.shape(lane), group.axis(lane),
                     group.position(lane) + offset, margin_))
        return false;
    }
    return true;
  }

  Ellipse shape_;
  Vec2 axis_;
  double margin_;
  double bb_, stretch_;  // b², a² − b²
  double enlarged_;      // 1 + margin/b
};

}  // namespace vitrel

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/contact/ellipse_overlap_batch.h"
#include "core/contact/round_free_path_batch.h"

/// @file
/// The free path of event-chain Monte Carlo for ellipses, in SIMD batches: how far one ellipse can move along x or y,
/// at a fixed angle, before it touches another one that is at rest.
///
/// Let x point along the path and y across it. An ellipse has the half height h = √Σ_yy, the shear k = Σ_xy/h and the
/// half chord w = a b/h along the path through its centre, so that its support function along n = (c, s) is
///
///     η(n) = √(w²c² + (h s + k c)²).
///
/// With d from centre 1 to centre 2 and any n with c > 0, the gap along n stays positive up to the path length
///
///     f(n) = (n·d − η₁(n) − η₂(n))/c.
///
/// Every n proves a free path. f is concave in s/c, and its maximum is the contact.
///
/// Steps:
///   1. An ellipse with |d_y| ≥ H = h₁ + h₂ is never hit. With t = d_y/H the point (t (k₁ + k₂), d_y) belongs to the
///      Minkowski sum of the two bodies. Of two disjoint bodies, the second is therefore ahead if d_x is larger than
///      t (k₁ + k₂), and behind otherwise.
///   2. The ellipse Q = Σ₁/q + Σ₂/(1 − q) contains this sum for 0 < q < 1. It gives the free path
///          d_x − (Q_xy d_y + √(det Q (Q_yy − d_y²)))/Q_yy.
///      The bound is exact for q : 1 − q = η₁ : η₂ at the contact, which w + (h − w) t² approximates. An upper bound of
///      the contact is d_x − t (k₁ + k₂) − (w₁ + w₂) √(1 − t²). Ellipses whose free path exceeds the upper bound of
///      another, or the maximum length, are discarded.
///   3. The remaining ellipses are solved in batches. With n = (c, (W v − B c)/G), c = √(1 − v²), G = √Q_yy, B = Q_xy/G
///      and W = √(det Q)/G, the slope of f is a smooth function of v on −1 … 1, and the slope of the free path of Q is
///      d_y − G v. Bracketed Newton iteration from v = d_y/G takes 2 to 4 steps.
///
/// For disks of any sizes step 2 is exact. If all particles are round, round_free_path_batch.h needs only one square
/// root.
///
/// Contact is declared when the surfaces are between `gap` and (a₁/b₁ + ¼) `gap` apart, to the rounding of the
/// coordinates, because the first body is enlarged by the factor 1 + gap/b₁. A pair that is already closer, and
/// approaching, touches at once.
namespace vitrel {

namespace detail {

/// Half height, shear and half chord of an ellipse relative to a path; ux is the component of its axis along the path.
template <class T>
struct PathProfile {
  T height, shear, half_chord;

  VITREL_INLINE PathProfile(const T& a, const T& b, const T& ux, const T& uy) {
    using std::sqrt;
    const T aa_minus_bb = (a - b) * (a + b);
    height = sqrt(b * b + aa_minus_bb * (uy * uy));
    const T inverse = 1. / height;
    shear = aa_minus_bb * (ux * uy) * inverse;
    half_chord = a * b * inverse;
  }
};

}  // namespace detail

/// The free path along x (`direction` 0) or y (1).
template <int direction>
class EllipseFreePathBatch {
 public:
  using Mask = SimdBatch::Mask;

  /// `max_length` > 0 limits the path.
  EllipseFreePathBatch(const OrientedEllipse& body, const OrientedEllipse* /*bodies*/, double gap,
                       double max_length)
      : upper_bound_(max_length), tolerance_(0.25 * gap), end_{max_length, FreePath::none, 0} {
    const double enlarged = 1 + gap / body.shape.b;
    const detail::PathProfile<double> mine(body.shape.a, body.shape.b, body.axis[direction],
                                           body.axis[across]);
    circumradius_ = enlarged * body.shape.a;
    height_ = enlarged * mine.height;
    shear_ = enlarged * mine.shear;
    half_chord_ = enlarged * mine.half_chord;
  }

  /// Returns how far behind, aside or ahead of the moving body the centre of a particle that can end the path may be,
  /// if no semi-axis exceeds `largest`.
  double reach_behind(double largest) const { return std::abs(shear_) + largest; }
  double reach_aside(double largest) const { return height_ + largest; }
  double reach_ahead(double largest) const { return upper_bound_ + circumradius_ + largest; }

  /// Adds the ellipses in the lanes of `mask`. The separations d are `offset` + their positions, and their ids are
  /// `first_id` + lane.
  VITREL_INLINE void add(const EllipseBatch& group, std::uint32_t first_id, const Vec2& offset,
                         const Mask& mask) {
    const SimdBatch dx = group.coordinate<direction>() + offset[direction];
    const SimdBatch dy = group.coordinate<across>() + offset[across];
    const SimdBatch a = group.a.load(), reach = a + circumradius_;
    Mask candidates = mask && abs(dy) < reach && dx > -reach && dx < upper_bound_ + reach;
    if (none_of(candidates)) return;

    const detail::PathProfile<SimdBatch> other(a, group.b.load(), group.axis_component<direction>(),
                                               group.axis_component<across>());
    const SimdBatch t = dy / (height_ + other.height), tt = t * t;
    const SimdBatch past_middle = dx - t * (shear_ + other.shear);
    candidates = candidates && tt < 1. && past_middle > 0.;
    if (none_of(candidates)) return;

    const SimdBatch share1 = half_chord_ + (height_ - half_chord_) * tt;
    const SimdBatch share2 = other.half_chord + (other.height - other.half_chord) * tt;
    const SimdBatch sum = share1 + share2, weight1 = sum / share1, weight2 = sum / share2;
    const SimdBatch xx =
        weight1 * (shear_ * shear_ + half_chord_ * half_chord_) +
        weight2 * (other.shear * other.shear + other.half_chord * other.half_chord);
    const SimdBatch xy = weight1 * (shear_ * height_) + weight2 * (other.shear * other.height);
    const SimdBatch yy = weight1 * (height_ * height_) + weight2 * (other.height * other.height);
    const SimdBatch det = max(xx * yy - xy * xy, SimdBatch(0));
    const SimdBatch lower = dx - (xy * dy + sqrt(det * max(yy - dy * dy, SimdBatch(0)))) / yy;
    candidates = candidates && lower < upper_bound_;
    if (none_of(candidates)) return;

    const SimdBatch upper =
        past_middle - (half_chord_ + other.half_chord) * sqrt(max(1. - tt, SimdBatch(0)));
    for (int lane = 0; lane < simd_width; ++lane) {
      if (!candidates[lane] || !(lower[lane] < upper_bound_)) continue;
      if (pending_ == simd_width) solve_pending();
      push(pending_++, lane, first_id + static_cast<std::uint32_t>(lane), dx, dy, other, xy, yy,
           det, lower);
      if (const double then = upper[lane] + tolerance_; then < upper_bound_) upper_bound_ = then;
    }
  }

  /// Returns the free path among all ellipses added.
  FreePath end() {
    if (pending_ > 0) solve_pending();
    return end_;
  }

 private:
  static constexpr int across = 1 - direction;

  VITREL_INLINE void push(int k, int lane, std::uint32_t id, const SimdBatch& dx,
                          const SimdBatch& dy, const detail::PathProfile<SimdBatch>& other,
                          const SimdBatch& xy, const SimdBatch& yy, const SimdBatch& det,
                          const SimdBatch& lower) {
    id_[k] = id;
    dx_[k] = dx[lane], dy_[k] = dy[lane];
    other_height_[k] = other.height[lane];
    other_shear_[k] = other.shear[lane];
    other_half_chord_[k] = other.half_chord[lane];
    xy_[k] = xy[lane], yy_[k] = yy[lane], det_[k] = det[lane];
    earliest_[k] = lower[lane];
  }

  // Performs step 3 for the pending ellipses.
  [[gnu::noinline]] void solve_pending() {
    constexpr int max_steps = 64;  // enough for bisection alone
    const SimdBatch dx = dx_.load(), dy = dy_.load();
    const SimdBatch height = other_height_.load(), shear = other_shear_.load(),
                    half_chord = other_half_chord_.load();
    const SimdBatch inverse = 1. / sqrt(yy_.load());
    const SimdBatch middle = xy_.load() * inverse, width = sqrt(det_.load()) * inverse;
    const SimdBatch curvature1(height_ * half_chord_ * (height_ * half_chord_));
    const SimdBatch curvature2 = height * half_chord * (height * half_chord);
    SimdBatch v = dy * inverse, low(-1), high(1);
    SimdBatch free_length(-std::numeric_limits<double>::infinity());
    const Mask mask =
        detail::lane_indices<simd_width>() < pending_ && earliest_.load() < upper_bound_;
    for (int step = 0; step < max_steps; ++step) {
      const SimdBatch c = sqrt(max(1. - v * v, SimdBatch(0)));
      const SimdBatch s = (width * v - middle * c) * inverse;
      const SimdBatch along1 = height_ * s + shear_ * c, along2 = height * s + shear * c;
      const SimdBatch across1 = half_chord_ * c, across2 = half_chord * c;
      const SimdBatch support1 = sqrt(across1 * across1 + along1 * along1);
      const SimdBatch support2 = sqrt(across2 * across2 + along2 * along2);
      const SimdBatch inverse1 = 1. / support1, inverse2 = 1. / support2;
      const SimdBatch now = dx + (s * dy - support1 - support2) / c;
      free_length = select(now > free_length, now, free_length);
      // The slope is df/d(s/c), and the curvature is minus its derivative.
      const SimdBatch slope = dy - height_ * along1 * inverse1 - height * along2 * inverse2;
      const SimdBatch curvature = curvature1 * (inverse1 * inverse1 * inverse1) +
                                  curvature2 * (inverse2 * inverse2 * inverse2);
      const Mask converged = slope * slope <= 2 * tolerance_ * curvature * (c * c * c);
      if (none_of(mask && !converged && free_length < end_.length)) break;
      low = select(slope > 0., v, low);
      high = select(slope > 0., high, v);
      const SimdBatch next = v + slope / (curvature * width * inverse);
      v = select(next > low && next < high, next, 0.5 * (low + high));
    }
    for (int lane = 0; lane < pending_; ++lane) {
      const double length = std::max<double>(free_length[lane], 0);
      if (mask[lane] && length < end_.length) end_ = {length, id_[lane], dx_[lane] - length};
    }
    if (end_.length < upper_bound_) upper_bound_ = end_.length;
    pending_ = 0;
  }

  double circumradius_, height_, shear_, half_chord_;  // enlarged by the gap
  double upper_bound_;                                 // upper bound of the contact
  double tolerance_;
  FreePath end_;
  int pending_ = 0;
  std::uint32_t id_[simd_width];
  detail::BatchBuffer<simd_width> dx_, dy_, other_height_, other_shear_, other_half_chord_;
  detail::BatchBuffer<simd_width> xy_, yy_, det_, earliest_;
};

}  // namespace vitrel

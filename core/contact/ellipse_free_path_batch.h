#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/contact/overlap_look.h"

/// One ellipse that moves straight along x or y, at a fixed angle, beside several others at rest, `many`
/// at a time: how far does it come before it touches the first of them? The question of an event chain.
///
/// Let x point along the path and y across it. An ellipse has the height h = √Σ_yy, the slant k =
/// Σ_xy/h and the waist w = a b/h, so that its support function along n = (c, s) is
///     η(n) = √(w²c² + (h s + k c)²).
/// With d from centre 1 to centre 2 and any n with c > 0, the gap along n stays positive up to the path
///     f(n) = (n·d − η₁(n) − η₂(n))/c:
/// every n proves a path to be free. f is concave in s/c, and its maximum is the contact.
///
/// Steps:
///   1. Whoever is |d_y| ≥ H = h₁ + h₂ aside is never met. With t = d_y/H the point (t (k₁ + k₂), d_y)
///      belongs to the sum of the two bodies; so of two that do not overlap the other is ahead if d_x is
///      larger, and behind if not.
///   2. The ellipse Q = Σ₁/q + Σ₂/(1 − q) contains that sum, for 0 < q < 1; it is met at
///          d_x − (Q_xy d_y + √(det Q (Q_yy − d_y²)))/Q_yy,
///      which is a free path. It is exact for q : 1 − q = η₁ : η₂ at the contact, here guessed as w + (h − w) t².
///      The contact comes at d_x − t (k₁ + k₂) − (w₁ + w₂) √(1 − t²) at the latest. Those whose free path is
///      longer than another's latest contact, or than asked for, are out.
///   3. The others four by four: with n = (c, (W v − B c)/G), c = √(1 − v²), G = √Q_yy, B = Q_xy/G and
///      W = √(det Q)/G, the slope of f is a smooth function of v on −1 … 1, that of Q is d_y − G v. Newton's
///      method from v = d_y/G, between bounds that close in, needs 2 to 4 steps.
///
/// Disks of any sizes are exact at step 2; if all are round, `RoundPathLook` does with one root.
///
/// Contact is declared with the surfaces between `gap` and (a₁/b₁ + ¼) `gap` apart, to the rounding of
/// coordinates: as in overlap_look.h the first body is enlarged by the factor 1 + gap/b₁. A pair
/// that is closer already, and approaching, touches at once.
namespace vitrel {

/// What ends a path.
struct PathEnd {
  static constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();
  double length;
  std::uint32_t touched;  ///< the name of the other, or nobody
  double ahead;           ///< how far its centre is then ahead along the path
};

namespace detail {

/// An ellipse seen along a path; ux is along it.
template <class T>
struct PathProfile {
  T height, slant, waist;

  VITREL_INLINE PathProfile(const T& a, const T& b, const T& ux, const T& uy) {
    using std::sqrt;
    const T stretch = (a - b) * (a + b);
    height = sqrt(b * b + stretch * (uy * uy));
    const T inverse = 1. / height;
    slant = stretch * (ux * uy) * inverse;
    waist = a * b * inverse;
  }
};

/// The component along x (`direction` 0) or y (1).
template <int direction>
VITREL_INLINE Many one_of(const NumbersOf<many>& x, const NumbersOf<many>& y) {
  return direction == 0 ? x.all() : y.all();
}

}  // namespace detail

/// Looks along x (`direction` 0) or y (1).
template <int direction>
class PathLook {
 public:
  using Asked = Many::mask_type;

  /// `axis` is the unit vector along the major axis. Paths end at `longest` > 0, if not before.
  PathLook(const Ellipse& shape, const Vec2& axis, double gap, double longest)
      : latest_(longest), tolerance_(0.25 * gap), end_{longest, PathEnd::nobody, 0} {
    const double enlarged = 1 + gap / shape.b;
    const detail::PathProfile<double> mine(shape.a, shape.b, axis[direction], axis[across]);
    circumradius_ = enlarged * shape.a;
    height_ = enlarged * mine.height;
    slant_ = enlarged * mine.slant;
    waist_ = enlarged * mine.waist;
  }

  /// How far behind, aside and ahead the centres can be of those that end the path, if their semi-axes
  /// are `largest` at most.
  double reach_behind(double largest) const { return std::abs(slant_) + largest; }
  double reach_aside(double largest) const { return height_ + largest; }
  double reach_ahead(double largest) const { return latest_ + circumradius_ + largest; }

  /// Looks at those in the group that are asked about; `offset` + their positions are the separations
  /// d, `first_name` + lane is what to call them.
  VITREL_INLINE void look(const EllipseGroup& group, std::uint32_t first_name, const Vec2& offset,
                          Asked asked) {
    using detail::one_of;
    const Many dx = one_of<direction>(group.x, group.y) + offset[direction];
    const Many dy = one_of<across>(group.x, group.y) + offset[across];
    const Many a = group.a.all(), reach = a + circumradius_;
    Asked open = asked && abs(dy) < reach && dx > -reach && dx < latest_ + reach;
    if (none_of(open)) return;

    const detail::PathProfile<Many> other(a, group.b.all(), one_of<direction>(group.ux, group.uy),
                                          one_of<across>(group.ux, group.uy));
    const Many t = dy / (height_ + other.height), tt = t * t;
    const Many past_middle = dx - t * (slant_ + other.slant);
    open = open && tt < 1. && past_middle > 0.;
    if (none_of(open)) return;

    const Many share1 = waist_ + (height_ - waist_) * tt;
    const Many share2 = other.waist + (other.height - other.waist) * tt;
    const Many sum = share1 + share2, weight1 = sum / share1, weight2 = sum / share2;
    const Many xx = weight1 * (slant_ * slant_ + waist_ * waist_) +
                    weight2 * (other.slant * other.slant + other.waist * other.waist);
    const Many xy = weight1 * (slant_ * height_) + weight2 * (other.slant * other.height);
    const Many yy = weight1 * (height_ * height_) + weight2 * (other.height * other.height);
    const Many det = max(xx * yy - xy * xy, Many(0));
    const Many earliest = dx - (xy * dy + sqrt(det * max(yy - dy * dy, Many(0)))) / yy;
    open = open && earliest < latest_;
    if (none_of(open)) return;

    const Many latest = past_middle - (waist_ + other.waist) * sqrt(max(1. - tt, Many(0)));
    for (int lane = 0; lane < many; ++lane) {
      if (!open[lane] || !(earliest[lane] < latest_)) continue;
      if (waiting_ == many) settle();
      put(waiting_++, lane, first_name + static_cast<std::uint32_t>(lane), dx, dy, other, xy, yy,
          det, earliest);
      if (const double then = latest[lane] + tolerance_; then < latest_) latest_ = then;
    }
  }

  /// The end of the path, of all that were looked at.
  PathEnd end() {
    if (waiting_ > 0) settle();
    return end_;
  }

 private:
  static constexpr int across = 1 - direction;

  VITREL_INLINE void put(int k, int lane, std::uint32_t name, const Many& dx, const Many& dy,
                         const detail::PathProfile<Many>& other, const Many& xy, const Many& yy,
                         const Many& det, const Many& earliest) {
    name_[k] = name;
    dx_[k] = dx[lane], dy_[k] = dy[lane];
    other_height_[k] = other.height[lane];
    other_slant_[k] = other.slant[lane];
    other_waist_[k] = other.waist[lane];
    xy_[k] = xy[lane], yy_[k] = yy[lane], det_[k] = det[lane];
    earliest_[k] = earliest[lane];
  }

  // Step 3 for those that wait.
  [[gnu::noinline]] void settle() {
    constexpr int most_steps = 64;  // halving alone comes to the last digit
    const Many dx = dx_.all(), dy = dy_.all();
    const Many height = other_height_.all(), slant = other_slant_.all(), waist = other_waist_.all();
    const Many inverse = 1. / sqrt(yy_.all());
    const Many middle = xy_.all() * inverse, width = sqrt(det_.all()) * inverse;
    const Many curvature1(height_ * waist_ * (height_ * waist_));
    const Many curvature2 = height * waist * (height * waist);
    Many v = dy * inverse, low(-1), high(1);
    Many free(-std::numeric_limits<double>::infinity());
    const Asked asked = detail::lane_numbers<many> < waiting_ && earliest_.all() < latest_;
    for (int step = 0; step < most_steps; ++step) {
      const Many c = sqrt(max(1. - v * v, Many(0)));
      const Many s = (width * v - middle * c) * inverse;
      const Many along1 = height_ * s + slant_ * c, along2 = height * s + slant * c;
      const Many across1 = waist_ * c, across2 = waist * c;
      const Many support1 = sqrt(across1 * across1 + along1 * along1);
      const Many support2 = sqrt(across2 * across2 + along2 * along2);
      const Many inverse1 = 1. / support1, inverse2 = 1. / support2;
      const Many now = dx + (s * dy - support1 - support2) / c;
      where(now > free, free) = now;
      // Of f by s/c, and of that slope.
      const Many slope = dy - height_ * along1 * inverse1 - height * along2 * inverse2;
      const Many bend = curvature1 * (inverse1 * inverse1 * inverse1) +
                        curvature2 * (inverse2 * inverse2 * inverse2);
      const Asked good = slope * slope <= 2 * tolerance_ * bend * (c * c * c);
      if (none_of(asked && !good && free < end_.length)) break;
      where(slope > 0., low) = v;
      where(!(slope > 0.), high) = v;
      Many next = v + slope / (bend * width * inverse);
      where(!(next > low && next < high), next) = 0.5 * (low + high);
      v = next;
    }
    for (int lane = 0; lane < waiting_; ++lane) {
      const double length = std::max<double>(free[lane], 0);
      if (asked[lane] && length < end_.length) end_ = {length, name_[lane], dx_[lane] - length};
    }
    if (end_.length < latest_) latest_ = end_.length;
    waiting_ = 0;
  }

  double circumradius_, height_, slant_, waist_;  // enlarged by the gap
  double latest_;                                 // nothing later is of interest
  double tolerance_;
  PathEnd end_;
  int waiting_ = 0;
  std::uint32_t name_[many];
  detail::NumbersOf<many> dx_, dy_, other_height_, other_slant_, other_waist_;
  detail::NumbersOf<many> xy_, yy_, det_, earliest_;
};

/// The same among round particles.
template <int direction>
class RoundPathLook {
 public:
  using Asked = Many::mask_type;

  RoundPathLook(const Ellipse& shape, const Vec2& /*axis*/, double gap, double longest)
      : radius_(shape.a + gap), longest_(longest), length_(longest) {}

  double reach_behind(double /*largest*/) const { return 0; }
  double reach_aside(double largest) const { return radius_ + largest; }
  double reach_ahead(double largest) const { return longest_ + radius_ + largest; }

  VITREL_INLINE void look(const EllipseGroup& group, std::uint32_t first_name, const Vec2& offset,
                          Asked asked) {
    using detail::one_of;
    const Many dx = one_of<direction>(group.x, group.y) + offset[direction];
    const Many dy = one_of<1 - direction>(group.x, group.y) + offset[1 - direction];
    const Many reach = group.a.all() + radius_;
    const Many room = reach * reach - dy * dy;
    const Many free = dx - sqrt(max(room, Many(0)));
    const Asked sooner = asked && room > 0. && dx > 0. && free < length_;
    where(sooner, length_) = free;
    where(sooner, ahead_) = dx;
    where(sooner, name_) = detail::lane_numbers<many> + static_cast<double>(first_name);
  }

  PathEnd end() const {
    const double shortest = hmin(length_), length = std::max(shortest, 0.);
    const int lane = find_first_set(length_ == shortest);
    if (name_[lane] < 0) return {length, PathEnd::nobody, 0};
    return {length, static_cast<std::uint32_t>(static_cast<double>(name_[lane])),
            ahead_[lane] - length};
  }

 private:
  double radius_, longest_;
  Many length_, ahead_{0}, name_{-1};
};

}  // namespace vitrel

#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/contact/ellipsoid_overlap_batch.h"
#include "core/contact/round_free_path_batch.h"

/// @file
/// The free path of event-chain Monte Carlo for ellipsoids, in SIMD batches: how far one ellipsoid can move along x, y
/// or z, at a fixed orientation, before it touches another one that is at rest. ellipse_free_path_batch.h is the
/// counterpart in the plane.
///
/// Let e point along the path, d from centre 1 to centre 2, and n = e + s with s normal to e. The gap along n stays
/// positive up to the path length
///
///     f(s) = n·d − √(nᵀΣ₁n) − √(nᵀΣ₂n).
///
/// Every s proves a free path. f is concave, and its maximum is the contact.
///
/// Steps:
///   1. Circumspheres that never meet ahead, or not before the end of the path, decide most pairs.
///   2. The ellipsoid Q = Σ₁/q + Σ₂/(1 − q), 0 < q < 1, contains the Minkowski sum of the two bodies. If the line
///      misses Q, or leaves it behind, there is no contact; otherwise the path up to Q is free, and the normal of Q
///      there is the first n. The normal C⁻¹d, C = q(1 − q)Q, may also prove that the other body lies behind.
///   3. The remaining pairs are solved in batches, by Newton's method for s. A step that does not increase f is
///      replaced by the normal of Q where the line enters it, with q : 1 − q = √(nᵀΣ₁n) : √(nᵀΣ₂n) at the best n.
///      √(nᵀQn) equals the sum of the two roots at this n and is nowhere below it, so f is larger at the new normal
///      unless n is its maximum.
///
/// Contact is declared when the surfaces are between `gap` and (a₁/c₁ + ¼) `gap` apart, to the rounding of the
/// coordinates, because the first body is enlarged by the factor 1 + gap/c₁. A pair that is already closer, and
/// approaching, touches at once.
namespace vitrel {

/// The free path along x (`direction` 0), y (1) or z (2).
template <int direction>
class EllipsoidFreePathBatch {
 public:
  using Mask = SimdBatch::Mask;

  /// `bodies` are all particles and must outlive the batch; `max_length` > 0 limits the path.
  EllipsoidFreePathBatch(const OrientedEllipsoid& body, const OrientedEllipsoid* bodies, double gap,
                         double max_length)
      : bodies_(bodies),
        tolerance_(0.25 * gap),
        closest_(-2 * gap * body.shape.circumradius() / body.shape.inradius()),
        end_{max_length, FreePath::none, 0} {
    const double enlarged = 1 + gap / body.shape.inradius();
    circumradius_ = enlarged * body.shape.circumradius();
    for (int k = 0; k < 6; ++k) sigma_[k] = enlarged * enlarged * body.shape_matrix[entry[k]];
  }

  /// Returns how far behind, aside or ahead of the moving body the centre of a particle that can end the path may be,
  /// if no semi-axis exceeds `largest`.
  double reach_behind(double largest) const { return std::sqrt(sigma_[ee]) + largest; }
  double reach_aside(double largest) const {
    return std::sqrt(std::max(sigma_[uu], sigma_[vv])) + largest;
  }
  double reach_ahead(double largest) const { return end_.length + std::sqrt(sigma_[ee]) + largest; }

  /// Adds the ellipsoids in the lanes of `mask`. The separations d are `offset` + their positions, their ids are
  /// `first_id` + lane, and group.particle holds their numbers among all bodies.
  template <class Group>
  VITREL_INLINE void add(const Group& group, std::uint32_t first_id, const Vec3& offset,
                         const Mask& mask) {
    const SimdBatch d[] = {group.template coordinate<e>() + offset[e],
                           group.template coordinate<u>() + offset[u],
                           group.template coordinate<v>() + offset[v]};
    const SimdBatch reach = group.circumradii() + circumradius_;
    const SimdBatch chord_squared = reach * reach - d[1] * d[1] - d[2] * d[2];
    const SimdBatch half_chord = sqrt(max(chord_squared, SimdBatch(0)));
    unsigned met =
        (mask && chord_squared > 0. && d[0] + half_chord > 0. && d[0] - half_chord < end_.length)
            .bits();
    for (; met; met &= met - 1) {
      const int lane = std::countr_zero(met);
      const OrientedEllipsoid& other = bodies_[group.particle[lane]];
      const int k = met_.count++;
      met_.id[k] = first_id + static_cast<std::uint32_t>(lane);
      for (int i = 0; i < 3; ++i) met_.d[i][k] = d[i][lane];
      for (int i = 0; i < 6; ++i) met_.sigma[i][k] = other.shape_matrix[entry[i]];
      met_.share[k] = circumradius_ / (circumradius_ + other.shape.circumradius());
      if (met_.count == simd_width) screen();
    }
  }

  /// Returns the free path among all ellipsoids added.
  FreePath end() {
    if (met_.count > 0) screen();
    if (open_.count > 0) solve();
    return end_;
  }

 private:
  // The coordinates along the path and across it.
  static constexpr int e = direction, u = (direction + 1) % 3, v = (direction + 2) % 3;
  // The entries of a symmetric matrix in these directions, and their places in OrientedEllipsoid::shape_matrix.
  enum Entry { ee, uu, vv, eu, ev, uv };
  static constexpr int entry[] = {e, u, v, e + u + 2, e + v + 2, u + v + 2};

  /// One pair per lane.
  struct Pairs {
    int count = 0;
    std::uint32_t id[simd_width];
    detail::BatchBuffer<simd_width> d[3], sigma[6], share, s[2];
  };
  struct Loaded {
    SimdBatch d[3], sigma[6];
    explicit Loaded(const Pairs& pairs) {
      for (int k = 0; k < 3; ++k) d[k] = pairs.d[k].load();
      for (int k = 0; k < 6; ++k) sigma[k] = pairs.sigma[k].load();
    }
  };
  /// Σn for n = (1, s), and √(nᵀΣn).
  struct Support {
    SimdBatch to_u, to_v, height;

    template <class T>
    VITREL_INLINE Support(const T (&sigma)[6], const SimdBatch& n, const SimdBatch& s,
                          const SimdBatch& r)
        : to_u(sigma[eu] * n + sigma[uu] * s + sigma[uv] * r),
          to_v(sigma[ev] * n + sigma[uv] * s + sigma[vv] * r),
          height(sqrt(n * (sigma[ee] * n + sigma[eu] * s + sigma[ev] * r) + s * to_u + r * to_v)) {}
  };
  /// Where the line enters the ellipsoid Q, and the normal of Q there.
  struct EntryPoint {
    Mask exists;
    SimdBatch length, s, r;
  };
  static constexpr double rounding = 1e-9;  // far above rounding in step 2, far below what matters

  VITREL_INLINE EntryPoint enter(const Loaded& pair, const SimdBatch& q, bool screens) const {
    const SimdBatch rest = 1. - q;
    SimdBatch c[6];
    for (int k = 0; k < 6; ++k) c[k] = rest * sigma_[k] + q * pair.sigma[k];
    const SimdBatch adj_ee = c[uu] * c[vv] - c[uv] * c[uv], adj_eu = c[ev] * c[uv] - c[eu] * c[vv],
                    adj_ev = c[eu] * c[uv] - c[ev] * c[uu], adj_uu = c[ee] * c[vv] - c[ev] * c[ev],
                    adj_vv = c[ee] * c[uu] - c[eu] * c[eu], adj_uv = c[eu] * c[ev] - c[ee] * c[uv];
    const SimdBatch inverse = 1. / (c[ee] * adj_ee + c[eu] * adj_eu + c[ev] * adj_ev);
    const auto& d = pair.d;
    // C⁻¹e and C⁻¹d.
    const SimdBatch w_e = inverse * adj_ee, w_u = inverse * adj_eu, w_v = inverse * adj_ev;
    const SimdBatch y_e = inverse * (adj_ee * d[0] + adj_eu * d[1] + adj_ev * d[2]),
                    y_u = inverse * (adj_eu * d[0] + adj_uu * d[1] + adj_uv * d[2]),
                    y_v = inverse * (adj_ev * d[0] + adj_uv * d[1] + adj_vv * d[2]);
    const SimdBatch along = d[0] * y_e + d[1] * y_u + d[2] * y_v, size = 1. / (q * rest);
    const SimdBatch half_chord_squared = y_e * y_e - w_e * (along - size);
    const SimdBatch unit = rounding * (w_e * size);
    const SimdBatch n_e = sqrt(max(half_chord_squared, rounding * unit));
    EntryPoint point;
    point.exists = half_chord_squared > -unit;
    if (screens) {
      const SimdBatch reach =
          Support(sigma_, y_e, y_u, y_v).height + Support(pair.sigma, y_e, y_u, y_v).height;
      point.exists = point.exists && !(y_e < 0. && along > (1 + rounding) * reach);
    }
    point.length = (y_e - n_e) / w_e;
    point.s = (y_u - point.length * w_u) / n_e;
    point.r = (y_v - point.length * w_v) / n_e;
    return point;
  }

  // Performs step 2 for all pairs in met_.
  [[gnu::noinline]] VITREL_FLATTEN void screen() {
    const EntryPoint point = enter(Loaded(met_), met_.share.load(), true);
    unsigned left = (point.exists && point.length < end_.length + rounding * circumradius_).bits() &
                    ((1u << met_.count) - 1);
    for (; left; left &= left - 1) {
      const int lane = std::countr_zero(left), k = open_.count++;
      open_.id[k] = met_.id[lane];
      for (int i = 0; i < 3; ++i) open_.d[i][k] = met_.d[i][lane];
      for (int i = 0; i < 6; ++i) open_.sigma[i][k] = met_.sigma[i][lane];
      open_.share[k] = met_.share[lane];
      open_.s[0][k] = point.s[lane], open_.s[1][k] = point.r[lane];
      if (open_.count == simd_width) solve();
    }
    met_.count = 0;
  }

  // Performs step 3 for all pairs in open_.
  [[gnu::noinline]] VITREL_FLATTEN void solve() {
    constexpr int max_steps = 64;
    const Loaded pair(open_);
    const Mask mask = detail::lane_indices<simd_width>() < open_.count;
    SimdBatch s = open_.s[0].load(), r = open_.s[1].load(), q = open_.share.load();
    SimdBatch free_length(-std::numeric_limits<double>::infinity()), distance = free_length;
    for (int step = 0; step < max_steps; ++step) {
      const Support one(sigma_, 1., s, r), two(pair.sigma, 1., s, r);
      const SimdBatch now = pair.d[0] + s * pair.d[1] + r * pair.d[2] - one.height - two.height;
      const SimdBatch norm = sqrt(1. + s * s + r * r);
      const Mask better = now > free_length;
      free_length = select(better, now, free_length);
      distance = select(better, now / norm, distance);
      q = select(better, one.height / (one.height + two.height), q);

      // This is the Newton step from the gradient of f and its negated second derivatives h.
      const SimdBatch inverse1 = 1. / one.height, inverse2 = 1. / two.height;
      const SimdBatch u1 = one.to_u * inverse1, v1 = one.to_v * inverse1, u2 = two.to_u * inverse2,
                      v2 = two.to_v * inverse2;
      const SimdBatch slope_u = pair.d[1] - u1 - u2, slope_v = pair.d[2] - v1 - v2;
      const SimdBatch h_uu =
                          inverse1 * (sigma_[uu] - u1 * u1) + inverse2 * (pair.sigma[uu] - u2 * u2),
                      h_vv =
                          inverse1 * (sigma_[vv] - v1 * v1) + inverse2 * (pair.sigma[vv] - v2 * v2),
                      h_uv =
                          inverse1 * (sigma_[uv] - u1 * v1) + inverse2 * (pair.sigma[uv] - u2 * v2);
      const SimdBatch inverse = 1. / (h_uu * h_vv - h_uv * h_uv);
      const SimdBatch step_u = inverse * (h_vv * slope_u - h_uv * slope_v),
                      step_v = inverse * (h_uu * slope_v - h_uv * slope_u);
      const SimdBatch twice_missing = step_u * slope_u + step_v * slope_v;
      const Mask converged = twice_missing >= 0. && twice_missing <= 2 * tolerance_ * norm;
      const Mask open = mask && !converged && free_length < end_.length;
      if (none_of(open)) break;
      s = s + step_u, r = r + step_v;
      if (none_of(open && !better)) continue;
      const EntryPoint point = enter(pair, q, false);
      s = select(better, s, point.s);
      r = select(better, r, point.r);
      free_length = select(better || point.exists, free_length,
                           SimdBatch(std::numeric_limits<double>::infinity()));
    }
    for (int lane = 0; lane < open_.count; ++lane) {
      const double length = std::max<double>(free_length[lane], 0);
      if (distance[lane] > closest_ && length < end_.length)
        end_ = {length, open_.id[lane], open_.d[0][lane] - length};
    }
    open_.count = 0;
  }

  const OrientedEllipsoid* bodies_;
  double circumradius_, sigma_[6];  // enlarged by the gap
  double tolerance_;
  double closest_;  // minus the largest overlap of the enlarged body at a contact
  FreePath end_;
  Pairs met_, open_;
};

}  // namespace vitrel

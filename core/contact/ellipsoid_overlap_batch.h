#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "core/contact/ellipsoid_gap.h"
#include "core/contact/sphere_batch.h"

/// @file
/// The overlap test of trial moves for ellipsoids, in SIMD batches: whether one ellipsoid keeps a margin to all of
/// several others at rest. ellipse_overlap_batch.h is the counterpart in the plane. Each answer is proved; the cheapest
/// proofs come first.
///
///   1. Circumspheres a margin apart prove the pair separated; overlapping inspheres prove an overlap. For spheres this
///      decides all pairs except those that are closer than the margin without overlap.
///   2. The remaining pairs are collected and decided in batches, by C = (1−λ)Σ₁ + λΣ₂ and y = C⁻¹d for some 0 < λ < 1,
///      with hᵢ² = yᵀΣᵢy:
///          y·d − h₁ − h₂ ≥ margin |y|: y is the normal of a gap of at least the margin;
///          (1−λ)h₁ < 1 and λh₂ < 1: the point (1−λ)Σ₁y from centre 1, which is λΣ₂y from centre 2, lies in both.
///      λ : 1−λ = h₁ : h₂ is a fixed point where F(λ) of Perram and Wertheim is largest (perram_wertheim.h), and one of
///      the two conditions then holds unless the pair touches. A few steps decide nearly all pairs.
///   3. separated() (ellipsoid_gap.h) decides the remaining pairs one by one.
///
/// Both proofs of step 2 must hold with a margin of 10⁻¹³ (a/c)³ relative to the longest semi-axis, which is far above
/// the rounding; a is the longest and c the shortest semi-axis of the pair. Every step therefore gives the answer of
/// separated().
///
/// Source: perram1985.
namespace vitrel {

/// An ellipsoid at rest, without its position.
struct OrientedEllipsoid {
  Ellipsoid shape;
  Quaternion orientation;
  double shape_matrix[6];  ///< xx, yy, zz, xy, xz, yz

  OrientedEllipsoid(const Ellipsoid& body, const Quaternion& q) : shape(body), orientation(q) {
    const Mat3 sigma = vitrel::shape_matrix(body, q);
    const double entries[] = {sigma(0, 0), sigma(1, 1), sigma(2, 2),
                              sigma(0, 1), sigma(0, 2), sigma(1, 2)};
    std::ranges::copy(entries, shape_matrix);
  }
};

class EllipsoidOverlapBatch {
 public:
  /// A set of lanes: bit k is lane k.
  using Lanes = unsigned;

  /// `bodies` are all particles; they and `body` must outlive the batch. Requires margin ≥ 0.
  EllipsoidOverlapBatch(const OrientedEllipsoid& body, const OrientedEllipsoid* bodies,
                        double margin)
      : body_(body),
        bodies_(bodies),
        margin_(margin),
        outer_(body.shape.circumradius()),
        inner_(body.shape.inradius()) {}

  /// Returns false if the body is known to be closer than the margin to one of the ellipsoids in these lanes; pairs
  /// that are not decided yet wait for a full batch. The separations d are `offset` + the positions of the ellipsoids,
  /// and group.particle holds their numbers among all bodies. Adds the number of pairs that step 3 decided to
  /// `scalar_tests`.
  template <class Group>
  VITREL_INLINE bool may_be_clear_of(const Group& group, const Vec3& offset, Lanes lanes,
                                     std::uint64_t& scalar_tests) {
    const SimdBatch dx = group.template coordinate<0>() + offset.x(),
                    dy = group.template coordinate<1>() + offset.y(),
                    dz = group.template coordinate<2>() + offset.z();
    const SimdBatch distance_squared = dx * dx + dy * dy + dz * dz;
    const SimdBatch outer = group.outer.load() + (outer_ + margin_);
    Lanes undecided = lanes & (distance_squared < outer * outer).bits();
    if (!undecided) return true;
    const SimdBatch inner = group.inner.load() + inner_;
    if (undecided & (distance_squared < inner * inner).bits()) return false;
    for (; undecided; undecided &= undecided - 1) {
      const int lane = std::countr_zero(undecided);
      push(group.particle[lane], {dx[lane], dy[lane], dz[lane]});
      if (pending_ == simd_width && !pending_are_clear(scalar_tests)) return false;
    }
    return true;
  }

  /// Returns whether the body keeps the margin to the ellipsoids that still wait.
  VITREL_INLINE bool rest_is_clear(std::uint64_t& scalar_tests) {
    return pending_ == 0 || pending_are_clear(scalar_tests);
  }

 private:
  static constexpr double rounding = 1e-13;
  static constexpr int max_steps = 8;
  struct Verdict {
    Lanes separated, overlapping;
  };
  /// A symmetric matrix: xx, yy, zz, xy, xz, yz.
  template <class T>
  using Symmetric = T[6];

  VITREL_INLINE void push(std::uint32_t particle, const Vec3& d) {
    particle_[pending_] = particle;
    for (int k = 0; k < 3; ++k) d_[k][pending_] = d[k];
    const OrientedEllipsoid& other = bodies_[particle];
    for (int k = 0; k < 6; ++k) sigma_[k][pending_] = other.shape_matrix[k];
    radius_[pending_] = other.shape.circumradius();
    inradius_[pending_] = other.shape.inradius();
    ++pending_;
  }

  [[gnu::noinline]] VITREL_FLATTEN bool pending_are_clear(std::uint64_t& scalar_tests) {
    Lanes undecided = (1u << pending_) - 1;
    pending_ = 0;
    const SimdBatch radius = radius_.load(), longest = max(radius, SimdBatch(outer_));
    const SimdBatch ratio = longest / min(inradius_.load(), SimdBatch(inner_));
    const SimdBatch slack = rounding * (ratio * ratio * ratio);
    SimdBatch lambda = outer_ / (radius + outer_);
    for (int step = 0; step < max_steps && undecided; ++step) {
      const Verdict found = judge(lambda, slack, slack * longest + margin_);
      if (undecided & found.overlapping) return false;
      undecided &= ~found.separated;
    }
    return !undecided || clear_by_scalar_tests(undecided, scalar_tests);
  }

  /// Performs step 2 at these λ and replaces them by the next ones.
  VITREL_INLINE Verdict judge(SimdBatch& lambda, const SimdBatch& slack, const SimdBatch& margin) {
    const SimdBatch rest = 1. - lambda;
    Symmetric<SimdBatch> two, c;
    for (int k = 0; k < 6; ++k) {
      two[k] = sigma_[k].load();
      c[k] = rest * body_.shape_matrix[k] + lambda * two[k];
    }
    const SimdBatch d[] = {d_[0].load(), d_[1].load(), d_[2].load()};
    const SimdBatch adj_xx = c[1] * c[2] - c[5] * c[5], adj_xy = c[4] * c[5] - c[3] * c[2],
                    adj_xz = c[3] * c[5] - c[4] * c[1];
    const SimdBatch inverse = 1. / (c[0] * adj_xx + c[3] * adj_xy + c[4] * adj_xz);
    const SimdBatch adj_yy = c[0] * c[2] - c[4] * c[4], adj_zz = c[0] * c[1] - c[3] * c[3],
                    adj_yz = c[3] * c[4] - c[0] * c[5];
    const SimdBatch y[] = {inverse * (adj_xx * d[0] + adj_xy * d[1] + adj_xz * d[2]),
                           inverse * (adj_xy * d[0] + adj_yy * d[1] + adj_yz * d[2]),
                           inverse * (adj_xz * d[0] + adj_yz * d[1] + adj_zz * d[2])};
    const SimdBatch h1 = sqrt(form(body_.shape_matrix, y)), h2 = sqrt(form(two, y));
    const SimdBatch length = sqrt(y[0] * y[0] + y[1] * y[1] + y[2] * y[2]);
    const SimdBatch along = y[0] * d[0] + y[1] * d[1] + y[2] * d[2];
    const SimdBatch inside = 1. - slack;
    const Verdict verdict{(along - (h1 + h2) > margin * length).bits(),
                          (rest * h1 < inside && lambda * h2 < inside).bits()};
    lambda = h1 / (h1 + h2);
    return verdict;
  }

  /// yᵀΣy
  template <class Matrix>
  VITREL_INLINE static SimdBatch form(const Matrix& sigma, const SimdBatch (&y)[3]) {
    return sigma[0] * (y[0] * y[0]) + sigma[1] * (y[1] * y[1]) + sigma[2] * (y[2] * y[2]) +
           2. * (sigma[3] * (y[0] * y[1]) + sigma[4] * (y[0] * y[2]) + sigma[5] * (y[1] * y[2]));
  }

  bool clear_by_scalar_tests(Lanes undecided, std::uint64_t& scalar_tests) const {
    for (; undecided; undecided &= undecided - 1) {
      const int lane = std::countr_zero(undecided);
      const OrientedEllipsoid& other = bodies_[particle_[lane]];
      ++scalar_tests;
      if (!separated(body_.shape, body_.orientation, other.shape, other.orientation,
                     {d_[0][lane], d_[1][lane], d_[2][lane]}, margin_))
        return false;
    }
    return true;
  }

  const OrientedEllipsoid& body_;
  const OrientedEllipsoid* bodies_;
  double margin_, outer_, inner_;
  int pending_ = 0;
  std::uint32_t particle_[simd_width];
  detail::BatchBuffer<simd_width> d_[3], sigma_[6], radius_, inradius_;
};

}  // namespace vitrel

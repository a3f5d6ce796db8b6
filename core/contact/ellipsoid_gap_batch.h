#pragma once

#include <limits>

#include "core/contact/ellipsoid_batch.h"
#include "core/contact/gap_batch.h"

namespace vitrel {

/// The batch for ellipsoids computes the gap along (Σ₁ + Σ₂)⁻¹d, which for long bodies is close to the normal of both.
/// While some gap is below the limit, it turns the axes by up to two Newton steps and keeps the largest gap.
template <>
class GapBatch<Ellipsoid> {
 public:
  static constexpr int lanes = simd_width;

  GapBatch(const Ellipsoid& shape, const Quaternion& orientation, double limit)
      : axes_(detail::axes_of(orientation, shape.semi_axes)), limit_(limit) {}

  VITREL_INLINE void set(int k, const Ellipsoid& shape, const Quaternion& orientation,
                         const Vec3& d) {
    d_.set(k, d);
    partners_.set(k, orientation, shape.semi_axes);
  }

  VITREL_FLATTEN void evaluate() {
    constexpr int steps = 2;
    const detail::BatchVec3 d = d_.load();
    const AxesOf<SimdBatch> partners =
        detail::scaled(detail::directions_of(partners_.orientations()), partners_.semi_axes.load());
    detail::BatchVec3 trial = initial_axes(partners, d), best = trial;
    SimdBatch largest = -std::numeric_limits<double>::infinity();
    for (int step = 0; step <= steps; ++step) {
      const AxisOf<SimdBatch> axis = completed(trial);
      const auto one = support_along<SimdBatch>(axes_, axis);
      const auto two = support_along<SimdBatch>(partners, axis);
      const SimdBatch gap = dot(axis.n, d) - (one.height + two.height);
      const auto better = gap > largest;
      largest = select(better, gap, largest);
      best.x = select(better, trial.x, best.x);
      best.y = select(better, trial.y, best.y);
      best.z = select(better, trial.z, best.z);
      if (all_of(largest > limit_)) break;
      trial = detail::turned(axis, dot(axis.e1, d) - (one.s1 + two.s1),
                             dot(axis.e2, d) - (one.s2 + two.s2), gap + (one.h11 + two.h11),
                             one.h12 + two.h12, gap + (one.h22 + two.h22), one.height + two.height);
    }
    gap_.store(largest);
    n_.store(best);
  }

  double gap(int k) const { return gap_[k]; }
  Vec3 axis(int k) const { return n_[k]; }

 private:
  // Returns (Σ₁ + Σ₂)⁻¹d, which is the best axis of congruent parallel ellipsoids, and better than d for other
  // ellipsoids.
  VITREL_INLINE detail::BatchVec3 initial_axes(const AxesOf<SimdBatch>& partners,
                                               const detail::BatchVec3& d) const {
    const auto sum = [&](auto one, auto two) -> SimdBatch {
      const auto of = [&](const auto& axes) {
        return one(axes.first) * two(axes.first) + one(axes.second) * two(axes.second) +
               one(axes.third) * two(axes.third);
      };
      return of(axes_) + of(partners);
    };
    const auto x = [](const auto& v) { return v.x; };
    const auto y = [](const auto& v) { return v.y; };
    const auto z = [](const auto& v) { return v.z; };
    const SimdBatch xx = sum(x, x), yy = sum(y, y), zz = sum(z, z);
    const SimdBatch xy = sum(x, y), xz = sum(x, z), yz = sum(y, z);
    const detail::BatchVec3 w{
        (yy * zz - yz * yz) * d.x + (xz * yz - xy * zz) * d.y + (xy * yz - xz * yy) * d.z,
        (xz * yz - xy * zz) * d.x + (xx * zz - xz * xz) * d.y + (xy * xz - xx * yz) * d.z,
        (xy * yz - xz * yy) * d.x + (xy * xz - xx * yz) * d.y + (xx * yy - xy * xy) * d.z};
    const SimdBatch square = dot(w, w);
    const detail::BatchVec3 axis = detail::times(SimdBatch(1. / sqrt(square)), w);
    // Where the centres coincide, any axis gives a lower bound.
    const auto coincide = square == SimdBatch(0.);
    const SimdBatch zero = 0.;
    return {select(coincide, SimdBatch(1.), axis.x), select(coincide, zero, axis.y),
            select(coincide, zero, axis.z)};
  }

  AxesOf<double> axes_;
  double limit_;
  detail::Vec3Buffer d_, n_;
  detail::EllipsoidBuffer partners_;
  detail::BatchBuffer<simd_width> gap_;
};

}  // namespace vitrel

#pragma once

#include <concepts>

#include "core/contact/contact_screen.h"
#include "core/contact/ellipsoid_pair.h"
#include "core/contact/gap_batch.h"

/// The looks at several others (first_look.h, gap_look.h) for ellipsoids.
namespace vitrel {

namespace detail {

using BatchVec3 = Vec3Of<SimdBatch>;

/// A vector for each of several pairs, filled one by one.
struct Vec3Buffer {
  BatchBuffer<simd_width> x, y, z;
  void set(int k, const Vec3& v) { x[k] = v.x(), y[k] = v.y(), z[k] = v.z(); }
  Vec3 operator[](int k) const { return {x[k], y[k], z[k]}; }
  BatchVec3 load() const { return {x.load(), y.load(), z.load()}; }
  void store(const BatchVec3& v) { x.store(v.x), y.store(v.y), z.store(v.z); }
};

/// Ellipsoids of several pairs, filled one by one.
struct EllipsoidBuffer {
  BatchBuffer<simd_width> w;  ///< of the quaternions, and
  Vec3Buffer xyz, semi_axes;
  void set(int k, const Quaternion& q, const Vec3& axes) {
    w[k] = q.w();
    xyz.set(k, q.vec());
    semi_axes.set(k, axes);
  }

  /// Unit vectors along the axes.
  VITREL_INLINE AxesOf<SimdBatch> directions() const {
    const SimdBatch qw = w.load(), x = xyz.x.load(), y = xyz.y.load(), z = xyz.z.load();
    const SimdBatch x2 = 2. * x, y2 = 2. * y, z2 = 2. * z;
    const SimdBatch xx = x * x2, yy = y * y2, zz = z * z2;
    const SimdBatch xy = x * y2, xz = x * z2, yz = y * z2;
    const SimdBatch wx = qw * x2, wy = qw * y2, wz = qw * z2;
    return {{1. - (yy + zz), xy + wz, xz - wy},
            {xy - wz, 1. - (xx + zz), yz + wx},
            {xz + wy, yz - wx, 1. - (xx + yy)}};
  }
};

template <class T>
VITREL_INLINE Vec3Of<T> times(const T& factor, const Vec3Of<T>& v) {
  return {factor * v.x, factor * v.y, factor * v.z};
}

template <class T>
VITREL_INLINE AxesOf<T> scaled(const AxesOf<T>& directions, const Vec3Of<T>& lengths) {
  return {times(lengths.x, directions.first), times(lengths.y, directions.second),
          times(lengths.z, directions.third)};
}

inline AxesOf<double> axes_of(const Quaternion& orientation, const Vec3& semi_axes) {
  const Mat3 turn = orientation.toRotationMatrix();
  return {components(semi_axes[0] * turn.col(0)), components(semi_axes[1] * turn.col(1)),
          components(semi_axes[2] * turn.col(2))};
}

/// Unit vectors, turned by one step of Newton's method on the sphere, as far as it can be trusted: the
/// step C⁻¹ s in the plane of e₁ and e₂, or uphill where C is not positive.
VITREL_INLINE BatchVec3 turned(const AxisOf<SimdBatch>& axis, const SimdBatch& s1,
                               const SimdBatch& s2, const SimdBatch& c11, const SimdBatch& c12,
                               const SimdBatch& c22) {
  constexpr double longest = 0.5;
  const SimdBatch det = c11 * c22 - c12 * c12;
  const auto peaked = det > 0 && c11 + c22 > 0;
  SimdBatch step1 = s1, step2 = s2;
  where(peaked, step1) = (c22 * s1 - c12 * s2) / det;
  where(peaked, step2) = (c11 * s2 - c12 * s1) / det;
  const SimdBatch length = sqrt(step1 * step1 + step2 * step2);
  SimdBatch kept = 1;
  where(length > longest, kept) = longest / length;
  step1 *= kept;
  step2 *= kept;
  const SimdBatch q = 0.25 * (step1 * step1 + step2 * step2);
  const SimdBatch scale = 1. / (1. + q);
  const SimdBatch on = (1. - q) * scale, f1 = scale * step1, f2 = scale * step2;
  return {on * axis.n.x + f1 * axis.e1.x + f2 * axis.e2.x,
          on * axis.n.y + f1 * axis.e1.y + f2 * axis.e2.y,
          on * axis.n.z + f1 * axis.e1.z + f2 * axis.e2.z};
}

}  // namespace detail

template <Body B>
requires std::same_as<BaseShape<B>, Ellipsoid>
class ContactScreen<B> : public detail::CandidateTimes<simd_width> {
  /// As for ellipses.
  static constexpr double min_gap_fraction = 0.5;

 public:
  static constexpr int lanes = simd_width;
  static constexpr bool is_exact = false;
  struct WarmStart {
    Vec3 axis;
    friend WarmStart reversed(const WarmStart& warm_start) { return {-warm_start.axis}; }
  };

  ContactScreen(const ShapeCoefficients<Ellipsoid>& coefficients, const Pose3& pose,
                const Motion3& motion, const CommonSize& common, double contact_gap)
      : coefficients_(coefficients),
        motion_(motion),
        common_(common),
        min_gap_(min_gap_fraction * contact_gap) {
    axes_ = detail::axes_of(pose.orientation, coefficients.semi_axes);
    const Vec3 own = pose.orientation.conjugate() * motion.angular_velocity;
    const Vec3 squares = coefficients.semi_axes.cwiseAbs2();
    tau_ = tumbling<double>(components(own.normalized()), components(squares));
  }

  VITREL_INLINE void set(int k, const Pose3& pose, const Motion3& motion,
                         const ShapeCoefficients<Ellipsoid>& coefficients,
                         const WarmStart& warm_start, double horizon) {
    d_.set(k, pose.position);
    v_.set(k, motion.velocity - motion_.velocity);
    partners_.set(k, pose.orientation, coefficients.semi_axes);
    omega_.set(k, motion.angular_velocity);
    aa_minus_cc_[k] = coefficients.aa_minus_cc;
    cc_[k] = coefficients.cc;
    n_.set(k, warm_start.axis);
    horizon_[k] = horizon;
  }
  WarmStart warm_start(int k) const { return {n_[k]}; }

  [[gnu::flatten]] void evaluate(int count) {
    using detail::BatchVec3;
    const AxisOf<SimdBatch> axis = completed(n_.load());
    const BatchVec3 d = d_.load(), omega = omega_.load(), lengths = partners_.semi_axes.load();
    const AxesOf<SimdBatch> directions = partners_.directions();
    const auto one = support_along<SimdBatch>(axes_, axis);
    const auto two = support_along<SimdBatch>(detail::scaled(directions, lengths), axis);
    const auto spin1 = spin_along<SimdBatch>(components(motion_.angular_velocity), axis);
    const auto spin2 = spin_along<SimdBatch>(omega, axis);
    const auto rates1 = support_rates<SimdBatch>(one, spin1),
               rates2 = support_rates<SimdBatch>(two, spin2);
    const SimdBatch horizon = horizon_.load();
    const SimdBatch heights = one.height + two.height, turning = rates1.rate + rates2.rate;
    const SimdBatch gap = dot(axis.n, d) - sized(heights);
    SimdBatch rate = dot(axis.n, v_.load()) - sized(turning);
    SimdBatch acceleration =
        support_acceleration_bound<SimdBatch>(one, rates1, spin1, coefficients_.aa_minus_cc, tau_,
                                              coefficients_.cc, horizon) +
        support_acceleration_bound<SimdBatch>(two, rates2, spin2, aa_minus_cc_.load(),
                                              tau_of(directions, omega, lengths), cc_.load(),
                                              horizon);
    if constexpr (grows<B>) {
      const double growth = common_.growth_rate;
      rate -= growth * heights;
      acceleration =
          (common_.size + std::abs(growth) * horizon) * acceleration + 2 * growth * turning;
    }
    set_times(detail::first_root(gap - min_gap_, rate, acceleration, horizon), count);
    n_.store(detail::turned(
        axis, dot(axis.e1, d) - sized(one.s1 + two.s1), dot(axis.e2, d) - sized(one.s2 + two.s2),
        gap + sized(one.h11 + two.h11), sized(one.h12 + two.h12), gap + sized(one.h22 + two.h22)));
  }

 private:
  VITREL_INLINE SimdBatch sized(const SimdBatch& x) const {
    if constexpr (grows<B>) return common_.size * x;
    return x;
  }

  VITREL_INLINE static SimdBatch tau_of(const AxesOf<SimdBatch>& directions,
                                        const detail::BatchVec3& omega,
                                        const detail::BatchVec3& lengths) {
    constexpr double at_rest = 1e-300;
    const SimdBatch inverse = 1. / max(sqrt(dot(omega, omega)), SimdBatch(at_rest));
    return tumbling<SimdBatch>(
        {dot(directions.first, omega) * inverse, dot(directions.second, omega) * inverse,
         dot(directions.third, omega) * inverse},
        {lengths.x * lengths.x, lengths.y * lengths.y, lengths.z * lengths.z});
  }

  ShapeCoefficients<Ellipsoid> coefficients_;
  Motion3 motion_;
  CommonSize common_;
  double min_gap_;
  AxesOf<double> axes_;
  double tau_;
  detail::Vec3Buffer d_, v_, omega_, n_;
  detail::EllipsoidBuffer partners_;
  detail::BatchBuffer<simd_width> aa_minus_cc_, cc_, horizon_;
};

/// Along (Σ₁ + Σ₂)⁻¹d, of long bodies discard to the normal of both, turned by up to two steps as far as
/// each improves the gap: only as long as some gap is below the limit.
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

  [[gnu::flatten]] void evaluate() {
    constexpr int steps = 2;
    const detail::BatchVec3 d = d_.load();
    const AxesOf<SimdBatch> partners =
        detail::scaled(partners_.directions(), partners_.semi_axes.load());
    detail::BatchVec3 trial = initial_axes(partners, d), best = trial;
    SimdBatch largest = -std::numeric_limits<double>::infinity();
    for (int step = 0; step <= steps; ++step) {
      const AxisOf<SimdBatch> axis = completed(trial);
      const auto one = support_along<SimdBatch>(axes_, axis);
      const auto two = support_along<SimdBatch>(partners, axis);
      const SimdBatch gap = dot(axis.n, d) - (one.height + two.height);
      const auto better = gap > largest;
      where(better, largest) = gap;
      where(better, best.x) = trial.x;
      where(better, best.y) = trial.y;
      where(better, best.z) = trial.z;
      if (all_of(largest > limit_)) break;
      trial = detail::turned(axis, dot(axis.e1, d) - (one.s1 + two.s1),
                             dot(axis.e2, d) - (one.s2 + two.s2), gap + (one.h11 + two.h11),
                             one.h12 + two.h12, gap + (one.h22 + two.h22));
    }
    gap_.store(largest);
    n_.store(best);
  }

  double gap(int k) const { return gap_[k]; }
  Vec3 axis(int k) const { return n_[k]; }

 private:
  // (Σ₁ + Σ₂)⁻¹d: the best axis of congruent parallel ellipsoids, and better than d for others.
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
    return detail::times(SimdBatch(1. / sqrt(dot(w, w))), w);
  }

  AxesOf<double> axes_;
  double limit_;
  detail::Vec3Buffer d_, n_;
  detail::EllipsoidBuffer partners_;
  detail::BatchBuffer<simd_width> gap_;
};

}  // namespace vitrel

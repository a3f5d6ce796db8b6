#pragma once

#include <concepts>

#include "core/contact/ellipsoid_pair.h"
#include "core/contact/first_look.h"
#include "core/contact/gap_look.h"

/// The looks at several others (first_look.h, gap_look.h) for ellipsoids.
namespace vitrel {

namespace detail {

using ManyVec3 = Vec3Of<Many>;

/// A vector for each of several pairs, filled one by one.
struct VectorsOf {
  NumbersOf<many> x, y, z;
  void set(int k, const Vec3& v) { x[k] = v.x(), y[k] = v.y(), z[k] = v.z(); }
  Vec3 operator[](int k) const { return {x[k], y[k], z[k]}; }
  ManyVec3 all() const { return {x.all(), y.all(), z.all()}; }
  void store(const ManyVec3& v) { x.store(v.x), y.store(v.y), z.store(v.z); }
};

/// Ellipsoids of several pairs, filled one by one.
struct EllipsoidsOf {
  NumbersOf<many> w;  ///< of the quaternions, and
  VectorsOf xyz, semi_axes;
  void set(int k, const Quaternion& q, const Vec3& axes) {
    w[k] = q.w();
    xyz.set(k, q.vec());
    semi_axes.set(k, axes);
  }

  /// Unit vectors along the axes.
  VITREL_INLINE AxesOf<Many> directions() const {
    const Many qw = w.all(), x = xyz.x.all(), y = xyz.y.all(), z = xyz.z.all();
    const Many x2 = 2. * x, y2 = 2. * y, z2 = 2. * z;
    const Many xx = x * x2, yy = y * y2, zz = z * z2;
    const Many xy = x * y2, xz = x * z2, yz = y * z2;
    const Many wx = qw * x2, wy = qw * y2, wz = qw * z2;
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
VITREL_INLINE ManyVec3 turned(const AxisOf<Many>& axis, const Many& s1, const Many& s2,
                              const Many& c11, const Many& c12, const Many& c22) {
  constexpr double longest = 0.5;
  const Many det = c11 * c22 - c12 * c12;
  const auto peaked = det > 0 && c11 + c22 > 0;
  Many step1 = s1, step2 = s2;
  where(peaked, step1) = (c22 * s1 - c12 * s2) / det;
  where(peaked, step2) = (c11 * s2 - c12 * s1) / det;
  const Many length = sqrt(step1 * step1 + step2 * step2);
  Many kept = 1;
  where(length > longest, kept) = longest / length;
  step1 *= kept;
  step2 *= kept;
  const Many q = 0.25 * (step1 * step1 + step2 * step2);
  const Many scale = 1. / (1. + q);
  const Many on = (1. - q) * scale, f1 = scale * step1, f2 = scale * step2;
  return {on * axis.n.x + f1 * axis.e1.x + f2 * axis.e2.x,
          on * axis.n.y + f1 * axis.e1.y + f2 * axis.e2.y,
          on * axis.n.z + f1 * axis.e1.z + f2 * axis.e2.z};
}

}  // namespace detail

template <Body B>
requires std::same_as<Grown<B>, Ellipsoid>
class FirstLook<B> : public detail::Urgencies<many> {
  /// As for ellipses.
  static constexpr double open_gap = 0.5;

 public:
  static constexpr int lanes = many;
  static constexpr bool is_exact = false;
  struct Memory {
    Vec3 axis;
    friend Memory reversed(const Memory& memory) { return {-memory.axis}; }
  };

  FirstLook(const Outline<Ellipsoid>& outline, const Pose3& pose, const Motion3& motion,
            const CommonSize& common, double contact_gap)
      : outline_(outline), motion_(motion), common_(common), floor_(open_gap * contact_gap) {
    axes_ = detail::axes_of(pose.orientation, outline.semi_axes);
    const Vec3 own = pose.orientation.conjugate() * motion.angular_velocity;
    const Vec3 squares = outline.semi_axes.cwiseAbs2();
    tau_ = tumbling<double>(components(own.normalized()), components(squares));
  }

  VITREL_INLINE void set(int k, const Pose3& pose, const Motion3& motion,
                         const Outline<Ellipsoid>& outline, const Memory& memory, double horizon) {
    d_.set(k, pose.position);
    v_.set(k, motion.velocity - motion_.velocity);
    partners_.set(k, pose.orientation, outline.semi_axes);
    omega_.set(k, motion.angular_velocity);
    stretch_[k] = outline.stretch;
    shortest_squared_[k] = outline.shortest_squared;
    n_.set(k, memory.axis);
    horizon_[k] = horizon;
  }
  Memory memory(int k) const { return {n_[k]}; }

  [[gnu::flatten]] void look(int count) {
    using detail::ManyVec3;
    const AxisOf<Many> axis = completed(n_.all());
    const ManyVec3 d = d_.all(), omega = omega_.all(), lengths = partners_.semi_axes.all();
    const AxesOf<Many> directions = partners_.directions();
    const auto one = support_along<Many>(axes_, axis);
    const auto two = support_along<Many>(detail::scaled(directions, lengths), axis);
    const auto spin1 = spin_along<Many>(components(motion_.angular_velocity), axis);
    const auto spin2 = spin_along<Many>(omega, axis);
    const auto rates1 = support_rates<Many>(one, spin1), rates2 = support_rates<Many>(two, spin2);
    const Many horizon = horizon_.all();
    const Many heights = one.height + two.height, turning = rates1.rate + rates2.rate;
    const Many gap = dot(axis.n, d) - sized(heights);
    Many rate = dot(axis.n, v_.all()) - sized(turning);
    Many bend =
        bend_bound<Many>(one, rates1, spin1, outline_.stretch, tau_, outline_.shortest_squared,
                         horizon) +
        bend_bound<Many>(two, rates2, spin2, stretch_.all(), tau_of(directions, omega, lengths),
                         shortest_squared_.all(), horizon);
    if constexpr (grows<B>) {
      const double growth = common_.growth_rate;
      rate -= growth * heights;
      bend = (common_.size + std::abs(growth) * horizon) * bend + 2 * growth * turning;
    }
    open(detail::first_root(gap - floor_, rate, bend, horizon), count);
    n_.store(detail::turned(
        axis, dot(axis.e1, d) - sized(one.s1 + two.s1), dot(axis.e2, d) - sized(one.s2 + two.s2),
        gap + sized(one.h11 + two.h11), sized(one.h12 + two.h12), gap + sized(one.h22 + two.h22)));
  }

 private:
  VITREL_INLINE Many sized(const Many& x) const {
    if constexpr (grows<B>) return common_.size * x;
    return x;
  }

  VITREL_INLINE static Many tau_of(const AxesOf<Many>& directions, const detail::ManyVec3& omega,
                                   const detail::ManyVec3& lengths) {
    constexpr double at_rest = 1e-300;
    const Many inverse = 1. / max(sqrt(dot(omega, omega)), Many(at_rest));
    return tumbling<Many>(
        {dot(directions.first, omega) * inverse, dot(directions.second, omega) * inverse,
         dot(directions.third, omega) * inverse},
        {lengths.x * lengths.x, lengths.y * lengths.y, lengths.z * lengths.z});
  }

  Outline<Ellipsoid> outline_;
  Motion3 motion_;
  CommonSize common_;
  double floor_;
  AxesOf<double> axes_;
  double tau_;
  detail::VectorsOf d_, v_, omega_, n_;
  detail::EllipsoidsOf partners_;
  detail::NumbersOf<many> stretch_, shortest_squared_, horizon_;
};

/// Along (Σ₁ + Σ₂)⁻¹d, of long bodies close to the normal of both, turned by up to two steps as far as
/// each improves the gap: only as long as some gap is below the limit.
template <>
class GapLook<Ellipsoid> {
 public:
  static constexpr int lanes = many;

  GapLook(const Ellipsoid& shape, const Quaternion& orientation, double limit)
      : axes_(detail::axes_of(orientation, shape.semi_axes)), limit_(limit) {}

  VITREL_INLINE void set(int k, const Ellipsoid& shape, const Quaternion& orientation,
                         const Vec3& d) {
    d_.set(k, d);
    partners_.set(k, orientation, shape.semi_axes);
  }

  [[gnu::flatten]] void look() {
    constexpr int steps = 2;
    const detail::ManyVec3 d = d_.all();
    const AxesOf<Many> partners = detail::scaled(partners_.directions(), partners_.semi_axes.all());
    detail::ManyVec3 trial = likely_axes(partners, d), best = trial;
    Many largest = -std::numeric_limits<double>::infinity();
    for (int step = 0; step <= steps; ++step) {
      const AxisOf<Many> axis = completed(trial);
      const auto one = support_along<Many>(axes_, axis);
      const auto two = support_along<Many>(partners, axis);
      const Many gap = dot(axis.n, d) - (one.height + two.height);
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
  VITREL_INLINE detail::ManyVec3 likely_axes(const AxesOf<Many>& partners,
                                             const detail::ManyVec3& d) const {
    const auto sum = [&](auto one, auto two) -> Many {
      const auto of = [&](const auto& axes) {
        return one(axes.first) * two(axes.first) + one(axes.second) * two(axes.second) +
               one(axes.third) * two(axes.third);
      };
      return of(axes_) + of(partners);
    };
    const auto x = [](const auto& v) { return v.x; };
    const auto y = [](const auto& v) { return v.y; };
    const auto z = [](const auto& v) { return v.z; };
    const Many xx = sum(x, x), yy = sum(y, y), zz = sum(z, z);
    const Many xy = sum(x, y), xz = sum(x, z), yz = sum(y, z);
    const detail::ManyVec3 w{
        (yy * zz - yz * yz) * d.x + (xz * yz - xy * zz) * d.y + (xy * yz - xz * yy) * d.z,
        (xz * yz - xy * zz) * d.x + (xx * zz - xz * xz) * d.y + (xy * xz - xx * yz) * d.z,
        (xy * yz - xz * yy) * d.x + (xy * xz - xx * yz) * d.y + (xx * yy - xy * xy) * d.z};
    return detail::times(Many(1. / sqrt(dot(w, w))), w);
  }

  AxesOf<double> axes_;
  double limit_;
  detail::VectorsOf d_, n_;
  detail::EllipsoidsOf partners_;
  detail::NumbersOf<many> gap_;
};

}  // namespace vitrel

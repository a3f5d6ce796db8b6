#pragma once

#include <concepts>

#include "core/contact/contact_screen.h"
#include "core/contact/ellipsoid_batch.h"

/// @file
/// The contact screen (contact_screen.h) of ellipsoids.
namespace vitrel {

template <Body B>
requires std::same_as<BaseShape<B>, Ellipsoid>
class ContactScreen<B> : public detail::CandidateTimes {
  /// As for ellipses (ellipse_contact_screen.h).
  static constexpr double min_gap_fraction = 0.5;

 public:
  static constexpr int lanes = simd_width;

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
                         const WarmStart<B>& warm_start, double horizon) {
    d_.set(k, pose.position);
    v_.set(k, motion.velocity - motion_.velocity);
    partners_.set(k, pose.orientation, coefficients.semi_axes);
    omega_.set(k, motion.angular_velocity);
    aa_minus_cc_[k] = coefficients.aa_minus_cc;
    cc_[k] = coefficients.cc;
    n_.set(k, warm_start.axis);
    horizon_[k] = horizon;
  }
  WarmStart<B> warm_start(int k) const { return {n_[k]}; }

  VITREL_FLATTEN void evaluate(int count) {
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

}  // namespace vitrel

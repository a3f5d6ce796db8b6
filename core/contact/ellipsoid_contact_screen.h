#pragma once

#include <concepts>

#include "core/contact/contact_screen.h"
#include "core/contact/ellipsoid_batch.h"

/// @file
/// The contact screen (contact_screen.h) of ellipsoids.
namespace vitrel {

template <Body B>
requires std::same_as<BaseShape<B>, Ellipsoid>
class ContactScreen<B> : public detail::CandidateTimes<simd_width> {
  /// A pair counts as open while its gap stays above this fraction of the contact gap (ellipse_contact_screen.h).
  static constexpr double min_gap_fraction = 0.5;

 public:
  static constexpr int lanes = simd_width;

  /// `mine` is the state of the body at the time `now`.
  ContactScreen(const ShapeCoefficients<Ellipsoid>& coefficients, const FlightRecord<B>& mine,
                double now, const CommonSize& common, double contact_gap)
      : coefficients_(coefficients),
        mine_(mine),
        now_(now),
        common_(common),
        min_gap_(min_gap_fraction * contact_gap),
        aa_minus_cc_(coefficients.aa_minus_cc),
        cc_(coefficients.cc) {
    const Vec3& lengths = coefficients.semi_axes;
    lengths_ = {lengths[0], lengths[1], lengths[2]};
    if constexpr (tumbles<B>) max_tumbling_ = coefficients.max_tumbling;
    axes_ = detail::axes_of(mine.orientation(), lengths);
    if constexpr (!tumbles<B>) {
      const Vec3 own = mine.orientation().conjugate() * mine.angular_velocity();
      tau_ = tumbling<double>(components(normalized(own)), components(lengths.cwiseAbs2()));
    }
  }

  void set_shape(int k, const ShapeCoefficients<Ellipsoid>& coefficients) {
    lengths_.x.set(k, coefficients.semi_axes[0]);
    lengths_.y.set(k, coefficients.semi_axes[1]);
    lengths_.z.set(k, coefficients.semi_axes[2]);
    aa_minus_cc_.set(k, coefficients.aa_minus_cc);
    cc_.set(k, coefficients.cc);
    if constexpr (tumbles<B>) max_tumbling_.set(k, coefficients.max_tumbling);
  }

  /// A tumbling partner keeps the orientation of its own time, from which its support function is bounded, so this time
  /// should not be long ago.
  VITREL_INLINE void load(const FlightRecord<B>* const (&partner)[lanes],
                          const WarmStart<B>* const (&warm_start)[lanes], double latest) {
    using Layout = RecordLayout<3>;
    SimdBatch record[Layout::size];
    detail::load_columns(partner, record);
    const SimdBatch since = now_ - record[Layout::time];
    const auto vector = [&](int first) {
      return detail::BatchVec3{record[first], record[first + 1], record[first + 2]};
    };
    const detail::BatchVec3 r = vector(Layout::position), v = vector(Layout::velocity);
    omega_ = vector(Layout::angular_velocity);
    d_ = {(r.x + since * v.x) - mine_.position.x(), (r.y + since * v.y) - mine_.position.y(),
          (r.z + since * v.z) - mine_.position.z()};
    v_ = {v.x - mine_.velocity.x(), v.y - mine_.velocity.y(), v.z - mine_.velocity.z()};
    q_ = {record[Layout::orientation + 3], vector(Layout::orientation)};
    if constexpr (tumbles<B>) {
      max_speed_ = record[Layout::max_angular_speed];
      since_ = since;
    } else {
      q_ = detail::rotated(q_, omega_, since);
    }
    horizon_ = detail::horizon_of(record[Layout::known_until], latest, now_);
    for (int k = 0; k < lanes; ++k) n_.set(k, warm_start[k]->axis);
  }
  WarmStart<B> warm_start(int k) const { return {n_[k]}; }

  VITREL_FLATTEN void evaluate(int count) {
    using detail::BatchVec3;
    const AxisOf<SimdBatch> axis = completed(n_.load());
    const BatchVec3 &d = d_, &omega = omega_, &lengths = lengths_;
    const AxesOf<SimdBatch> directions = detail::directions_of(q_);
    const auto one = support_along<SimdBatch>(axes_, axis);
    const auto two = support_along<SimdBatch>(detail::scaled(directions, lengths), axis);
    const auto spin1 = spin_along<SimdBatch>(components(mine_.angular_velocity()), axis);
    const auto spin2 = spin_along<SimdBatch>(omega, axis);
    const auto rates1 = support_rates<SimdBatch>(one, spin1),
               rates2 = support_rates<SimdBatch>(two, spin2);
    const SimdBatch& horizon = horizon_;
    SimdBatch heights = one.height + two.height, turning = rates1.rate + rates2.rate, acceleration;
    if constexpr (tumbles<B>) {
      const double speed = mine_.rotation.max_angular_speed;
      const SimdBatch theirs = max_speed_ * max_speed_ * max_tumbling_;
      acceleration = speed * speed * coefficients_.max_tumbling + theirs;
      heights += since_ * (rates2.rate + 0.5 * theirs * since_);
      turning += theirs * since_;
    } else {
      acceleration =
          support_acceleration_bound<SimdBatch>(one, rates1, spin1, coefficients_.aa_minus_cc, tau_,
                                                coefficients_.cc, horizon) +
          support_acceleration_bound<SimdBatch>(two, rates2, spin2, aa_minus_cc_,
                                                tau_of(directions, omega, lengths), cc_, horizon);
    }
    const SimdBatch gap = dot(axis.n, d) - sized(heights);
    SimdBatch rate = dot(axis.n, v_) - sized(turning);
    if constexpr (grows<B>) {
      const double growth = common_.growth_rate;
      rate -= growth * heights;
      acceleration =
          (common_.size + std::abs(growth) * horizon) * acceleration + 2 * growth * turning;
    }
    set_times(detail::first_root(gap - min_gap_, rate, acceleration, horizon), horizon, count);
    n_.store(detail::turned(axis, dot(axis.e1, d) - sized(one.s1 + two.s1),
                            dot(axis.e2, d) - sized(one.s2 + two.s2),
                            gap + sized(one.h11 + two.h11), sized(one.h12 + two.h12),
                            gap + sized(one.h22 + two.h22), sized(one.height + two.height)));
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
  FlightRecord<B> mine_;
  double now_;
  CommonSize common_;
  double min_gap_;
  AxesOf<double> axes_;
  double tau_;
  detail::BatchVec3 d_, v_, omega_, lengths_;
  detail::BatchQuaternion q_;
  detail::Vec3Buffer n_;
  SimdBatch aa_minus_cc_, cc_, max_tumbling_, max_speed_, since_, horizon_;
};

}  // namespace vitrel

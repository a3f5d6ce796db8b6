#pragma once

#include <concepts>

#include "core/contact/contact_screen.h"
#include "core/contact/ellipse_pair.h"

/// @file
/// The contact screen (contact_screen.h) of ellipses.
namespace vitrel {

template <Body B>
requires std::same_as<BaseShape<B>, Ellipse>
class ContactScreen<B> : public detail::CandidateTimes<2 * simd_width> {
  /// A pair counts as open while its gap stays above this fraction of the contact gap, so that the screen also rules
  /// out a contact of a pair that has just collided and now separates.
  static constexpr double min_gap_fraction = 0.5;
  using Batch = Simd<2 * simd_width>;

 public:
  static constexpr int lanes = 2 * simd_width;

  /// `mine` is the state of the body at the time `now`.
  ContactScreen(const ShapeCoefficients<Ellipse>& coefficients, const FlightRecord<B>& mine,
                double now, const CommonSize& common, double contact_gap)
      : coefficients_(coefficients),
        mine_(mine),
        now_(now),
        common_(common),
        min_gap_(min_gap_fraction * contact_gap),
        bb_(coefficients.bb),
        aa_minus_bb_(coefficients.aa_minus_bb),
        aabb_(coefficients.aabb),
        max_second_derivative_(coefficients.max_second_derivative) {
    const Vec2 u = direction(mine.orientation());
    ux_ = u.x();
    uy_ = u.y();
  }

  void set_shape(int k, const ShapeCoefficients<Ellipse>& coefficients) {
    bb_.set(k, coefficients.bb);
    aa_minus_bb_.set(k, coefficients.aa_minus_bb);
    aabb_.set(k, coefficients.aabb);
    max_second_derivative_.set(k, coefficients.max_second_derivative);
  }

  VITREL_INLINE void load(const FlightRecord<B>* const (&partner)[lanes],
                          const WarmStart<B>* const (&warm_start)[lanes], double latest) {
    using Layout = RecordLayout<2>;
    Batch record[Layout::size], axis[2];
    detail::load_columns(partner, record);
    detail::load_columns(warm_start, axis);
    const Batch since = now_ - record[Layout::time];
    const Batch &vx = record[Layout::velocity], &vy = record[Layout::velocity + 1];
    omega_ = record[Layout::angular_velocity];
    dx_ = (record[0] + since * vx) - mine_.position.x();
    dy_ = (record[1] + since * vy) - mine_.position.y();
    vx_ = vx - mine_.velocity.x();
    vy_ = vy - mine_.velocity.y();
    angle_ = record[Layout::orientation] + since * omega_;
    horizon_ = detail::horizon_of(record[Layout::known_until], latest, now_);
    nx_ = axis[0];
    ny_ = axis[1];
  }
  WarmStart<B> warm_start(int k) const { return {{nx_[k], ny_[k]}}; }

  VITREL_FLATTEN void evaluate(int count) {
    const Batch nx = nx_, ny = ny_, horizon = horizon_;
    const Batch omega1 = mine_.angular_velocity(), omega2 = omega_;
    Batch ux, uy;
    directions<Batch>(angle_, ux, uy);
    const auto one = support_along<Batch>(coefficients_.bb, coefficients_.aa_minus_bb,
                                          coefficients_.aabb, ux_, uy_, nx, ny);
    const auto two = support_along<Batch>(bb_, aa_minus_bb_, aabb_, ux, uy, nx, ny);
    const Batch heights = one.height + two.height;
    const Batch spin = omega1 * one.turning + omega2 * two.turning;
    const Batch gap = nx * dx_ + ny * dy_ - sized(heights);
    Batch rate = nx * vx_ + ny * vy_ + sized(spin);
    Batch acceleration =
        support_acceleration_bound<Batch>(one, coefficients_.bb, coefficients_.aa_minus_bb, omega1,
                                          omega1 * omega1 * coefficients_.max_second_derivative,
                                          horizon) +
        support_acceleration_bound<Batch>(two, bb_, aa_minus_bb_, omega2,
                                          omega2 * omega2 * max_second_derivative_, horizon);
    if constexpr (grows<B>) {
      const double growth = common_.growth_rate;
      rate -= growth * heights;
      acceleration = common_.size * acceleration + std::abs(growth) * horizon * abs(acceleration) -
                     2 * growth * spin;
    }
    set_times(detail::first_root(gap - min_gap_, rate, acceleration, horizon), horizon, count);
    detail::newton_rotate(nx_, ny_, nx * dy_ - ny * dx_ - sized(one.turning + two.turning),
                          gap + sized(one.radius + two.radius));
  }

 private:
  VITREL_INLINE Batch sized(const Batch& x) const {
    if constexpr (grows<B>) return common_.size * x;
    return x;
  }

  ShapeCoefficients<Ellipse> coefficients_;
  FlightRecord<B> mine_;
  double now_;
  CommonSize common_;
  double min_gap_;
  double ux_, uy_;
  Batch dx_, dy_, vx_, vy_, angle_, omega_, nx_, ny_, horizon_;
  Batch bb_, aa_minus_bb_, aabb_, max_second_derivative_;
};

}  // namespace vitrel

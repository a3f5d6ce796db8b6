#pragma once

#include <concepts>

#include "core/contact/contact_screen.h"
#include "core/contact/ellipse_pair.h"

/// @file
/// The contact screen (contact_screen.h) of ellipses.
namespace vitrel {

template <Body B>
requires std::same_as<BaseShape<B>, Ellipse>
class ContactScreen<B> : public detail::CandidateTimes {
  /// A pair counts as open while its gap stays above this fraction of the contact gap, so that a pair that
  /// has just collided and now separates is settled too.
  static constexpr double min_gap_fraction = 0.5;

 public:
  static constexpr int lanes = simd_width;

  ContactScreen(const ShapeCoefficients<Ellipse>& coefficients, const Pose2& pose,
                const Motion2& motion, const CommonSize& common, double contact_gap)
      : coefficients_(coefficients),
        motion_(motion),
        common_(common),
        min_gap_(min_gap_fraction * contact_gap) {
    PairArray x, y;
    directions<PairArray>({pose.angle, pose.angle}, x, y);
    ux_ = x[0];
    uy_ = y[0];
  }

  VITREL_INLINE void set(int k, const Pose2& pose, const Motion2& motion,
                         const ShapeCoefficients<Ellipse>& coefficients,
                         const WarmStart<B>& warm_start, double horizon) {
    dx_[k] = pose.position.x();
    dy_[k] = pose.position.y();
    vx_[k] = motion.velocity.x() - motion_.velocity.x();
    vy_[k] = motion.velocity.y() - motion_.velocity.y();
    angle_[k] = pose.angle;
    omega_[k] = motion.angular_velocity;
    bb_[k] = coefficients.bb;
    aa_minus_bb_[k] = coefficients.aa_minus_bb;
    aabb_[k] = coefficients.aabb;
    max_second_derivative_[k] = coefficients.max_second_derivative;
    nx_[k] = warm_start.axis.x();
    ny_[k] = warm_start.axis.y();
    horizon_[k] = horizon;
  }
  WarmStart<B> warm_start(int k) const { return {{nx_[k], ny_[k]}}; }

  VITREL_FLATTEN void evaluate(int count) {
    const SimdBatch nx = nx_.load(), ny = ny_.load(), dx = dx_.load(), dy = dy_.load();
    const SimdBatch bb = bb_.load(), aa_minus_bb = aa_minus_bb_.load(), omega2 = omega_.load();
    const SimdBatch omega1 = motion_.angular_velocity, horizon = horizon_.load();
    SimdBatch ux, uy;
    directions<SimdBatch>(angle_.load(), ux, uy);
    const auto one = support_along<SimdBatch>(coefficients_.bb, coefficients_.aa_minus_bb,
                                              coefficients_.aabb, ux_, uy_, nx, ny);
    const auto two = support_along<SimdBatch>(bb, aa_minus_bb, aabb_.load(), ux, uy, nx, ny);
    const SimdBatch heights = one.height + two.height;
    const SimdBatch spin = omega1 * one.turning + omega2 * two.turning;
    const SimdBatch gap = nx * dx + ny * dy - sized(heights);
    SimdBatch rate = nx * vx_.load() + ny * vy_.load() + sized(spin);
    SimdBatch acceleration =
        support_acceleration_bound<SimdBatch>(
            one, coefficients_.bb, coefficients_.aa_minus_bb, omega1,
            omega1 * omega1 * coefficients_.max_second_derivative, horizon) +
        support_acceleration_bound<SimdBatch>(
            two, bb, aa_minus_bb, omega2, omega2 * omega2 * max_second_derivative_.load(), horizon);
    if constexpr (grows<B>) {
      const double growth = common_.growth_rate;
      rate -= growth * heights;
      acceleration = common_.size * acceleration + std::abs(growth) * horizon * abs(acceleration) -
                     2 * growth * spin;
    }
    set_times(detail::first_root(gap - min_gap_, rate, acceleration, horizon), count);
    SimdBatch turned_nx = nx, turned_ny = ny;
    detail::newton_rotate(turned_nx, turned_ny,
                          nx * dy - ny * dx - sized(one.turning + two.turning),
                          gap + sized(one.radius + two.radius));
    nx_.store(turned_nx);
    ny_.store(turned_ny);
  }

 private:
  VITREL_INLINE SimdBatch sized(const SimdBatch& x) const {
    if constexpr (grows<B>) return common_.size * x;
    return x;
  }

  using Numbers = detail::BatchBuffer<simd_width>;

  ShapeCoefficients<Ellipse> coefficients_;
  Motion2 motion_;
  CommonSize common_;
  double min_gap_;
  double ux_, uy_;
  Numbers dx_, dy_, vx_, vy_, angle_, omega_, bb_, aa_minus_bb_, aabb_, max_second_derivative_, nx_,
      ny_, horizon_;
};

}  // namespace vitrel

#pragma once

#include <array>

#include "core/contact/ellipsoid_pair.h"
#include "core/contact/simd_batch.h"
#include "core/geometry/asymmetric_top.h"
#include "core/geometry/tumbling_ellipsoid.h"

/// @file
/// The rotation of the two ellipsoids of a pair in free flight. Both models offer
///
///     place(lane, shape, flight), complete()
///     go_to(time)           always from time 0, so that rounding does not accumulate
///     axes, omega           the semi-axes at size 1, and ω, at the time of go_to
///     add_angular_acceleration(rates, support, n)   adds the contribution of the change of ω to ḧ (ellipsoid_pair.h)
///     acceleration_bound(support, rates, spin, duration)   a bound of ḧ for `duration` from the present time, which
///                           may be negative
///     largest_acceleration, max_speed   the maxima of this bound over axes and durations, and of |ω|
namespace vitrel::detail {

inline void set_lane(Vec3Of<SimdPair>& v, int lane, const Vec3& value) {
  v.x.set(lane, value.x());
  v.y.set(lane, value.y());
  v.z.set(lane, value.z());
}

/// A rotation about a constant ω.
class UniformRotation {
 public:
  AxesOf<SimdPair> axes;
  Vec3Of<SimdPair> omega;

  template <class B>
  void place(int lane, const Ellipsoid& shape, const Flight<B>& flight) {
    const Mat3 turn = rotation_matrix(flight.pose.orientation);
    const Vec3& angular_velocity = flight.motion.angular_velocity;
    set_lane(axes.first, lane, shape.semi_axes[0] * turn.col(0));
    set_lane(axes.second, lane, shape.semi_axes[1] * turn.col(1));
    set_lane(axes.third, lane, shape.semi_axes[2] * turn.col(2));
    set_lane(omega, lane, angular_velocity);
    speed_.set(lane, norm(angular_velocity));
    set_lane(body_omega_, lane, turn.transpose() * angular_velocity);
    set_lane(squares_, lane, shape.semi_axes.cwiseAbs2());
    const double longest = shape.circumradius(), shortest = shape.inradius();
    aa_minus_cc_.set(lane, (longest - shortest) * (longest + shortest));
    cc_.set(lane, shortest * shortest);
  }

  void complete() {
    const auto divided = [&](const Vec3Of<SimdPair>& w) -> Vec3Of<SimdPair> {
      const SimdPair by = select(speed_ > 0, speed_, 1);
      return {w.x / by, w.y / by, w.z / by};
    };
    spin_axis_ = divided(omega);
    tau_ = tumbling<SimdPair>(divided(body_omega_), squares_);
    decompose(axes.first, 0);
    decompose(axes.second, 1);
    decompose(axes.third, 2);
  }

  void go_to(double time) {
    SimdPair cosine, sine;
    directions<SimdPair>(speed_ * time, cosine, sine);
    const auto turned = [&](int k) -> Vec3Of<SimdPair> {
      const Parts& p = parts_[k];
      return {p.along.x + cosine * p.across.x + sine * p.ahead.x,
              p.along.y + cosine * p.across.y + sine * p.ahead.y,
              p.along.z + cosine * p.across.z + sine * p.ahead.z};
    };
    axes = {turned(0), turned(1), turned(2)};
  }

  void add_angular_acceleration(SupportRates<SimdPair>&, const SupportOf<SimdPair>&,
                                const Axis3&) const {}

  SimdPair acceleration_bound(const SupportOf<SimdPair>& support,
                              const SupportRates<SimdPair>& rates, const SpinOf<SimdPair>& spin,
                              double duration) const {
    return support_acceleration_bound<SimdPair>(support, rates, spin, aa_minus_cc_, tau_, cc_,
                                                duration);
  }
  SimdPair largest_acceleration() const {
    return speed_ * speed_ * 0.5 *
           (aa_minus_cc_ + sqrt(aa_minus_cc_ * aa_minus_cc_ + tau_ * tau_)) / sqrt(cc_);
  }
  const SimdPair& max_speed() const { return speed_; }

 private:
  /// An axis that rotates about ω: its constant part along ω, the remainder at time 0, and the remainder a
  /// quarter rotation later.
  struct Parts {
    Vec3Of<SimdPair> along, across, ahead;
  };

  void decompose(const Vec3Of<SimdPair>& axis, int k) {
    const SimdPair along = dot(axis, spin_axis_);
    Parts& p = parts_[k];
    p.along = {along * spin_axis_.x, along * spin_axis_.y, along * spin_axis_.z};
    p.across = {axis.x - p.along.x, axis.y - p.along.y, axis.z - p.along.z};
    p.ahead = {spin_axis_.y * axis.z - spin_axis_.z * axis.y,
               spin_axis_.z * axis.x - spin_axis_.x * axis.z,
               spin_axis_.x * axis.y - spin_axis_.y * axis.x};
  }

  Vec3Of<SimdPair> spin_axis_;   ///< ω/|ω|
  SimdPair speed_;               ///< |ω|
  Vec3Of<SimdPair> body_omega_;  ///< ω along the axes of the body
  Vec3Of<SimdPair> squares_;     ///< squares of the semi-axes
  SimdPair aa_minus_cc_, cc_, tau_;
  Parts parts_[3];
};

/// A rotation by Euler's equations. In the frame of the body, n moves with ṅ = −ω × n, n̈ = −ω̇ × n − ω × ṅ and
/// d³n/dt³ = −ω̈ × n − 2 ω̇ × ṅ − ω × n̈, where |ω| ≤ Ω, |ω̇| ≤ f Ω² (asymmetric_top.h) and therefore |ω̈| ≤ 2 f²Ω³. As
/// |n| = 1, (a² + c²)/2 may be subtracted from the eigenvalues of S in h² = n·S n, whose magnitude is then at most
/// (a² − c²)/2:
///
///     |(h²)''|/2 = |ṅ·S ṅ + n·S n̈| ≤ (a² − c²) Ω² (1 + f/2)
///     |(h²)'''|/2 = |3 ṅ·S n̈ + n·S d³n/dt³| ≤ (a² − c²) Ω³ (1 + f) (2 + f).
class TumblingRotation {
 public:
  AxesOf<SimdPair> axes;
  Vec3Of<SimdPair> omega;

  void place(int lane, const Ellipsoid& shape, const Flight<TumblingEllipsoid>& flight) {
    semi_axes_[lane] = shape.semi_axes;
    tops_[lane] = flight.top;
    start_[lane] = flight.top_time;
    const double speed = flight.top.max_speed();
    const ShapeCoefficients<Ellipsoid> coefficients(shape);
    const double f = coefficients.max_angular_acceleration;
    max_speed_.set(lane, speed);
    largest_acceleration_.set(lane, speed * speed * coefficients.max_tumbling);
    cc_.set(lane, coefficients.cc);
    second_.set(lane, coefficients.aa_minus_cc * speed * speed * (1 + 0.5 * f));
    third_.set(lane, coefficients.aa_minus_cc * speed * speed * speed * (1 + f) * (2 + f));
  }
  void complete() {}

  void go_to(double time) {
    for (int lane = 0; lane < 2; ++lane) {
      const AsymmetricTop::State now = tops_[lane].at(start_[lane] + time);
      set_lane(axes.first, lane, semi_axes_[lane][0] * now.axes.col(0));
      set_lane(axes.second, lane, semi_axes_[lane][1] * now.axes.col(1));
      set_lane(axes.third, lane, semi_axes_[lane][2] * now.axes.col(2));
      set_lane(omega, lane, now.angular_velocity);
      set_lane(angular_acceleration_, lane, now.angular_acceleration);
    }
  }

  // Adds −x·(dω/dt × n) to ḧ.
  void add_angular_acceleration(SupportRates<SimdPair>& rates, const SupportOf<SimdPair>& support,
                                const Axis3& n) const {
    rates.second += support.s2 * dot(angular_acceleration_, n.e1) -
                    support.s1 * dot(angular_acceleration_, n.e2);
  }

  SimdPair acceleration_bound(const SupportOf<SimdPair>& support,
                              const SupportRates<SimdPair>& rates, const SpinOf<SimdPair>&,
                              double duration) const {
    return min(bounded_acceleration<SimdPair>(support, rates, second_, third_, cc_, duration),
               largest_acceleration_);
  }
  const SimdPair& largest_acceleration() const { return largest_acceleration_; }
  const SimdPair& max_speed() const { return max_speed_; }

 private:
  std::array<Vec3, 2> semi_axes_;
  std::array<AsymmetricTop, 2> tops_;
  std::array<double, 2> start_;  ///< times of the tops at time 0 of the flights
  Vec3Of<SimdPair> angular_acceleration_;
  SimdPair max_speed_, largest_acceleration_, cc_;
  SimdPair second_, third_;  // half the bounds of the derivatives of h²
};

}  // namespace vitrel::detail

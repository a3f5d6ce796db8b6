#pragma once

#include "core/contact/ellipsoid_gap.h"
#include "core/contact/ellipsoid_pair.h"
#include "core/geometry/body.h"

namespace vitrel {

/// Two ellipsoids in free flight, perhaps growing, and how their support gap changes along a fixed
/// axis n (ellipsoid_pair.h):
///
///     ġ = n·v − Σ (σ ḣ + γ h)
///     −g̈ = Σ (σ ḧ + 2 γ ḣ)
///
/// with σ the size, γ the growth rate, and h and its derivatives those at size 1.
template <class B>
class EllipsoidPairInFlight {
 public:
  using Axis = Axis3;
  struct Gap : GapAlongAxis3, SupportRates<Lanes> {
    SpinOf<Lanes> spin;
  };

  EllipsoidPairInFlight(const Flight<B>& one, const Flight<B>& two)
      : d0_(two.pose.position - one.pose.position),
        v_(two.motion.velocity - one.motion.velocity),
        size0_(size_of(one.body), size_of(two.body)),
        growth_(growth_of(one.body), growth_of(two.body)) {
    place_body(0, shape_of(one.body), one.pose.orientation, one.motion.angular_velocity);
    place_body(1, shape_of(two.body), two.pose.orientation, two.motion.angular_velocity);
    const auto divided = [&](const Vec3Of<Lanes>& w) -> Vec3Of<Lanes> {
      const Lanes by = (speed_ > 0).select(speed_, 1);
      return {w.x / by, w.y / by, w.z / by};
    };
    axle_ = divided(omega_);
    tau_ = tumbling<Lanes>(divided(own_), squares_);
    part(axes0_.first, 0);
    part(axes0_.second, 1);
    part(axes0_.third, 2);
    pair_.size = size0_;
  }

  const Vec3& d0() const { return d0_; }
  const Vec3& v() const { return v_; }
  /// Sum of the circumradii at time 0, and its rate of growth.
  double reach() const { return (longest_ * size0_).sum(); }
  double reach_growth() const { return (longest_ * growth_).sum(); }
  /// The time in which the bodies that grow do so by the gap and the present circumradii together:
  /// a scale of time for them, infinite if none grows.
  double doubling_time(double gap) const {
    return ((longest_ * pair_.size).sum() + gap) / (longest_ * growth_.max(0)).sum();
  }

  double time() const { return time_; }

  /// Goes to `time`, always from time 0, lest rounding add up.
  void go_to(double time) {
    time_ = time;
    pair_.d = d0_ + v_ * time;
    if constexpr (grows<B>) pair_.size = size0_ + growth_ * time;
    Lanes cosine, sine;
    directions<Lanes>(speed_ * time, cosine, sine);
    const auto turned = [&](int k) -> Vec3Of<Lanes> {
      const Parts& p = parts_[k];
      return {p.along.x + cosine * p.across.x + sine * p.ahead.x,
              p.along.y + cosine * p.across.y + sine * p.ahead.y,
              p.along.z + cosine * p.across.z + sine * p.ahead.z};
    };
    pair_.axes = {turned(0), turned(1), turned(2)};
  }
  void start_at(double time) { go_to(time); }

  Gap look(const Axis& n) const {
    Gap g;
    static_cast<GapAlongAxis3&>(g) = gap_along(pair_, n);
    g.spin = spin_along<Lanes>(omega_, n);
    static_cast<SupportRates<Lanes>&>(g) = support_rates<Lanes>(g, g.spin);
    return g;
  }
  Axis likely_axis() const { return detail::likely_axis(pair_); }
  detail::SoughtAxis3 find_separating_axis() const { return detail::find_separating_axis(pair_); }
  bool climb(Axis& n, Gap& here) const {
    if (!detail::climb(pair_, n, here)) return false;
    here = look(n);
    return true;
  }
  void settle(Axis& n, const Gap& here) const { detail::settle(pair_, n, here); }

  /// From centre 1 to its surface point with normal n.
  Vec3 arm1(const Axis& n) const {
    const SupportOf<Lanes> s = support_along<Lanes>(pair_.axes, n);
    return pair_.size[0] *
           (s.height[0] * vector(n.n) + s.s1[0] * vector(n.e1) + s.s2[0] * vector(n.e2));
  }

  /// ġ along the axis n, of which `g` is the gap.
  double gap_rate(const Axis& n, const Gap& g) const {
    return vector(n.n).dot(v_) - (pair_.size * g.rate + growth_ * g.height).sum();
  }

  /// d/dt of the gradient of g.
  Tangent slope_rate(const Axis& n, const Gap& g) const {
    return {vector(n.e1).dot(v_) + (pair_.size * g.mixed1 - growth_ * g.s1).sum(),
            vector(n.e2).dot(v_) + (pair_.size * g.mixed2 - growth_ * g.s2).sum()};
  }

  /// −g̈.
  double acceleration(const Gap& g) const {
    return (pair_.size * g.second + 2 * growth_ * g.rate).sum();
  }

  /// M with g(t + s) ≥ g + ġ s − ½ M s² for all s from 0 to `duration`, which may be negative (then
  /// looking back), as long as sizes stay ≥ 0: with K of bend_bound,
  ///     (σ + γ s)(h + ḣ s + ½ K s²)
  /// has the coefficient ½ σ K + γ ḣ of s² and ½ γ K of s³.
  double acceleration_bound(const Gap& g, double duration) const {
    const Lanes bend = bend_bound<Lanes>(g, g, g.spin, stretch_, tau_, shortest_squared_,
                                         Lanes::Constant(duration));
    if constexpr (!grows<B>) return bend.sum();
    return (pair_.size * bend + growth_.abs() * std::abs(duration) * bend + 2 * growth_ * g.rate)
        .sum();
  }

  /// The largest that acceleration_bound can be for any axis and a duration of at most 1.
  double largest_acceleration() const {
    const Lanes bend = speed_.square() * 0.5 *
                       (stretch_ + (stretch_.square() + tau_.square()).sqrt()) /
                       shortest_squared_.sqrt();
    return ((pair_.size + growth_.abs()) * bend + 2 * (growth_ * speed_).abs() * swing_).sum();
  }

 private:
  static const Ellipsoid& shape_of(const Ellipsoid& body) { return body; }
  static const Ellipsoid& shape_of(const GrowingEllipsoid& body) { return body.shape; }
  static double size_of(const Ellipsoid&) { return 1; }
  static double size_of(const GrowingEllipsoid& body) { return body.size; }
  static double growth_of(const Ellipsoid&) { return 0; }
  static double growth_of(const GrowingEllipsoid& body) { return body.growth_rate; }

  /// Of an axis that turns about ω: what stays, and what it has across at first and a quarter turn on.
  struct Parts {
    Vec3Of<Lanes> along, across, ahead;
  };

  static void set(Vec3Of<Lanes>& v, int lane, const Vec3& value) {
    v.x[lane] = value.x();
    v.y[lane] = value.y();
    v.z[lane] = value.z();
  }

  void place_body(int lane, const Ellipsoid& shape, const Quaternion& orientation,
                  const Vec3& angular_velocity) {
    const Mat3 turn = orientation.toRotationMatrix();
    set(axes0_.first, lane, shape.semi_axes[0] * turn.col(0));
    set(axes0_.second, lane, shape.semi_axes[1] * turn.col(1));
    set(axes0_.third, lane, shape.semi_axes[2] * turn.col(2));
    set(omega_, lane, angular_velocity);
    speed_[lane] = angular_velocity.norm();
    set(own_, lane, turn.transpose() * angular_velocity);
    set(squares_, lane, shape.semi_axes.cwiseAbs2());
    const double longest = shape.circumradius(), shortest = shape.inradius();
    longest_[lane] = longest;
    swing_[lane] = longest - shortest;
    stretch_[lane] = (longest - shortest) * (longest + shortest);
    shortest_squared_[lane] = shortest * shortest;
  }

  void part(const Vec3Of<Lanes>& axis, int k) {
    const Lanes along = dot(axis, axle_);
    Parts& p = parts_[k];
    p.along = {along * axle_.x, along * axle_.y, along * axle_.z};
    p.across = {axis.x - p.along.x, axis.y - p.along.y, axis.z - p.along.z};
    p.ahead = {axle_.y * axis.z - axle_.z * axis.y, axle_.z * axis.x - axle_.x * axis.z,
               axle_.x * axis.y - axle_.y * axis.x};
  }

  Vec3 d0_, v_;
  Lanes size0_, growth_;
  AxesOf<Lanes> axes0_;
  Vec3Of<Lanes> omega_, axle_;  ///< ω, ω/|ω|
  Lanes speed_;                 ///< |ω|
  Vec3Of<Lanes> own_;           ///< ω along the axes of the body
  Vec3Of<Lanes> squares_;       ///< of the semi-axes
  Lanes longest_, swing_, stretch_, shortest_squared_, tau_;
  Parts parts_[3];
  double time_ = 0;
  EllipsoidPair pair_;  // at time_
};

}  // namespace vitrel

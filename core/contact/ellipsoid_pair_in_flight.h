#pragma once

#include "core/contact/ellipsoid_gap.h"
#include "core/contact/ellipsoid_pair.h"
#include "core/geometry/body.h"

namespace vitrel {

/// Two ellipsoids in free flight, possibly growing, and the change of their support gap along a fixed axis n
/// (ellipsoid_pair.h):
///
///     ġ = n·v − Σ (σ ḣ + γ h)
///     −g̈ = Σ (σ ḧ + 2 γ ḣ)
///
/// with σ the size, γ the growth rate, and h and its derivatives at size 1.
template <class B>
class EllipsoidPairInFlight {
 public:
  using Axis = Axis3;
  struct Gap : GapAlongAxis3, SupportRates<PairArray> {
    SpinOf<PairArray> spin;
  };

  EllipsoidPairInFlight(const Flight<B>& one, const Flight<B>& two)
      : d0_(two.pose.position - one.pose.position),
        v_(two.motion.velocity - one.motion.velocity),
        size0_(size_of(one.body), size_of(two.body)),
        growth_(growth_of(one.body), growth_of(two.body)) {
    place_body(0, shape_of(one.body), one.pose.orientation, one.motion.angular_velocity);
    place_body(1, shape_of(two.body), two.pose.orientation, two.motion.angular_velocity);
    const auto divided = [&](const Vec3Of<PairArray>& w) -> Vec3Of<PairArray> {
      const PairArray by = (speed_ > 0).select(speed_, 1);
      return {w.x / by, w.y / by, w.z / by};
    };
    spin_axis_ = divided(omega_);
    tau_ = tumbling<PairArray>(divided(body_omega_), squares_);
    decompose(axes0_.first, 0);
    decompose(axes0_.second, 1);
    decompose(axes0_.third, 2);
    pair_.size = size0_;
  }

  const Vec3& d0() const { return d0_; }
  const Vec3& v() const { return v_; }
  /// Sum of the circumradii at time 0, and its rate of growth.
  double reach() const { return (circumradius_ * size0_).sum(); }
  double reach_growth() const { return (circumradius_ * growth_).sum(); }
  /// The time in which the growing bodies grow by the gap and their present circumradii together: their time
  /// scale, infinite if none grows.
  double doubling_time(double gap) const {
    return ((circumradius_ * pair_.size).sum() + gap) / (circumradius_ * growth_.max(0)).sum();
  }

  double time() const { return time_; }

  /// Moves to `time`, always from time 0, so that rounding does not accumulate.
  void go_to(double time) {
    time_ = time;
    pair_.d = d0_ + v_ * time;
    if constexpr (grows<B>) pair_.size = size0_ + growth_ * time;
    PairArray cosine, sine;
    directions<PairArray>(speed_ * time, cosine, sine);
    const auto turned = [&](int k) -> Vec3Of<PairArray> {
      const RotationParts& p = parts_[k];
      return {p.along.x + cosine * p.across.x + sine * p.ahead.x,
              p.along.y + cosine * p.across.y + sine * p.ahead.y,
              p.along.z + cosine * p.across.z + sine * p.ahead.z};
    };
    pair_.axes = {turned(0), turned(1), turned(2)};
  }
  void start_at(double time) { go_to(time); }

  Gap evaluate(const Axis& n) const {
    Gap g;
    static_cast<GapAlongAxis3&>(g) = gap_along(pair_, n);
    g.spin = spin_along<PairArray>(omega_, n);
    static_cast<SupportRates<PairArray>&>(g) = support_rates<PairArray>(g, g.spin);
    return g;
  }
  Axis initial_axis() const { return detail::initial_axis(pair_); }
  detail::SeparatingAxis3 find_separating_axis() const {
    return detail::find_separating_axis(pair_);
  }
  bool improve_axis(Axis& n, Gap& here) const {
    if (!detail::improve_axis(pair_, n, here)) return false;
    here = evaluate(n);
    return true;
  }
  void polish_axis(Axis& n, const Gap& here) const { detail::polish_axis(pair_, n, here); }

  /// From centre 1 to its surface point with normal n.
  Vec3 arm1(const Axis& n) const {
    const SupportOf<PairArray> s = support_along<PairArray>(pair_.axes, n);
    return pair_.size[0] *
           (s.height[0] * vector(n.n) + s.s1[0] * vector(n.e1) + s.s2[0] * vector(n.e2));
  }

  /// ġ along the axis n, where `g` is the gap.
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

  /// M with g(t + s) ≥ g + ġ s − ½ M s² for all s from 0 to `duration`, which may be negative (backwards), as long as
  /// the sizes stay ≥ 0. With the bound K of support_acceleration_bound,
  ///
  ///     (σ + γ s)(h + ḣ s + ½ K s²)
  ///
  /// has the coefficient ½ σ K + γ ḣ of s² and ½ γ K of s³.
  double acceleration_bound(const Gap& g, double duration) const {
    const PairArray acceleration = support_acceleration_bound<PairArray>(
        g, g, g.spin, aa_minus_cc_, tau_, cc_, PairArray::Constant(duration));
    if constexpr (!grows<B>) return acceleration.sum();
    return (pair_.size * acceleration + growth_.abs() * std::abs(duration) * acceleration +
            2 * growth_ * g.rate)
        .sum();
  }

  /// The maximum of acceleration_bound over all axes and durations up to 1.
  double largest_acceleration() const {
    const PairArray acceleration = speed_.square() * 0.5 *
                                   (aa_minus_cc_ + (aa_minus_cc_.square() + tau_.square()).sqrt()) /
                                   cc_.sqrt();
    return ((pair_.size + growth_.abs()) * acceleration +
            2 * (growth_ * speed_).abs() * max_support_rate_)
        .sum();
  }

 private:
  static const Ellipsoid& shape_of(const Ellipsoid& body) { return body; }
  static const Ellipsoid& shape_of(const GrowingEllipsoid& body) { return body.shape; }
  static double size_of(const Ellipsoid&) { return 1; }
  static double size_of(const GrowingEllipsoid& body) { return body.size; }
  static double growth_of(const Ellipsoid&) { return 0; }
  static double growth_of(const GrowingEllipsoid& body) { return body.growth_rate; }

  /// An axis that rotates about ω: its constant part along ω, the remainder at time 0, and the remainder a
  /// quarter rotation later.
  struct RotationParts {
    Vec3Of<PairArray> along, across, ahead;
  };

  static void set(Vec3Of<PairArray>& v, int lane, const Vec3& value) {
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
    set(body_omega_, lane, turn.transpose() * angular_velocity);
    set(squares_, lane, shape.semi_axes.cwiseAbs2());
    const double longest = shape.circumradius(), shortest = shape.inradius();
    circumradius_[lane] = longest;
    max_support_rate_[lane] = longest - shortest;
    aa_minus_cc_[lane] = (longest - shortest) * (longest + shortest);
    cc_[lane] = shortest * shortest;
  }

  void decompose(const Vec3Of<PairArray>& axis, int k) {
    const PairArray along = dot(axis, spin_axis_);
    RotationParts& p = parts_[k];
    p.along = {along * spin_axis_.x, along * spin_axis_.y, along * spin_axis_.z};
    p.across = {axis.x - p.along.x, axis.y - p.along.y, axis.z - p.along.z};
    p.ahead = {spin_axis_.y * axis.z - spin_axis_.z * axis.y,
               spin_axis_.z * axis.x - spin_axis_.x * axis.z,
               spin_axis_.x * axis.y - spin_axis_.y * axis.x};
  }

  Vec3 d0_, v_;
  PairArray size0_, growth_;
  AxesOf<PairArray> axes0_;
  Vec3Of<PairArray> omega_, spin_axis_;  ///< ω, ω/|ω|
  PairArray speed_;                      ///< |ω|
  Vec3Of<PairArray> body_omega_;         ///< ω along the axes of the body
  Vec3Of<PairArray> squares_;            ///< of the semi-axes
  PairArray circumradius_, max_support_rate_, aa_minus_cc_, cc_, tau_;
  RotationParts parts_[3];
  double time_ = 0;
  EllipsoidPair pair_;  // at time_
};

}  // namespace vitrel

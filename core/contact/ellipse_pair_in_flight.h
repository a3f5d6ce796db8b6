#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "core/contact/support_gap.h"

namespace vitrel {

/// Two ellipses in free flight, perhaps growing, and how their support gap changes along a fixed
/// axis n.
///
///     ġ = n·v + Σ (σ ω h' − γ h)
///     −g̈ = Σ (σ ω² (ρ − h) − 2 γ ω h')
///
/// with σ the size, γ the growth rate, h' = dh/dφ, ρ = h + h'' (at size 1): turning a body by dθ is
/// turning n by −dθ, so that dh/dt = −ω h' and d²h/dt² = ω² h''.
template <class B>
class EllipsePairInFlight {
 public:
  using Axis = Vec2;
  using Gap = GapAlongAxis;

  /// Else sizes are 1 and stay so, which the compiler makes use of.
  static constexpr bool grows = !std::is_same_v<B, Ellipse>;

  EllipsePairInFlight(const Flight<B>& one, const Flight<B>& two)
      : d0_(two.pose.position - one.pose.position),
        v_(two.motion.velocity - one.motion.velocity),
        angle0_(one.pose.angle, two.pose.angle),
        omega_(one.motion.angular_velocity, two.motion.angular_velocity),
        size0_(size_of(one.body), size_of(two.body)),
        growth_(growth_of(one.body), growth_of(two.body)) {
    const Ellipse& shape1 = shape_of(one.body);
    const Ellipse& shape2 = shape_of(two.body);
    a_ = {shape1.a, shape2.a};
    const Lanes b(shape1.b, shape2.b);
    pair_.size = size0_;
    pair_.bb = b.square();
    pair_.stretch = {shape1.stretch(), shape2.stretch()};
    pair_.aabb = a_.square() * pair_.bb;
    largest_rotation_ = omega_.square() * pair_.stretch / b;
  }

  const Vec2& d0() const { return d0_; }
  const Vec2& v() const { return v_; }
  /// Sum of the circumradii at time 0, and its rate of growth.
  double reach() const { return (a_ * size0_).sum(); }
  double reach_growth() const { return (a_ * growth_).sum(); }
  /// The time in which the bodies that grow do so by the gap and the present circumradii together:
  /// a scale of time for them, infinite if none grows.
  double doubling_time(double gap) const {
    return ((a_ * pair_.size).sum() + gap) / (a_ * growth_.max(0)).sum();
  }

  double time() const { return time_; }

  /// Goes to `time`, the axes taken from the angles.
  void start_at(double time) {
    place_centres(time);
    axes_time_ = time;
    directions<Lanes>(angle0_ + omega_ * time, axes_x_, axes_y_);
    pair_.ux = axes_x_;
    pair_.uy = axes_y_;
  }

  /// Goes to `time`, the axes turned from those at the start; never from one step to the next, lest
  /// rounding add up.
  void go_to(double time) {
    const Lanes turn = omega_ * (time - axes_time_);
    if (std::max(std::abs(turn[0]), std::abs(turn[1])) > largest_small_angle) return start_at(time);
    place_centres(time);
    Lanes cosine, sine;
    small_directions<Lanes>(turn, cosine, sine);
    pair_.ux = cosine * axes_x_ - sine * axes_y_;
    pair_.uy = sine * axes_x_ + cosine * axes_y_;
  }

  Gap look(const Axis& n) const { return gap_along<grows>(pair_, n); }
  Axis likely_axis() const { return detail::likely_axis(pair_); }
  detail::SoughtAxis find_separating_axis() const { return detail::find_separating_axis(pair_); }
  bool climb(Axis& n, Gap& here) const { return detail::climb(pair_, n, here); }
  void settle(Axis& n, const Gap& here) const { detail::settle(pair_, n, here); }
  /// From centre 1 to its surface point with normal n.
  Vec2 arm1(const Axis& n) const {
    const Vec2 u(pair_.ux[0], pair_.uy[0]);
    const double along = u.dot(n);
    const double h = std::sqrt(pair_.bb[0] + pair_.stretch[0] * along * along);
    return pair_.size[0] / h * (pair_.bb[0] * n + pair_.stretch[0] * along * u);
  }

  /// ġ along the axis n, of which `g` is the gap.
  double gap_rate(const Vec2& n, const GapAlongAxis& g) const {
    if constexpr (!grows) return n.dot(v_) + (omega_ * g.turning).sum();
    return n.dot(v_) + (pair_.size * omega_ * g.turning - growth_ * g.height).sum();
  }

  /// d²g/dφdt.
  double slope_rate(const Vec2& n, const GapAlongAxis& g) const {
    const Lanes second = omega_ * (g.radius - g.height);
    if constexpr (!grows) return cross(n, v_) + second.sum();
    return cross(n, v_) + (pair_.size * second - growth_ * g.turning).sum();
  }

  /// −g̈.
  double acceleration(const GapAlongAxis& g) const {
    const Lanes rotation = omega_.square() * (g.radius - g.height);
    if constexpr (!grows) return rotation.sum();
    return (pair_.size * rotation - cross_term(g)).sum();
  }

  /// M with g(t + s) ≥ g + ġ s − ½ M s² for all s from 0 to `duration`, which may be negative (then
  /// looking back), as long as sizes stay ≥ 0.
  ///
  /// With K ω² of bend_bound, growing by the factor σ + γ s of either sign of s,
  ///     (σ + γ s)(h − ω h' s + ½ ω² K s²)
  /// has the coefficient ½ σ ω² K − γ ω h' of s² and ½ γ ω² K of s³; K may be negative, and so may
  /// γ s.
  double acceleration_bound(const GapAlongAxis& g, double duration) const {
    const Lanes rotation = bend_bound<Lanes>(g, pair_.bb, pair_.stretch, omega_, largest_rotation_,
                                             Lanes::Constant(duration));
    if constexpr (!grows) return rotation.sum();
    const Lanes growing = growth_.abs() * std::abs(duration) * rotation.abs();
    return (pair_.size * rotation + growing - cross_term(g)).sum();
  }

  /// The largest that acceleration_bound can be for any axis and a duration of at most 1.
  double largest_acceleration() const {
    if constexpr (!grows) return largest_rotation_.sum();
    return ((pair_.size + growth_.abs()) * largest_rotation_ +
            2 * (growth_ * omega_).abs() * pair_.stretch.sqrt())
        .sum();
  }

 private:
  static const Ellipse& shape_of(const Ellipse& body) { return body; }
  static const Ellipse& shape_of(const GrowingEllipse& body) { return body.shape; }
  static double size_of(const Ellipse&) { return 1; }
  static double size_of(const GrowingEllipse& body) { return body.size; }
  static double growth_of(const Ellipse&) { return 0; }
  static double growth_of(const GrowingEllipse& body) { return body.growth_rate; }

  void place_centres(double time) {
    time_ = time;
    pair_.d = d0_ + v_ * time;
    if constexpr (grows) pair_.size = size0_ + growth_ * time;
  }

  Lanes cross_term(const GapAlongAxis& g) const { return 2 * growth_ * omega_ * g.turning; }

  Vec2 d0_, v_;
  Lanes angle0_, omega_, size0_, growth_;
  Lanes a_;
  Lanes largest_rotation_;  // ω² (a² − b²)/b
  double time_ = 0;
  double axes_time_ = 0;  // when the major axes were these
  Lanes axes_x_, axes_y_;
  EllipsePair pair_;  // at time_
};

}  // namespace vitrel

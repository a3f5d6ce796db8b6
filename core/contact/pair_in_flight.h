#pragma once

#include <algorithm>
#include <cmath>

#include "core/contact/ellipse_pair.h"

namespace vitrel {

/// Two ellipses in free flight, perhaps growing, and how their support gap changes along a fixed
/// axis n.
///
///     ġ = n·v + Σ (σ ω h' − γ h)
///     −g̈ = Σ (σ ω² (ρ − h) − 2 γ ω h')
///
/// with σ the size, γ the growth rate, h' = dh/dφ, ρ = h + h'' (at size 1): turning a body by dθ is
/// turning n by −dθ, so that dh/dt = −ω h' and d²h/dt² = ω² h''.
class PairInFlight {
 public:
  template <class B>
  PairInFlight(const Flight<B>& one, const Flight<B>& two)
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
  const EllipsePair& now() const { return pair_; }

  /// Goes to `time`, the axes taken from the angles.
  void start_at(double time) {
    place_centres(time);
    axes_time_ = time;
    directions(angle0_ + omega_ * time, axes_x_, axes_y_);
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
    small_directions(turn, cosine, sine);
    pair_.ux = cosine * axes_x_ - sine * axes_y_;
    pair_.uy = sine * axes_x_ + cosine * axes_y_;
  }

  /// ġ along the axis n, of which `g` is the gap.
  double gap_rate(const Vec2& n, const GapAlongAxis& g) const {
    return n.dot(v_) + (pair_.size * omega_ * g.turning - growth_ * g.height).sum();
  }

  /// d²g/dφdt.
  double slope_rate(const Vec2& n, const GapAlongAxis& g) const {
    return cross(n, v_) + (pair_.size * omega_ * (g.radius - g.height) - growth_ * g.turning).sum();
  }

  /// −g̈.
  double acceleration(const GapAlongAxis& g) const {
    return (pair_.size * omega_.square() * (g.radius - g.height) - cross_term(g)).sum();
  }

  /// M with g(t + s) ≥ g + ġ s − ½ M s² for all s from 0 to `duration`, which may be negative (then
  /// looking back), as long as sizes stay ≥ 0.
  ///
  /// A body turns by Δ = ω s, and |u·n| changes from p = |u·n| by the slope r = −ω (u·dn/dφ) sgn(u·n)
  /// at first; from cos Δ ≥ 1 − Δ²/2 and 0 ≤ sin |Δ| ≤ |Δ| where that is positive,
  ///     |u·n| ≥ max(0, p (1 − Δ²/2) + min(0, r s)),
  /// which bounds h² = b² + (a² − b²)(u·n)² below. With q that bound over h² now, ρ = a²b²/h³ rises
  /// to q^(−3/2) ρ ≤ ρ/q² at most and h falls to q^(1/2) h ≥ q h at least, so that
  ///     h'' ≤ K = min(ρ/q² − q h, (a² − b²)/b),
  /// the latter its largest value at all. Growing by the factor σ + γ s of either sign of s,
  ///     (σ + γ s)(h − ω h' s + ½ ω² K s²)
  /// has the coefficient ½ σ ω² K − γ ω h' of s² and ½ γ ω² K of s³; K may be negative, and so may
  /// γ s.
  double acceleration_bound(const GapAlongAxis& g, double duration) const {
    const Lanes present = g.along.abs();
    const Lanes slope = -omega_ * g.across * sign(g.along);
    const Lanes least_along =
        (present - present * (0.5 * (omega_ * duration).square()) + (slope * duration).min(0))
            .max(0);
    const Lanes q = (pair_.bb + pair_.stretch * least_along.square()) * g.inverse_square;
    const Lanes rise = 1 / q;
    const Lanes rotation =
        (omega_.square() * (g.radius * rise.square() - g.height * q)).min(largest_rotation_);
    const Lanes growing = growth_.abs() * std::abs(duration) * rotation.abs();
    return (pair_.size * rotation + growing - cross_term(g)).sum();
  }

  /// The largest that acceleration_bound can be for any axis and a duration of at most 1.
  double largest_acceleration() const {
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
    pair_.size = size0_ + growth_ * time;
  }

  static Lanes sign(const Lanes& x) { return {std::copysign(1.0, x[0]), std::copysign(1.0, x[1])}; }

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

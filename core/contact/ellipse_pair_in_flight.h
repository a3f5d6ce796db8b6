#pragma once

#include <cmath>

#include "core/contact/flying_pair.h"

namespace vitrel {

/// Two ellipses in free flight, possibly growing, and the change of their support gap along a fixed axis n.
///
///     ġ = n·v + Σ (σ ω h' − γ h)
///     −g̈ = Σ (σ ω² (ρ − h) − 2 γ ω h')
///
/// where σ is the size, γ the growth rate, and h' = dh/dφ and ρ = h + h'' are those at size 1. Rotating a body by dθ is
/// the same as rotating n by −dθ, so that dh/dt = −ω h' and d²h/dt² = ω² h''.
template <class B>
class EllipsePairInFlight : public FlyingPair<EllipsePair> {
 public:
  using Axis = Vec2;
  using Gap = GapAlongAxis;

  /// If this is false, all sizes are known to be 1 at compile time.
  static constexpr bool grows = vitrel::grows<B>;

  EllipsePairInFlight(const Flight<B>& one, const Flight<B>& two)
      : FlyingPair(one, two),
        angle0_(one.pose.angle, two.pose.angle),
        omega_(one.motion.angular_velocity, two.motion.angular_velocity) {
    const Ellipse& shape1 = shape_of(one.body);
    const Ellipse& shape2 = shape_of(two.body);
    const SimdPair a(shape1.a, shape2.a), b(shape1.b, shape2.b);
    pair_.bb = b * b;
    pair_.aa_minus_bb = {shape1.aa_minus_bb(), shape2.aa_minus_bb()};
    pair_.aabb = a * a * pair_.bb;
    max_rotation_term_ = omega_ * omega_ * pair_.aa_minus_bb / b;
  }

  /// Moves to `time` and computes the axes from the angles.
  void start_at(double time) {
    place_centres<grows>(time);
    axes_time_ = time;
    directions<SimdPair>(angle0_ + omega_ * time, axes_x_, axes_y_);
    pair_.ux = axes_x_;
    pair_.uy = axes_y_;
  }

  /// Moves to `time` and rotates the axes from those of start_at, so that rounding does not accumulate.
  void go_to(double time) {
    const SimdPair turn = omega_ * (time - axes_time_);
    if (any_of(abs(turn) > max_small_angle)) return start_at(time);
    place_centres<grows>(time);
    SimdPair cosine, sine;
    small_angle_directions<SimdPair>(turn, cosine, sine);
    pair_.ux = cosine * axes_x_ - sine * axes_y_;
    pair_.uy = sine * axes_x_ + cosine * axes_y_;
  }

  Gap evaluate(const Axis& n) const { return gap_along<grows>(pair_, n); }
  bool improve_axis(Axis& n, Gap& here) const { return detail::improve_axis(pair_, n, here); }
  /// Returns the vector from centre 1 to the surface point of body 1 with normal n.
  Vec2 arm1(const Axis& n) const {
    const Vec2 u(pair_.ux[0], pair_.uy[0]);
    const double along = dot(u, n);
    const double h = std::sqrt(pair_.bb[0] + pair_.aa_minus_bb[0] * along * along);
    return pair_.size[0] / h * (pair_.bb[0] * n + pair_.aa_minus_bb[0] * along * u);
  }

  /// Returns ġ along the axis n, where `g` is the gap.
  double gap_rate(const Vec2& n, const GapAlongAxis& g) const {
    if constexpr (!grows) return dot(n, v_) + reduce(omega_ * g.turning);
    return dot(n, v_) + reduce(pair_.size * omega_ * g.turning - growth_ * g.height);
  }

  /// Returns d²g/dφdt.
  double slope_rate(const Vec2& n, const GapAlongAxis& g) const {
    const SimdPair second = omega_ * (g.radius - g.height);
    if constexpr (!grows) return cross(n, v_) + reduce(second);
    return cross(n, v_) + reduce(pair_.size * second - growth_ * g.turning);
  }

  /// Returns −g̈.
  double acceleration(const GapAlongAxis& g) const {
    const SimdPair rotation = omega_ * omega_ * (g.radius - g.height);
    if constexpr (!grows) return reduce(rotation);
    return reduce(pair_.size * rotation - cross_term(g));
  }

  /// Returns M with g(t + s) ≥ g + ġ s − ½ M s² for all s from 0 to `duration`, which may be negative (backwards), as
  /// long as the sizes stay ≥ 0.
  ///
  /// With the bound K ω² of support_acceleration_bound and the size σ + γ s, the product
  ///
  ///     (σ + γ s)(h − ω h' s + ½ ω² K s²)
  ///
  /// has the coefficient ½ σ ω² K − γ ω h' of s² and ½ γ ω² K of s³. Both K and γ s may be negative.
  double acceleration_bound(const GapAlongAxis& g, double duration) const {
    const SimdPair rotation = support_acceleration_bound<SimdPair>(
        g, pair_.bb, pair_.aa_minus_bb, omega_, max_rotation_term_, duration);
    if constexpr (!grows) return reduce(rotation);
    const SimdPair growing = abs(growth_) * std::abs(duration) * abs(rotation);
    return reduce(pair_.size * rotation + growing - cross_term(g));
  }

  /// Returns the maximum of acceleration_bound over all axes and durations up to short_time.
  double largest_acceleration() const {
    if constexpr (!grows) return reduce(max_rotation_term_);
    return reduce((pair_.size + short_time() * abs(growth_)) * max_rotation_term_ +
                  2 * abs(growth_ * omega_) * sqrt(pair_.aa_minus_bb));
  }

 private:
  SimdPair cross_term(const GapAlongAxis& g) const { return 2 * growth_ * omega_ * g.turning; }

  SimdPair angle0_, omega_;
  SimdPair max_rotation_term_;  // ω² (a² − b²)/b
  double axes_time_ = 0;        // time of axes_x_, axes_y_
  SimdPair axes_x_, axes_y_;
};

}  // namespace vitrel

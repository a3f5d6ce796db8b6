#pragma once

#include <cmath>

#include "core/contact/ellipsoid_pair_rotation.h"
#include "core/contact/flying_pair.h"
#include "core/geometry/body.h"

namespace vitrel {

/// Two ellipsoids in free flight, possibly growing, and the change of their support gap along a fixed axis n
/// (ellipsoid_pair.h):
///
///     ġ = n·v − Σ (σ ḣ + γ h)
///     −g̈ = Σ (σ ḧ + 2 γ ḣ)
///
/// where σ is the size, γ the growth rate, and h and its derivatives are those at size 1.
template <class B>
class EllipsoidPairInFlight : public FlyingPair<EllipsoidPair> {
 public:
  using Axis = Axis3;
  struct Gap : GapAlongAxis3, SupportRates<SimdPair> {
    SpinOf<SimdPair> spin;
  };

  EllipsoidPairInFlight(const Flight<B>& one, const Flight<B>& two)
      : FlyingPair(one, two),
        max_support_rate_(shape_of(one.body).max_support_rate(),
                          shape_of(two.body).max_support_rate()) {
    rotation_.place(0, shape_of(one.body), one);
    rotation_.place(1, shape_of(two.body), two);
    rotation_.complete();
  }

  /// Moves to `time`, always from time 0, so that rounding does not accumulate.
  void go_to(double time) {
    place_centres<grows<B>>(time);
    rotation_.go_to(time);
    pair_.axes = rotation_.axes;
  }
  void start_at(double time) { go_to(time); }

  Gap evaluate(const Axis& n) const {
    Gap g;
    static_cast<GapAlongAxis3&>(g) = gap_along(pair_, n);
    g.spin = spin_along<SimdPair>(rotation_.omega, n);
    static_cast<SupportRates<SimdPair>&>(g) = support_rates<SimdPair>(g, g.spin);
    rotation_.add_angular_acceleration(g, g, n);
    return g;
  }
  bool improve_axis(Axis& n, Gap& here) const {
    if (!detail::improve_axis(pair_, n, here)) return false;
    here = evaluate(n);
    return true;
  }

  /// Returns the vector from centre 1 to the surface point of body 1 with normal n.
  Vec3 arm1(const Axis& n) const {
    const SupportOf<SimdPair> s = support_along<SimdPair>(pair_.axes, n);
    return pair_.size[0] *
           (s.height[0] * vector(n.n) + s.s1[0] * vector(n.e1) + s.s2[0] * vector(n.e2));
  }

  /// Returns ġ along the axis n, where `g` is the gap.
  double gap_rate(const Axis& n, const Gap& g) const {
    return dot(vector(n.n), v_) - reduce(pair_.size * g.rate + growth_ * g.height);
  }

  /// Returns d/dt of the gradient of g.
  Tangent slope_rate(const Axis& n, const Gap& g) const {
    return {dot(vector(n.e1), v_) + reduce(pair_.size * g.mixed1 - growth_ * g.s1),
            dot(vector(n.e2), v_) + reduce(pair_.size * g.mixed2 - growth_ * g.s2)};
  }

  /// Returns −g̈.
  double acceleration(const Gap& g) const {
    return reduce(pair_.size * g.second + 2 * growth_ * g.rate);
  }

  /// Returns M with g(t + s) ≥ g + ġ s − ½ M s² for all s from 0 to `duration`, which may be negative (backwards), as
  /// long as the sizes stay ≥ 0. With the bound K of ḧ (ellipsoid_pair_rotation.h), the product
  ///
  ///     (σ + γ s)(h + ḣ s + ½ K s²)
  ///
  /// has the coefficient ½ σ K + γ ḣ of s² and ½ γ K of s³.
  double acceleration_bound(const Gap& g, double duration) const {
    const SimdPair acceleration = rotation_.acceleration_bound(g, g, g.spin, duration);
    if constexpr (!grows<B>) return reduce(acceleration);
    return reduce(pair_.size * acceleration + abs(growth_) * std::abs(duration) * acceleration +
                  2 * growth_ * g.rate);
  }

  /// Returns the maximum of acceleration_bound over all axes and durations up to short_time.
  double largest_acceleration() const {
    const SimdPair rotation = rotation_.largest_acceleration();
    if constexpr (!grows<B>) return reduce(rotation);
    return reduce((pair_.size + short_time() * abs(growth_)) * rotation +
                  2 * abs(growth_ * rotation_.max_speed()) * max_support_rate_);
  }

 private:
  SimdPair max_support_rate_;
  std::conditional_t<tumbles<B>, detail::TumblingRotation, detail::UniformRotation> rotation_;
};

}  // namespace vitrel

#pragma once

#include <algorithm>

#include "bench/methods/ellipses/ellipse_constraint.h"
#include "bench/methods/opening.h"

#include "core/geometry/free_flight.h"

namespace vitrel::bench {

/// The problem "smallest t with E₁ ≤ 0 and E₂ ≤ 0" in variables y = (τ, ξ, η) of order 1: t = earliest + τ · duration
/// with 0 ≤ τ ≤ 1 in the bracket, and x = origin + length · (ξ, η). The origin divides the line of centres at the
/// earliest time in the ratio of the circumradii, which is where the circumcircles touch if they do. The length is
/// the smaller semi-minor axis. A search thus starts at y = 0.
class ScaledProblem {
 public:
  ScaledProblem(const CollisionCase& asked, const Bracket& bracket)
      : one_(asked.one),
        two_(asked.two),
        earliest_(bracket.earliest),
        duration_(bracket.duration()) {
    const Pose2 pose1 = advanced(asked.one.pose, asked.one.motion, earliest_);
    const Pose2 pose2 = advanced(asked.two.pose, asked.two.motion, earliest_);
    const double reach1 = body_at(asked.one, earliest_).a;
    const double reach2 = body_at(asked.two, earliest_).a;
    origin_ = (reach2 * pose1.position + reach1 * pose2.position) / (reach1 + reach2);
    const auto thickness = [&](const Flight<GrowingEllipse>& flight) {
      return std::max(body_at(flight, earliest_).b, body_at(flight, bracket.latest).b);
    };
    length_ = std::min(thickness(asked.one), thickness(asked.two));
  }

  double time(const Vec3& y) const { return earliest_ + y[0] * duration_; }
  Vec2 point(const Vec3& y) const { return origin_ + length_ * y.tail<2>(); }
  Vec3 scaled(double time, const Vec2& point) const {
    const Vec2 offset = (point - origin_) / length_;
    return {(time - earliest_) / duration_, offset.x(), offset.y()};
  }

  /// The larger of E₁ and E₂, which is positive outside the common area.
  double violation(const Vec3& y) const {
    return std::max(one_.value(time(y), point(y)), two_.value(time(y), point(y)));
  }

  double value1(const Vec3& y) const { return one_.value(time(y), point(y)); }
  double value2(const Vec3& y) const { return two_.value(time(y), point(y)); }
  double value1(const Vec3& y, Vec3& gradient) const { return first_order(one_, y, gradient); }
  double value2(const Vec3& y, Vec3& gradient) const { return first_order(two_, y, gradient); }
  EllipseFunction full1(const Vec3& y) const { return second_order(one_, y); }
  EllipseFunction full2(const Vec3& y) const { return second_order(two_, y); }

  /// The contact at an optimum: its time and point, with the normal along ∇E₁.
  Prediction2 contact(const Vec3& y, int steps) const {
    Vec3 gradient;
    one_.value(time(y), point(y), gradient);
    return contact_along(gradient.tail<2>(), time(y), point(y), steps);
  }

 private:
  double first_order(const EllipseConstraint& e, const Vec3& y, Vec3& gradient) const {
    const double value = e.value(time(y), point(y), gradient);
    gradient = gradient.cwiseProduct(units());
    return value;
  }
  EllipseFunction second_order(const EllipseConstraint& of, const Vec3& y) const {
    EllipseFunction e = of.with_hessian(time(y), point(y));
    e.gradient = e.gradient.cwiseProduct(units());
    e.hessian = units().asDiagonal() * e.hessian * units().asDiagonal();
    return e;
  }
  Vec3 units() const { return {duration_, length_, length_}; }

  EllipseConstraint one_, two_;
  double earliest_, duration_;
  Vec2 origin_;
  double length_;
};

}  // namespace vitrel::bench

#include "bench/methods/ellipses/ellipse_constraint.h"

#include <algorithm>
#include <cmath>

#include "bench/methods/opening.h"

namespace vitrel::bench {

EllipseConstraint::EllipseConstraint(const Flight<GrowingEllipse>& flight)
    : flight_{flight.body.shape, flight.pose, flight.motion},
      size_(flight.body.size),
      growth_rate_(flight.body.growth_rate) {}

double EllipseConstraint::size_at(double time) const {
  return std::max(size_ + growth_rate_ * time, smallest_size);
}

double EllipseConstraint::value(double time, const Vec2& point) const {
  const double angle = flight_.pose.angle + flight_.motion.angular_velocity * time;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const Vec2 p = point - flight_.pose.position - flight_.motion.velocity * time;
  const double size = size_at(time);
  const double along = (c * p.x() + s * p.y()) / (flight_.body.a * size);
  const double across = (c * p.y() - s * p.x()) / (flight_.body.b * size);
  return along * along + across * across - 1;
}

double EllipseConstraint::value(double time, const Vec2& point, Vec3& gradient) const {
  const double omega = flight_.motion.angular_velocity;
  const double angle = flight_.pose.angle + omega * time;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const Vec2 p = point - flight_.pose.position - flight_.motion.velocity * time;
  const double size = size_at(time);
  const double a = flight_.body.a * size;
  const double b = flight_.body.b * size;
  // This is ½ ∇ₓE, first in the frame of the ellipse and then turned back.
  const double along = c * p.x() + s * p.y();
  const double across = c * p.y() - s * p.x();
  const double f = along / (a * a);
  const double g = across / (b * b);
  const Vec2 half(c * f - s * g, s * f + c * g);
  const double q = along * f + across * g;
  // In the frame of the ellipse the point moves with −v − ω J p.
  const double rate = -half.dot(flight_.motion.velocity) - omega * half.dot(perpendicular(p));
  gradient << 2 * rate - 2 * q * growth_rate_ / size, 2 * half;
  return q - 1;
}

EllipseFunction EllipseConstraint::with_hessian(double time, const Vec2& point) const {
  const double size = size_at(time);
  const double rate = growth_rate_ / size;
  EllipseFunction e = ellipse_function(flight_, time, point);
  e.value = (e.value + 1) / (size * size);
  e.gradient /= size * size;
  e.hessian /= size * size;
  e.hessian.col(0) -= 2 * rate * e.gradient;
  e.hessian.row(0) -= 2 * rate * e.gradient.transpose();
  e.hessian(0, 0) += 6 * rate * rate * e.value;
  e.gradient[0] -= 2 * rate * e.value;
  e.value -= 1;
  return e;
}

}  // namespace vitrel::bench

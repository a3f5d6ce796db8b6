#include "bench/methods/ellipses/ellipse_function.h"

#include "core/elementary.h"
#include "core/geometry/free_flight.h"

namespace vitrel::bench {

// In the co-rotating frame p = Rᵀ(x − r) the function is E = p_x²/a² + p_y²/b² − 1, and p moves with
// ṗ = −w − ω J p, where w = Rᵀ v and J p = (−p_y, p_x). All derivatives follow from those of p.
EllipseFunction ellipse_function(const Flight<Ellipse>& flight, double time, const Vec2& point) {
  const Pose2 pose = advanced(flight.pose, flight.motion, time);
  const auto [c, s] = cosine_and_sine(pose.angle);
  Mat2 rotation;
  rotation << c, -s, s, c;
  const double omega = flight.motion.angular_velocity;
  const Vec2 p = rotation.transpose() * (point - pose.position);
  const Vec2 w = rotation.transpose() * flight.motion.velocity;
  const Vec2 p_t = -w - omega * perpendicular(p);
  // Because ẇ = −ω J w, p̈ = ω J w − ω J ṗ.
  const Vec2 p_tt = omega * perpendicular(w) - omega * perpendicular(p_t);

  const Vec2 q(1 / (flight.body.a * flight.body.a), 1 / (flight.body.b * flight.body.b));
  const Vec2 qp = q.cwiseProduct(p);
  const Mat2 quadric = rotation * q.asDiagonal() * rotation.transpose();

  EllipseFunction e;
  e.value = dot(p, qp) - 1;
  e.gradient << 2 * dot(qp, p_t), 2 * rotation * qp;
  e.hessian(0, 0) = 2 * (dot(q.cwiseProduct(p_t), p_t) + dot(qp, p_tt));
  e.hessian.bottomRightCorner<2, 2>() = 2 * quadric;
  // This is ∂/∂t of ∇ₓE = 2 R Q p with Ṙ = ω R J.
  const Vec2 mixed = 2 * rotation * (omega * perpendicular(qp) + q.cwiseProduct(p_t));
  e.hessian.block<2, 1>(1, 0) = mixed;
  e.hessian.block<1, 2>(0, 1) = mixed.transpose();
  return e;
}

}  // namespace vitrel::bench

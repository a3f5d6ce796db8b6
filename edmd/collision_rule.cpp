#include "edmd/collision_rule.h"

namespace vitrel {

Inertia<2> inertia_of(const ParticleShape<2>& shape, double mass) {
  return {1 / mass, shape.is_round() ? 0 : 1 / (mass * shape.inertia_per_mass())};
}

Inertia<3> inertia_of(const ParticleShape<3>& shape, double mass) {
  if (shape.is_round()) return {1 / mass, Mat3::Zero()};
  return {1 / mass, (mass * shape.inertia_per_mass()).cwiseInverse().asDiagonal()};
}

Inertia<2> full_inertia_of(const ParticleShape<2>& shape, double mass) {
  return {1 / mass, 1 / (mass * shape.inertia_per_mass())};
}

Inertia<3> full_inertia_of(const ParticleShape<3>& shape, double mass) {
  return {1 / mass, (mass * shape.full_inertia_per_mass()).cwiseInverse().asDiagonal()};
}

Inertia<2> in_space(const Inertia<2>& own, const Pose2&, double size) {
  return {own.inverse_mass, own.inverse_moment / (size * size)};
}

Inertia<3> in_space(const Inertia<3>& own, const Pose3& pose, double size) {
  const Mat3 turn = rotation_matrix(pose.orientation);
  return {own.inverse_mass, turn * (own.inverse_moment / (size * size)) * turn.transpose()};
}

template <int Dim>
double approach_speed(const Motion<Dim>& one, const Motion<Dim>& two,
                      const ContactGeometry<Dim>& contact) {
  return dot(one.velocity - two.velocity, contact.normal) +
         dot(one.angular_velocity, contact.arm1) - dot(two.angular_velocity, contact.arm2) +
         contact.growth;
}

template <int Dim>
Impact collide(Motion<Dim>& one, const Inertia<Dim>& inertia1, Motion<Dim>& two,
               const Inertia<Dim>& inertia2, const ContactGeometry<Dim>& contact,
               double restitution) {
  const AngularVelocity<Dim> spin1 = inertia1.inverse_moment * contact.arm1;
  const AngularVelocity<Dim> spin2 = inertia2.inverse_moment * contact.arm2;
  // n has norm 1 only up to rounding, with a systematic error for equal disks; the factor n² still conserves energy.
  const double compliance =
      (inertia1.inverse_mass + inertia2.inverse_mass) * squared_norm(contact.normal) +
      dot(spin1, contact.arm1) + dot(spin2, contact.arm2);
  const double speed = approach_speed(one, two, contact);
  const double impulse = (1 + restitution) * speed / compliance;
  one.velocity -= impulse * inertia1.inverse_mass * contact.normal;
  two.velocity += impulse * inertia2.inverse_mass * contact.normal;
  one.angular_velocity -= impulse * spin1;
  two.angular_velocity += impulse * spin2;
  return {speed, impulse};
}

// Without growth, ω becomes exactly −e ω.
Impact collide_with_own_image(Motion2& motion, const Inertia<2>& inertia,
                              const ContactGeometry<2>& contact, double restitution) {
  const double arm = contact.arm1 - contact.arm2;
  const double speed = motion.angular_velocity * arm + contact.growth;
  motion.angular_velocity =
      -restitution * motion.angular_velocity - (1 + restitution) * contact.growth / arm;
  return {speed, (1 + restitution) * speed / (inertia.inverse_moment * arm * arm)};
}

Impact collide_with_own_image(Motion3& motion, const Inertia<3>& inertia,
                              const ContactGeometry<3>& contact, double restitution) {
  const Vec3 arm = contact.arm1 - contact.arm2;
  const Vec3 spin = inertia.inverse_moment * arm;
  const double speed = dot(motion.angular_velocity, arm) + contact.growth;
  const double impulse = (1 + restitution) * speed / dot(spin, arm);
  motion.angular_velocity -= impulse * spin;
  return {speed, impulse};
}

namespace {

/// ω × ρ
Vec2 rotated(double angular_velocity, const Vec2& arm) {
  return angular_velocity * perpendicular(arm);
}
Vec3 rotated(const Vec3& angular_velocity, const Vec3& arm) {
  return angular_velocity.cross(arm);
}

/// [ρ]ₓ I⁻¹ [ρ]ₓᵀ
Mat2 rotational_part(double inverse_moment, const Vec2& arm) {
  const Vec2 across = perpendicular(arm);
  return inverse_moment * across * across.transpose();
}
Mat3 rotational_part(const Mat3& inverse_moment, const Vec3& arm) {
  Mat3 skew;
  skew << 0, -arm.z(), arm.y(), arm.z(), 0, -arm.x(), -arm.y(), arm.x(), 0;
  return skew * inverse_moment * skew.transpose();
}

/// Returns the largest κ ≤ `wanted` with |κ B_t| ≤ μ (A n + κ B)·n, where A n is the part of the impulse that κ leaves
/// alone and B the part that it multiplies. Normal components are counted along −n.
double stuck_part(double wanted, double friction, double pressing, double pressing_of_part,
                  double tangential_of_part) {
  if (!(pressing > 0)) return 0;
  const double excess = tangential_of_part / friction - pressing_of_part;
  return excess * wanted > pressing ? pressing / excess : wanted;
}

}  // namespace

template <int Dim>
RoughImpact<Dim> collide_rough(Motion<Dim>& one, const Inertia<Dim>& inertia1, Motion<Dim>& two,
                               const Inertia<Dim>& inertia2, const RoughContact<Dim>& contact,
                               double restitution, const ContactLaw& law) {
  using Matrix = Eigen::Matrix<double, Dim, Dim>;
  const Vec<Dim>& n = contact.normal;
  const Vec<Dim> v = one.velocity + rotated(one.angular_velocity, contact.arm1) - two.velocity -
                     rotated(two.angular_velocity, contact.arm2);
  const Matrix k = (inertia1.inverse_mass + inertia2.inverse_mass) * Matrix::Identity() +
                   rotational_part(inertia1.inverse_moment, contact.arm1) +
                   rotational_part(inertia2.inverse_moment, contact.arm2);
  const double speed = dot(v, n), compliance = dot(n, k * n);
  const Vec<Dim> frictionless = -speed / compliance * n;
  const Vec<Dim> sticking = -(inverse(k) * v);
  const Vec<Dim> part = sticking - frictionless;
  const double length = norm(n), pressing_of_part = -dot(part, n) / length;
  const double share =
      law.is_rough() ? stuck_part(1 + law.tangential_restitution, law.friction,
                                  (1 + restitution) * speed / compliance * length, pressing_of_part,
                                  norm(part + pressing_of_part / length * n))
                     : 0;
  const Vec<Dim> impulse = (1 + restitution) * frictionless + share * part;
  const double along = 0.5 * speed * speed / compliance, across = -0.5 * dot(part, v);
  one.velocity += inertia1.inverse_mass * impulse;
  two.velocity -= inertia2.inverse_mass * impulse;
  one.angular_velocity += inertia1.inverse_moment * cross(contact.arm1, impulse);
  two.angular_velocity -= inertia2.inverse_moment * cross(contact.arm2, impulse);
  return {impulse, (1 - restitution) * (1 + restitution) * along + share * (2 - share) * across};
}

template double approach_speed(const Motion<2>&, const Motion<2>&, const ContactGeometry<2>&);
template Impact collide(Motion<2>&, const Inertia<2>&, Motion<2>&, const Inertia<2>&,
                        const ContactGeometry<2>&, double);

template double approach_speed(const Motion<3>&, const Motion<3>&, const ContactGeometry<3>&);
template Impact collide(Motion<3>&, const Inertia<3>&, Motion<3>&, const Inertia<3>&,
                        const ContactGeometry<3>&, double);

template RoughImpact<2> collide_rough(Motion<2>&, const Inertia<2>&, Motion<2>&, const Inertia<2>&,
                                      const RoughContact<2>&, double, const ContactLaw&);
template RoughImpact<3> collide_rough(Motion<3>&, const Inertia<3>&, Motion<3>&, const Inertia<3>&,
                                      const RoughContact<3>&, double, const ContactLaw&);

template <int Dim>
void separate(Motion<Dim>& one, const Inertia<Dim>& inertia1, Motion<Dim>& two,
              const Inertia<Dim>& inertia2, const Vec<Dim>& d) {
  const double m1 = 1 / inertia1.inverse_mass;
  const double m2 = 1 / inertia2.inverse_mass;
  const Vec<Dim> common = (m1 * one.velocity + m2 * two.velocity) / (m1 + m2);
  const double speed = norm(two.velocity - one.velocity);
  const Vec<Dim> apart = normalized(d);
  one.velocity = common - m2 / (m1 + m2) * speed * apart;
  two.velocity = common + m1 / (m1 + m2) * speed * apart;
}

template void separate(Motion<2>&, const Inertia<2>&, Motion<2>&, const Inertia<2>&, const Vec<2>&);
template void separate(Motion<3>&, const Inertia<3>&, Motion<3>&, const Inertia<3>&, const Vec<3>&);

}  // namespace vitrel

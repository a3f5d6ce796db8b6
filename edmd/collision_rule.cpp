#include "edmd/collision_rule.h"

namespace vitrel {

namespace {

double product(double one, double two) {
  return one * two;
}
double product(const Vec3& one, const Vec3& two) {
  return one.dot(two);
}

}  // namespace

Inertia<2> inertia_of(const Ellipse& shape, double mass) {
  return {1 / mass, shape.is_round() ? 0 : 1 / (mass * shape.inertia_per_mass())};
}

Inertia<3> inertia_of(const Ellipsoid& shape, double mass) {
  if (shape.is_round()) return {1 / mass, Mat3::Zero()};
  return {1 / mass, (mass * shape.inertia_per_mass()).cwiseInverse().asDiagonal()};
}

Inertia<2> in_space(const Inertia<2>& own, const Pose2&, double size) {
  return {own.inverse_mass, own.inverse_moment / (size * size)};
}

Inertia<3> in_space(const Inertia<3>& own, const Pose3& pose, double size) {
  const Mat3 turn = pose.orientation.toRotationMatrix();
  return {own.inverse_mass, turn * (own.inverse_moment / (size * size)) * turn.transpose()};
}

template <int Dim>
double approach_speed(const Motion<Dim>& one, const Motion<Dim>& two,
                      const ContactGeometry<Dim>& contact) {
  return (one.velocity - two.velocity).dot(contact.normal) +
         product(one.angular_velocity, contact.arm1) - product(two.angular_velocity, contact.arm2) +
         contact.growth;
}

template <int Dim>
Impact collide(Motion<Dim>& one, const Inertia<Dim>& inertia1, Motion<Dim>& two,
               const Inertia<Dim>& inertia2, const ContactGeometry<Dim>& contact,
               double restitution) {
  const AngularVelocity<Dim> spin1 = inertia1.inverse_moment * contact.arm1;
  const AngularVelocity<Dim> spin2 = inertia2.inverse_moment * contact.arm2;
  // n has norm 1 to rounding, with a systematic error for equal disks: with n² here energy is still conserved.
  const double compliance =
      (inertia1.inverse_mass + inertia2.inverse_mass) * contact.normal.squaredNorm() +
      product(spin1, contact.arm1) + product(spin2, contact.arm2);
  const double speed = approach_speed(one, two, contact);
  const double impulse = (1 + restitution) * speed / compliance;
  one.velocity -= impulse * inertia1.inverse_mass * contact.normal;
  two.velocity += impulse * inertia2.inverse_mass * contact.normal;
  one.angular_velocity -= impulse * spin1;
  two.angular_velocity += impulse * spin2;
  return {speed, impulse};
}

// Without growth ω becomes −e ω exactly.
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
  const double speed = motion.angular_velocity.dot(arm) + contact.growth;
  const double impulse = (1 + restitution) * speed / spin.dot(arm);
  motion.angular_velocity -= impulse * spin;
  return {speed, impulse};
}

template double approach_speed(const Motion<2>&, const Motion<2>&, const ContactGeometry<2>&);
template Impact collide(Motion<2>&, const Inertia<2>&, Motion<2>&, const Inertia<2>&,
                        const ContactGeometry<2>&, double);

template double approach_speed(const Motion<3>&, const Motion<3>&, const ContactGeometry<3>&);
template Impact collide(Motion<3>&, const Inertia<3>&, Motion<3>&, const Inertia<3>&,
                        const ContactGeometry<3>&, double);

}  // namespace vitrel

#include "edmd/collision_rule.h"

namespace vitrel {

double approach_speed(const Motion2& one, const Motion2& two, const ContactGeometry& contact) {
  return (one.velocity - two.velocity).dot(contact.normal) + one.angular_velocity * contact.arm1 -
         two.angular_velocity * contact.arm2 + contact.growth;
}

double collide(Motion2& one, const Inertia& inertia1, Motion2& two, const Inertia& inertia2,
               const ContactGeometry& contact, double restitution) {
  const double spin1 = inertia1.inverse_moment * contact.arm1;
  const double spin2 = inertia2.inverse_moment * contact.arm2;
  // n is a unit vector to rounding, which always errs to the same side for equal disks: with n² here
  // the energy is conserved all the same.
  const double compliance =
      (inertia1.inverse_mass + inertia2.inverse_mass) * contact.normal.squaredNorm() +
      spin1 * contact.arm1 + spin2 * contact.arm2;
  const double impulse = (1 + restitution) * approach_speed(one, two, contact) / compliance;
  one.velocity -= impulse * inertia1.inverse_mass * contact.normal;
  two.velocity += impulse * inertia2.inverse_mass * contact.normal;
  one.angular_velocity -= impulse * spin1;
  two.angular_velocity += impulse * spin2;
  return impulse;
}

double collide_with_own_image(Motion2& motion, const Inertia& inertia,
                              const ContactGeometry& contact, double restitution) {
  const double arm = contact.arm1 - contact.arm2;
  const double speed = motion.angular_velocity * arm + contact.growth;
  motion.angular_velocity =
      -restitution * motion.angular_velocity - (1 + restitution) * contact.growth / arm;
  return (1 + restitution) * speed / (inertia.inverse_moment * arm * arm);
}

void separate(Motion2& one, const Inertia& inertia1, Motion2& two, const Inertia& inertia2,
              const Vec2& d) {
  const double m1 = 1 / inertia1.inverse_mass;
  const double m2 = 1 / inertia2.inverse_mass;
  const Vec2 common = (m1 * one.velocity + m2 * two.velocity) / (m1 + m2);
  const double speed = (two.velocity - one.velocity).norm();
  const Vec2 apart = d.normalized();
  one.velocity = common - m2 / (m1 + m2) * speed * apart;
  two.velocity = common + m1 / (m1 + m2) * speed * apart;
}

}  // namespace vitrel

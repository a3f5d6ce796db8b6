#pragma once

#include <cmath>

#include "core/state/configuration.h"
#include "edmd/collision_rule.h"

/// What collisions conserve.
namespace vitrel {

inline double magnitude(double x) {
  return std::abs(x);
}
inline double magnitude(const Vec3& x) {
  return x.norm();
}

template <int Dim>
struct MovingBody {
  Pose<Dim> pose;
  Motion<Dim> motion;
  Inertia<Dim> inertia;  ///< in the space frame

  Vec<Dim> momentum() const { return motion.velocity / inertia.inverse_mass; }
  AngularVelocity<Dim> spin() const {
    if constexpr (Dim == 2)
      return motion.angular_velocity / inertia.inverse_moment;
    else
      return inertia.inverse_moment.inverse() * motion.angular_velocity;
  }
  AngularVelocity<Dim> angular_momentum() const {
    return spin() + cross(pose.position, momentum());
  }
  double energy() const {
    double rotation = 0;
    if constexpr (Dim == 2)
      rotation = spin() * motion.angular_velocity;
    else
      rotation = spin().dot(motion.angular_velocity);
    return 0.5 * (momentum().dot(motion.velocity) + rotation);
  }
};

/// The sums over two bodies.
template <int Dim>
struct Conserved {
  Conserved(const MovingBody<Dim>& one, const MovingBody<Dim>& two)
      : momentum(one.momentum() + two.momentum()),
        angular_momentum(one.angular_momentum() + two.angular_momentum()),
        energy(one.energy() + two.energy()) {}

  Vec<Dim> momentum;
  AngularVelocity<Dim> angular_momentum;
  double energy;
};

/// The angular momentum of all particles about the origin.
template <int Dim>
AngularVelocity<Dim> angular_momentum(const Configuration<Dim>& c) {
  AngularVelocity<Dim> sum = 0 * c.angular_velocity[0];
  for (std::size_t i = 0; i < c.size(); ++i) {
    sum += c.mass[i] * cross(c.unwrapped(i), c.velocity[i]);
    if constexpr (Dim == 2)
      sum += c.inertia(i) * c.angular_velocity[i];
    else
      sum += c.orientation[i] *
             c.inertia(i).cwiseProduct(c.orientation[i].conjugate() * c.angular_velocity[i]);
  }
  return sum;
}

/// The same particles in a box so wide that none meets an image, drawn towards the origin so that they meet each other.
template <int Dim>
Configuration<Dim> in_an_open_box(Configuration<Dim> c) {
  c.box = PeriodicBox<Dim>(c.box.lengths() * 40);
  for (std::size_t i = 0; i < c.size(); ++i) c.velocity[i] -= 0.3 * c.position[i];
  return c;
}

}  // namespace vitrel

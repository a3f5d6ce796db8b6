#include "core/state/configuration.h"

#include <algorithm>

namespace vitrel {

namespace {

template <int Dim>
void resize_particles(Particles<Dim>& particles, std::size_t n,
                      const AngularVelocity<Dim>& at_rest) {
  particles.position.resize(n, Vec<Dim>::Zero());
  particles.image.resize(n, Shift<Dim>::Zero());
  particles.velocity.resize(n, Vec<Dim>::Zero());
  particles.angular_velocity.resize(n, at_rest);
  particles.shape.resize(n);
  particles.mass.resize(n, 1.0);
  particles.species.resize(n, 0);
}

double rotational_energy(const Configuration2& configuration, std::size_t i) {
  const double omega = configuration.angular_velocity[i];
  return 0.5 * configuration.inertia(i) * omega * omega;
}

double rotational_energy(const Configuration3& configuration, std::size_t i) {
  const Vec3 own = configuration.orientation[i].conjugate() * configuration.angular_velocity[i];
  const Vec3 squares = own.cwiseAbs2();
  const double energy = 0.5 * dot(configuration.inertia(i), squares);
  const ParticleShape<3>& shape = configuration.shape[i];
  const int axis = shape.symmetry_axis();
  return axis == no_axis ? energy
                         : energy + 0.5 * configuration.inertia(i)[axis] *
                                        (spin_factor(shape) - 1) * squares[axis];
}

}  // namespace

void Configuration2::resize(std::size_t n) {
  resize_particles(*this, n, 0);
  angle.resize(n, 0.0);
}

void Configuration3::resize(std::size_t n) {
  resize_particles(*this, n, Vec3::Zero());
  orientation.resize(n, Quaternion::Identity());
}

template <int Dim>
bool same_particles(const Configuration<Dim>& one, const Configuration<Dim>& two) {
  return one.species == two.species && one.mass == two.mass && one.shape == two.shape;
}

template <int Dim>
double packing_fraction(const Configuration<Dim>& configuration) {
  double volume = 0;
  for (const ParticleShape<Dim>& shape : configuration.shape) volume += shape.volume();
  return volume / configuration.box.volume();
}

template <int Dim>
double largest_circumradius(const Configuration<Dim>& configuration) {
  double largest = 0;
  for (const ParticleShape<Dim>& shape : configuration.shape)
    largest = std::max(largest, shape.circumradius());
  return largest;
}

template <int Dim>
double smallest_inradius(const Configuration<Dim>& configuration) {
  double smallest = configuration.shape.front().inradius();
  for (const ParticleShape<Dim>& shape : configuration.shape)
    smallest = std::min(smallest, shape.inradius());
  return smallest;
}

template <int Dim>
std::vector<Vec<Dim>> velocities_after_contact(const Configuration<Dim>& configuration) {
  std::vector<Vec<Dim>> velocities = configuration.velocity;
  for (const Release<Dim>& release : configuration.releases)
    velocities[release.particle] = release.velocity;
  return velocities;
}

template <int Dim>
Mechanics<Dim> mechanics(const Configuration<Dim>& configuration) {
  Mechanics<Dim> sums;
  const std::vector<Vec<Dim>> velocities = velocities_after_contact(configuration);
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const Vec<Dim>& v = velocities[i];
    sums.momentum += configuration.mass[i] * v;
    sums.translational_energy += 0.5 * configuration.mass[i] * squared_norm(v);
    sums.rotational_energy += rotational_energy(configuration, i);
  }
  return sums;
}

template <int Dim>
std::size_t rotor_count(const Configuration<Dim>& configuration) {
  return std::ranges::count_if(configuration.shape,
                               [](const ParticleShape<Dim>& shape) { return !shape.is_round(); });
}

template <int Dim>
std::size_t rotation_count(const Configuration<Dim>& configuration, Contacts contacts) {
  std::size_t count = 0;
  for (const ParticleShape<Dim>& shape : configuration.shape)
    count += static_cast<std::size_t>(rotations(shape, contacts));
  return count;
}

template bool same_particles(const Configuration2&, const Configuration2&);
template bool same_particles(const Configuration3&, const Configuration3&);
template double packing_fraction(const Configuration2&);
template double packing_fraction(const Configuration3&);
template double largest_circumradius(const Configuration2&);
template double largest_circumradius(const Configuration3&);
template double smallest_inradius(const Configuration2&);
template double smallest_inradius(const Configuration3&);
template std::vector<Vec2> velocities_after_contact(const Configuration2&);
template std::vector<Vec3> velocities_after_contact(const Configuration3&);
template Mechanics<2> mechanics(const Configuration2&);
template Mechanics<3> mechanics(const Configuration3&);
template std::size_t rotor_count(const Configuration2&);
template std::size_t rotor_count(const Configuration3&);
template std::size_t rotation_count(const Configuration2&, Contacts);
template std::size_t rotation_count(const Configuration3&, Contacts);

}  // namespace vitrel

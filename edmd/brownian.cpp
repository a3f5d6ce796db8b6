#include "edmd/brownian.h"

#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "core/random/stream.h"

namespace vitrel {
namespace {

template <int Dim>
void scale_translation(Configuration<Dim>& configuration, double factor) {
  for (Vec<Dim>& v : configuration.velocity) v *= factor;
}

template <int Dim>
void scale_rotation(Configuration<Dim>& configuration, double factor) {
  for (AngularVelocity<Dim>& omega : configuration.angular_velocity) omega *= factor;
}

template <int Dim>
void remove_momentum(Configuration<Dim>& configuration) {
  double mass = 0;
  for (double m : configuration.mass) mass += m;
  // Two passes are needed: the first leaves the rounding error of the sum, the second only that of a sum near zero.
  for (int pass = 0; pass < 2; ++pass) {
    const Vec<Dim> drift = mechanics(configuration).momentum / mass;
    for (Vec<Dim>& v : configuration.velocity) v -= drift;
  }
}

double thermal_spin(const Configuration2& configuration, std::size_t i, Contacts contacts,
                    Stream& draw) {
  if (rotations(configuration.shape[i], contacts) == 0) return 0;
  return draw.normal() / std::sqrt(configuration.inertia(i));
}

Vec3 thermal_spin(const Configuration3& configuration, std::size_t i, Contacts contacts,
                  Stream& draw) {
  const ParticleShape<3>& shape = configuration.shape[i];
  if (rotations(shape, contacts) == 0) return Vec3::Zero();
  const Vec3 inertia = configuration.inertia(i);
  Vec3 own;
  for (int k = 0; k < 3; ++k)
    own[k] = k == shape.symmetry_axis() && contacts == Contacts::smooth
                 ? 0
                 : draw.normal() / std::sqrt(inertia[k]);
  // The component along the axis of a spheroid is stored as L/I⊥ (ellipsoid.h).
  if (const int axis = shape.symmetry_axis(); axis != no_axis)
    own[axis] /= std::sqrt(spin_factor(shape));
  return configuration.orientation[i] * own;
}

template <int Dim>
double translational_target(const Configuration<Dim>& configuration, Temperature temperature) {
  const double n = static_cast<double>(configuration.size());
  return 0.5 * Dim * (temperature == Temperature::total || n == 1 ? n : n - 1);
}

}  // namespace

template <int Dim>
void draw_velocities(Configuration<Dim>& configuration, std::uint64_t seed, Purpose purpose,
                     std::uint64_t step, Temperature temperature, Contacts contacts, int threads) {
  each_in_parallel(configuration.size(), threads, [&](std::size_t i) {
    Stream draw(seed, purpose, step, i);
    const double thermal = 1 / std::sqrt(configuration.mass[i]);
    for (double& v : configuration.velocity[i]) v = thermal * draw.normal();
    configuration.angular_velocity[i] = thermal_spin(configuration, i, contacts, draw);
  });
  if (configuration.size() > 1) remove_momentum(configuration);
  const auto drawn = mechanics(configuration);
  scale_translation(configuration, std::sqrt(translational_target(configuration, temperature) /
                                             drawn.translational_energy));
  const auto count = static_cast<double>(rotation_count(configuration, contacts));
  if (count > 0) scale_rotation(configuration, std::sqrt(0.5 * count / drawn.rotational_energy));
}

namespace {

/// Multiplies the energies of the particles by the temperatures of their species, but keeps the momentum at 0.
template <int Dim>
void heat_species(Configuration<Dim>& configuration, const std::vector<double>& temperatures,
                  Contacts contacts) {
  const Mechanics<Dim> before = mechanics(configuration);
  double translations = 0, turns = 0;
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const double t = temperatures[static_cast<std::size_t>(configuration.species[i])];
    configuration.velocity[i] *= std::sqrt(t);
    configuration.angular_velocity[i] *= std::sqrt(t);
    translations += t / static_cast<double>(configuration.size());
    turns += t * rotations(configuration.shape[i], contacts);
  }
  if (!(translations > 0))
    throw UserError("all species start at temperature 0; give one an initial_temperature above 0");
  if (configuration.size() > 1) remove_momentum(configuration);
  const Mechanics<Dim> now = mechanics(configuration);
  scale_translation(configuration, std::sqrt(translations * before.translational_energy /
                                             now.translational_energy));
  if (now.rotational_energy > 0)
    scale_rotation(configuration, std::sqrt(0.5 * turns / now.rotational_energy));
}

/// Puts this share of all energy into translation and the rest into rotation.
template <int Dim>
void split_energy(Configuration<Dim>& configuration, double share) {
  const Mechanics<Dim> drawn = mechanics(configuration);
  if (share < 1 && !(drawn.rotational_energy > 0))
    throw UserError(
        "dynamics.initial_velocities: no particle rotates, as all are round and smooth, or "
        "start at temperature 0; use \"maxwell\"");
  const double total = drawn.translational_energy + drawn.rotational_energy;
  const auto factor = [total](double part, double energy) {
    return part > 0 ? std::sqrt(part * total / energy) : 0;
  };
  scale_translation(configuration, factor(share, drawn.translational_energy));
  scale_rotation(configuration, factor(1 - share, drawn.rotational_energy));
}

}  // namespace

/// Smooth contacts never change the spin of round particles, which is therefore 0.
template <int Dim>
void stop_round_particles(Configuration<Dim>& configuration) {
  for (std::size_t i = 0; i < configuration.size(); ++i)
    if (configuration.shape[i].is_round())
      configuration.angular_velocity[i] =
          AngularVelocity<Dim>(0 * configuration.angular_velocity[i]);
}

template <int Dim>
void set_initial_velocities(Configuration<Dim>& configuration, std::uint64_t seed,
                            InitialVelocities kind, Temperature temperature,
                            const InitialEnergies& energies, Contacts contacts) {
  if (kind == InitialVelocities::keep) {
    if (contacts == Contacts::smooth) stop_round_particles(configuration);
    return;
  }
  draw_velocities(configuration, seed, Purpose::velocities, 0, temperature, contacts);
  if (!energies.temperatures.empty()) heat_species(configuration, energies.temperatures, contacts);
  if (kind == InitialVelocities::translation) split_energy(configuration, 1);
  if (kind == InitialVelocities::rotation) split_energy(configuration, 0);
  if (kind == InitialVelocities::split) split_energy(configuration, energies.translation);
}

template void draw_velocities(Configuration2&, std::uint64_t, Purpose, std::uint64_t, Temperature,
                              Contacts, int);
template void set_initial_velocities(Configuration2&, std::uint64_t, InitialVelocities, Temperature,
                                     const InitialEnergies&, Contacts);
template void draw_velocities(Configuration3&, std::uint64_t, Purpose, std::uint64_t, Temperature,
                              Contacts, int);
template void set_initial_velocities(Configuration3&, std::uint64_t, InitialVelocities, Temperature,
                                     const InitialEnergies&, Contacts);

template <int Dim>
void kick(Configuration<Dim>& configuration, const Driving& driving, std::uint64_t seed,
          std::uint64_t step, int threads) {
  if (configuration.size() < 2) return;
  const auto n = static_cast<double>(configuration.size());
  const double energy = driving.power * driving.interval * n / (n - 1);
  std::vector<Vec<Dim>> impulses(configuration.size());
  each_in_parallel(configuration.size(), threads, [&](std::size_t i) {
    Stream draw(seed, Purpose::kicks, step, i);
    const double width = std::sqrt(2 * energy * configuration.mass[i] / Dim);
    for (double& component : impulses[i]) component = width * draw.normal();
  });
  Vec<Dim> total = Vec<Dim>::Zero();
  double mass = 0;
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    total += impulses[i];
    mass += configuration.mass[i];
  }
  for (std::size_t i = 0; i < configuration.size(); ++i)
    configuration.velocity[i] += impulses[i] / configuration.mass[i] - total / mass;
}

template void kick(Configuration2&, const Driving&, std::uint64_t, std::uint64_t, int);
template void kick(Configuration3&, const Driving&, std::uint64_t, std::uint64_t, int);

}  // namespace vitrel

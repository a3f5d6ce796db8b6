#include "edmd/brownian.h"

#include <cmath>

#include "core/error.h"
#include "core/parallel.h"

namespace vitrel {

namespace {

void scale_translation(Configuration2& configuration, double factor) {
  for (Vec2& v : configuration.velocity) v *= factor;
}

void scale_rotation(Configuration2& configuration, double factor) {
  for (double& omega : configuration.angular_velocity) omega *= factor;
}

void remove_momentum(Configuration2& configuration) {
  double mass = 0;
  for (double m : configuration.mass) mass += m;
  // Twice: the first pass leaves the rounding of the sum, the second that of a sum near zero.
  for (int pass = 0; pass < 2; ++pass) {
    const Vec2 drift = mechanics(configuration).momentum / mass;
    for (Vec2& v : configuration.velocity) v -= drift;
  }
}

double translational_target(const Configuration2& configuration, Temperature temperature) {
  const double n = static_cast<double>(configuration.size());
  return temperature == Temperature::total || n == 1 ? n : n - 1;
}

}  // namespace

void draw_velocities(Configuration2& configuration, std::uint64_t seed, Purpose purpose,
                     std::uint64_t step, Temperature temperature, int threads) {
  in_parallel(configuration.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Stream draw(seed, purpose, step, i);
      const double thermal = 1 / std::sqrt(configuration.mass[i]);
      configuration.velocity[i] = {thermal * draw.normal(), thermal * draw.normal()};
      const double spin = draw.normal() / std::sqrt(configuration.inertia(i));
      configuration.angular_velocity[i] = configuration.shape[i].is_round() ? 0 : spin;
    }
  });
  if (configuration.size() > 1) remove_momentum(configuration);
  const Mechanics drawn = mechanics(configuration);
  scale_translation(configuration, std::sqrt(translational_target(configuration, temperature) /
                                             drawn.translational_energy));
  const double rotors = static_cast<double>(rotor_count(configuration));
  if (rotors > 0) scale_rotation(configuration, std::sqrt(0.5 * rotors / drawn.rotational_energy));
}

void set_initial_velocities(Configuration2& configuration, std::uint64_t seed,
                            InitialVelocities kind, Temperature temperature) {
  if (kind == InitialVelocities::keep) return;
  draw_velocities(configuration, seed, Purpose::velocities, 0, temperature);
  if (kind == InitialVelocities::maxwell) return;
  const Mechanics drawn = mechanics(configuration);
  const double total = drawn.translational_energy + drawn.rotational_energy;
  if (kind == InitialVelocities::translation) {
    scale_translation(configuration, std::sqrt(total / drawn.translational_energy));
    scale_rotation(configuration, 0);
    return;
  }
  if (rotor_count(configuration) == 0)
    throw UserError(
        "dynamics.initial_velocities = \"rotation\": all particles are round and cannot rotate; "
        "use \"maxwell\"");
  scale_rotation(configuration, std::sqrt(total / drawn.rotational_energy));
  scale_translation(configuration, 0);
}

}  // namespace vitrel

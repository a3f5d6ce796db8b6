#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "analysis/trajectory.h"
#include "core/random/stream.h"
#include "core/state/configuration.h"

/// Free particles with the Brownian step, as random walks: every correlation is known.
///
/// In n steps of τ_B a particle makes n independent flights with v ~ N(0, kT/m) per axis and
/// ω ~ N(0, kT/I), so displacements at whole steps are normal with variance n τ_B² kT/m per axis,
/// and rotations with n τ_B² kT/I.
namespace vitrel {

inline constexpr double brownian_step = 0.1;

/// n ellipses of aspect ratio 2 (a b = 1), mass 1, at the origin of a box that is soon left.
inline Configuration2 ellipses(std::size_t n) {
  Configuration2 configuration;
  configuration.box = PeriodicBox<2>(Vec2(5, 7));
  configuration.species_names = {"A"};
  configuration.resize(n);
  for (Ellipse& shape : configuration.shape) shape = {std::sqrt(2.0), std::sqrt(0.5)};
  return configuration;
}

inline void fly(Configuration2& configuration, double time) {
  configuration.time += time;
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    configuration.position[i] += time * configuration.velocity[i];
    configuration.box.wrap(configuration.position[i], configuration.image[i]);
    configuration.angle[i] += time * configuration.angular_velocity[i];
  }
}

inline void redraw_velocities(Configuration2& configuration, Stream& draw) {
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const double speed = std::sqrt(1 / configuration.mass[i]);
    configuration.velocity[i] = {speed * draw.normal(), speed * draw.normal()};
    configuration.angular_velocity[i] = draw.normal() / std::sqrt(configuration.inertia(i));
  }
}

/// The k-th frame follows k steps.
inline MemoryTrajectory2 free_brownian(Configuration2 configuration, std::size_t frames,
                                       std::uint64_t seed) {
  Stream draw(seed, Purpose::tests);
  std::vector<Configuration2> saved{configuration};
  while (saved.size() < frames) {
    redraw_velocities(configuration, draw);
    fly(configuration, brownian_step);
    saved.push_back(configuration);
  }
  return MemoryTrajectory2(std::move(saved));
}

/// Frames 0, 1, 2, 5 and 10 steps after the start of every cycle of 20.
inline MemoryTrajectory2 cycles(MemoryTrajectory2& steps) {
  std::vector<Configuration2> frames;
  for (std::size_t k = 0; k < steps.frames(); ++k)
    for (const std::size_t sampled : {0, 1, 2, 5, 10})
      if (k % 20 == sampled) frames.push_back(steps.read(k));
  return MemoryTrajectory2(std::move(frames));
}

/// Mean squared displacement and rotation of mass 1 after a time of whole steps.
inline double free_msd(double time) {
  return 2 * brownian_step * time;
}
inline double free_msr(double time, double inertia) {
  return brownian_step * time / inertia;
}

}  // namespace vitrel

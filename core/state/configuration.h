#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry/ellipse.h"
#include "core/geometry/periodic_box.h"
#include "core/geometry/pose.h"

namespace vitrel {

/// The state of N particles in a periodic box: the form that files, Monte Carlo, event-driven dynamics
/// and analysis share. One entry per particle in every vector; a plain value, copied at will.
///
/// Units: kT = 1, mass 1 and a b = 1 for the reference species, time √(m a b/kT).
template <int Dim>
struct Configuration;

template <>
struct Configuration<2> {
  PeriodicBox<2> box;
  double time = 0;

  std::vector<Vec2> position;   ///< wrapped into the box
  std::vector<Shift<2>> image;  ///< unwrapped position = position + image ∘ L
  std::vector<double> angle;    ///< unwrapped, radians
  std::vector<Vec2> velocity;
  std::vector<double> angular_velocity;

  std::vector<Ellipse> shape;  ///< semi-axes a ≥ b of every particle
  std::vector<double> mass;
  std::vector<std::int32_t> species;  ///< index into species_names
  std::vector<std::string> species_names;

  std::size_t size() const { return position.size(); }
  /// Makes room for n particles at rest at the origin, round with radius 1, mass 1, species 0.
  void resize(std::size_t n);
  Pose2 pose(std::size_t i) const { return {position[i], angle[i]}; }
  Vec2 unwrapped(std::size_t i) const { return position[i] + box.translation(image[i]); }
  double inertia(std::size_t i) const { return mass[i] * shape[i].inertia_per_mass(); }
};

using Configuration2 = Configuration<2>;

/// Σ π a b / box area.
double packing_fraction(const Configuration2& configuration);
/// The longest semi-axis of any particle.
double largest_circumradius(const Configuration2& configuration);

/// Sums over all particles. Angular velocity of round particles is not modelled and counts nowhere.
struct Mechanics {
  Vec2 momentum;
  double translational_energy;  ///< Σ m v²/2
  double rotational_energy;     ///< Σ I ω²/2 over particles that are not round
};
Mechanics mechanics(const Configuration2& configuration);
/// Number of particles whose rotation is modelled, that is, which are not round.
std::size_t rotor_count(const Configuration2& configuration);

}  // namespace vitrel

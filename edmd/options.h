#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/state/configuration.h"
#include "edmd/contact_law.h"

/// @file
/// Options of event-driven dynamics, in a header of their own so that code that reads parameters compiles no algorithm.
namespace vitrel {

class SoftContact;

/// What to do with a pair found overlapping. A hard run never produces one: `stop` throws InvariantError; `correct`
/// applies the correction move of the thesis (separate, collision_rule.h) and counts it.
enum class OnOverlap { stop, correct };

/// Whether a soft particle that is hit while in contact is released alone or together with its partner
/// (soft/soft_contact.h).
enum class EarlyRelease { alone, together };

/// How an event-driven run finds neighbours; the motion does not depend on it.
enum class NeighborSearch {
  lists,  ///< core/neighbors/neighborhood.h
  cells,  ///< core/neighbors/cell_neighbors.h: round particles that do not grow
};

/// The rotation of scalene ellipsoids in free flight: by Euler's equations, or about a constant angular velocity
/// (core/geometry/ellipsoid.h). Growing particles always keep it constant.
enum class FreeRotation { euler, constant };

struct EngineOptions {
  ContactLaws laws;  ///< of hard particles
  /// t_c of the contact-time model (inelastic_collapse.h); 0: off
  double contact_duration = 0;
  OnOverlap on_overlap = OnOverlap::stop;
  /// From `load` on, all semi-axes are those loaded times 1 + growth_rate · time. Masses are constant, moments of
  /// inertia are those of the current axes, and angular velocities are constant in flight.
  double growth_rate = 0;
  /// If set, the particles are soft: round, and not growing; `laws` and `contact_duration` then have no effect.
  PairsOfSpecies<std::shared_ptr<SoftContact>> soft_contact = {};
  FreeRotation rotation = FreeRotation::euler;
  EarlyRelease early_release = EarlyRelease::alone;
  std::optional<NeighborSearch> neighbors = {};  ///< none: by density
  /// Threads that predict all particles; results do not depend on their number.
  int threads = 1;
};

inline bool are_soft(const EngineOptions& options) {
  return options.soft_contact.values().front() != nullptr;
}

/// What the laws of contact make of rotations.
inline Contacts contacts(const EngineOptions& options) {
  return options.laws.are_rough() ? Contacts::rough : Contacts::smooth;
}

/// The kinetic energy that corresponds to kT = 1 once the net momentum has been removed.
///
///     total:    Σ m v²/2 = D N kT/2 in D dimensions; the mean squared displacement of free particles then has no
///               term of order 1/N
///     relative: Σ m v²/2 = D (N − 1) kT/2; Newtonian equipartition is then exact
///
/// The rotational energy is N_rot kT/2 in both, N_rot the number of rotational degrees of freedom that contacts change
/// (rotation_count).
enum class Temperature { total, relative };

/// The initial velocities of a run.
enum class InitialVelocities {
  maxwell,      ///< drawn as above
  translation,  ///< drawn, then all energy transferred to translation
  rotation,     ///< drawn, then all energy transferred to rotation
  keep,         ///< those of the configuration
  split,        ///< drawn, then this share of all energy in translation, and the rest in rotation
};

/// What drawn velocities hold.
struct InitialEnergies {
  double translation = 0.5;               ///< share of all energy, of `split`
  std::vector<double> temperatures = {};  ///< kT by species; empty: 1
};

/// Random kicks (kick, brownian.h).
struct Driving {
  double interval = 0.01;  ///< τ, time between kicks
  double power = 1;        ///< P, mean energy supplied to a particle per unit of time
};

/// Newtonian dynamics, or Brownian: the same with all velocities redrawn every `brownian_step`.
struct DynamicsOptions {
  EngineOptions engine;
  std::optional<Driving> driving = {};  ///< of Newtonian dynamics
  bool brownian = false;
  double brownian_step = 0.1;  ///< τ_B
  Temperature temperature = Temperature::total;
  std::uint64_t seed = 1;
};

/// At higher pressures the gaps approach the rounding of the coordinates; particles count as jammed.
inline constexpr double max_reduced_pressure = 1e9;

struct GrowthOptions {
  double growth_rate = 1e-3;               ///< γ τ, τ the typical time; negative to shrink
  std::optional<double> packing_fraction;  ///< target (to tolerance::given_fraction)
  std::optional<double> reduced_pressure;  ///< ends with the first block that reaches it
  std::uint64_t seed = 1;
  int retries = 0;  ///< maximum, of particles that jam below the packing fraction (growth.h)
};

}  // namespace vitrel

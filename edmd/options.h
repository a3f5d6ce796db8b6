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

/// What happens to a pair found overlapping. A run of hard particles never produces one: `stop` throws InvariantError;
/// `correct` applies the correction move of the thesis (separate, collision_rule.h) and counts it.
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
  ContactLaws laws;  ///< laws of hard particles
  /// t_c of the contact-time model (inelastic_collapse.h); 0 turns it off.
  double contact_duration = 0;
  OnOverlap on_overlap = OnOverlap::stop;
  /// From `load` on, all semi-axes are the loaded ones times 1 + growth_rate · time. Masses are constant, moments of
  /// inertia are those of the current axes, and angular velocities are constant in flight.
  double growth_rate = 0;
  /// If set, the particles are soft: they must be round and cannot grow, and `laws` and `contact_duration` have no
  /// effect.
  PairsOfSpecies<std::shared_ptr<SoftContact>> soft_contact = {};
  FreeRotation rotation = FreeRotation::euler;
  EarlyRelease early_release = EarlyRelease::alone;
  std::optional<NeighborSearch> neighbors = {};  ///< if empty, chosen by density
  /// Number of threads that predict all particles; results do not depend on it.
  int threads = 1;
};

inline bool are_soft(const EngineOptions& options) {
  return options.soft_contact.values().front() != nullptr;
}

/// Returns whether the contact laws change rotations that smooth contacts do not change.
inline Contacts contacts(const EngineOptions& options) {
  return options.laws.are_rough() ? Contacts::rough : Contacts::smooth;
}

/// The kinetic energy that corresponds to kT = 1 once the net momentum has been removed.
///
///     total:    Σ m v²/2 = D N kT/2 in D dimensions; the mean squared displacement of free particles then has no
///               term of order 1/N
///     relative: Σ m v²/2 = D (N − 1) kT/2; Newtonian equipartition is then exact
///
/// The rotational energy is N_rot kT/2 in both cases, where N_rot is the number of rotational degrees of freedom that
/// contacts change (rotation_count).
enum class Temperature { total, relative };

/// The initial velocities of a run.
enum class InitialVelocities {
  maxwell,      ///< drawn at random (draw_velocities)
  translation,  ///< drawn, then all energy transferred to translation
  rotation,     ///< drawn, then all energy transferred to rotation
  keep,         ///< taken from the configuration
  split,        ///< drawn, then the energy split by InitialEnergies::translation
};

/// The energies of drawn velocities.
struct InitialEnergies {
  double translation = 0.5;               ///< share of all energy, for InitialVelocities::split
  std::vector<double> temperatures = {};  ///< kT of each species; empty: 1
};

/// Options of the random kicks (`kick`, brownian.h).
struct Driving {
  double interval = 0.01;  ///< τ, time between kicks
  double power = 1;        ///< P, mean energy supplied to a particle per unit of time
};

/// Options of Newtonian dynamics, or of Brownian dynamics, which redraws all velocities every `brownian_step`.
struct DynamicsOptions {
  EngineOptions engine;
  std::optional<Driving> driving = {};  ///< for Newtonian dynamics
  bool brownian = false;
  double brownian_step = 0.1;  ///< τ_B
  Temperature temperature = Temperature::total;
  std::uint64_t seed = 1;
};

/// Above this pressure the gaps approach the rounding of the coordinates, and particles count as jammed.
inline constexpr double max_reduced_pressure = 1e9;

struct GrowthOptions {
  double growth_rate = 1e-3;               ///< γ τ, τ the typical time; negative to shrink
  std::optional<double> packing_fraction;  ///< target, met to within tolerance::given_fraction
  std::optional<double> reduced_pressure;  ///< target; the first block that reaches it is the last
  std::uint64_t seed = 1;
  int retries = 0;  ///< maximum number, if particles jam below the packing fraction (growth.h)
};

}  // namespace vitrel

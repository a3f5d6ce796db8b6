#pragma once

#include <cstdint>
#include <memory>
#include <optional>

/// The options of event-driven dynamics, without the code that uses them.
namespace vitrel {

class SoftContact;

/// What to do with a pair found overlapping: a hard run never produces one, so `stop` throws
/// InvariantError; `correct` applies the thesis's correction move (collision_rule.h) and counts it.
enum class OnOverlap { stop, correct };

/// Whether a soft particle that is hit while in contact is released from it alone, or together with its
/// partner (soft/soft_contact.h).
enum class EarlyRelease { alone, together };

/// Of one engine (engine.h).
struct EngineOptions {
  double restitution = 1;
  OnOverlap on_overlap = OnOverlap::stop;
  /// From `load` on all semi-axes are those loaded times 1 + growth_rate · time. Masses are constant,
  /// moments of inertia those of the axes at the time, angular velocities constant in flight.
  double growth_rate = 0;
  /// If given, the particles are soft: round, not growing. `restitution` is then of no effect.
  std::shared_ptr<SoftContact> soft_contact;
  EarlyRelease early_release = EarlyRelease::alone;
  /// For predictions that are made all at once; results do not depend on it.
  int threads = 1;
};

/// Which kinetic energy counts as the temperature kT = 1 once the net momentum has been removed.
///   total:    Σ m v²/2 = D N kT/2 in D dimensions; the mean squared displacement of free particles then has no
///             term in 1/N
///   relative: Σ m v²/2 = D (N − 1) kT/2; Newtonian equipartition then is exact
/// The rotational energy is N_rot kT/2 in both, N_rot the number of rotations that smooth collisions
/// can see: of an ellipse 1, a spheroid 2, a scalene ellipsoid 3, a round particle 0.
enum class Temperature { total, relative };

/// How the velocities of a run begin.
enum class InitialVelocities {
  maxwell,      ///< drawn in equilibrium (draw_velocities)
  translation,  ///< drawn, then all energy put into translation
  rotation,     ///< drawn, then all energy put into rotation
  keep,         ///< those of the configuration
};

/// Newtonian dynamics, or Brownian: the same with all velocities redrawn every `brownian_step`.
struct DynamicsOptions {
  EngineOptions engine;
  bool brownian = false;
  double brownian_step = 0.1;  ///< τ_B
  Temperature temperature = Temperature::total;
  std::uint64_t seed = 1;
};

/// Beyond, gaps come near to the rounding of the coordinates, and particles count as jammed.
inline constexpr double greatest_reduced_pressure = 1e9;

/// Growth to a packing fraction or a pressure, whichever comes first (growth.h).
struct GrowthOptions {
  double growth_rate = 1e-3;               ///< γ, relative, per unit of time; negative to shrink
  std::optional<double> packing_fraction;  ///< ends there, exactly (tolerance::given_fraction)
  std::optional<double> reduced_pressure;  ///< ends with the first block of such a pressure
  std::uint64_t seed = 1;
};

}  // namespace vitrel

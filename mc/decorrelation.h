#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/state/configuration.h"
#include "core/state/stage.h"

namespace vitrel {

/// A short Monte Carlo sampling from a state, to learn how fast it forgets itself and what its
/// pressure is. It runs on a copy: the state itself stays.
///
/// In the first fifth of the sweeps the step sizes adapt; then they are fixed, and all is measured
/// from the configuration reached there, t sweeps later:
///   - orientation C₂(t) = ⟨cos 2(θ(t) − θ(0))⟩ of the particles that are not round;
///   - displacement √⟨|r(t) − r(0)|²/(2b)²⟩, in widths 2b of the particles themselves;
///   - Z = βP/ρ in every fifth configuration (contact_pressure.h).
/// C₂ is 1 at first and 0 when all orientations are forgotten; in a nematic it stays near S². With
/// steps that fit the density, a sweep is a natural unit of time, as long as states are compared at
/// equal acceptance.
struct Probe {
  std::vector<double> sweeps;       ///< t, about 30 to a decade
  std::vector<double> orientation;  ///< C₂(t); empty if all are round
  std::vector<double> displacement;
  std::vector<double> compressibility;  ///< a series of correlated values, evenly spaced

  std::uint64_t measured = 0;  ///< the longest t
  /// The first t at which C₂ < 1/e; none if there was no such, or no such particle.
  std::optional<std::uint64_t> orientation_lost;
  /// The first t at which the displacement exceeds 1.
  std::optional<std::uint64_t> place_lost;
};

/// `sweeps` ≥ 1 are numbered from `first_sweep`, with the streams of the sampler, on any number of
/// threads. Nothing if the
/// budget asked to stop.
std::optional<Probe> probe(const Configuration2& configuration, std::uint64_t sweeps,
                           std::uint64_t seed, std::uint64_t first_sweep, const Budget& budget,
                           int threads = 1);

}  // namespace vitrel

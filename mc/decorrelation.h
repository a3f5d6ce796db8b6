#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/state/configuration.h"
#include "core/state/stage.h"

namespace vitrel {

/// A short Monte Carlo run that measures how fast a state decorrelates, and its pressure. It runs on a copy of the
/// configuration.
///
/// In the first fifth of the sweeps the step sizes adapt; then they are fixed, and everything compares the
/// configuration reached then with the one t sweeps later:
///   - orientation C₂(t) of the particles that are not round: ⟨cos 2(θ(t) − θ(0))⟩ in the plane, ⟨P₂(w(t)·w(0))⟩ of the
///     figure axes w (figure_axis.h) in space;
///   - displacement √⟨|r(t) − r(0)|²/(2b)²⟩, in particle widths 2b, where b is the shortest semi-axis;
///   - Z = βP/ρ in every fifth configuration (contact_pressure.h).
/// C₂ decays from 1 to 0 as orientations decorrelate; in a nematic it stays near S². With step sizes adapted to the
/// density, a sweep is a natural unit of time for comparing states at equal acceptance.
struct Decorrelation {
  std::vector<double> sweeps;       ///< t, about 30 per decade
  std::vector<double> orientation;  ///< C₂(t); empty if all are round
  std::vector<double> displacement;
  std::vector<double> compressibility;  ///< a series of correlated values, evenly spaced
  double compressibility_bias = 0;  ///< how far all values may be off together (contact_pressure.h)

  std::uint64_t measured = 0;  ///< largest t
  /// The first t with C₂ < 1/e. There is none if C₂ stays above 1/e, or if all particles are round.
  std::optional<std::uint64_t> orientation_time;
  /// The first t at which the displacement exceeds 1, if it does.
  std::optional<std::uint64_t> displacement_time;
};

/// Measures the decorrelation in `sweeps` ≥ 1 sweeps, which are numbered from `first_sweep` and use the random streams
/// of the sampler. The result does not depend on the number of threads. It is empty if the run was stopped.
template <int Dim>
std::optional<Decorrelation> measure_decorrelation(const Configuration<Dim>& configuration,
                                                   std::uint64_t sweeps, std::uint64_t seed,
                                                   std::uint64_t first_sweep,
                                                   const RunControl& control, int threads = 1);

}  // namespace vitrel

#pragma once

#include <vector>

#include "analysis/statistics/blocking.h"
#include "analysis/trajectory.h"

/// @file
/// Energies and pressure of a saved run.
///
/// Convention: every energy is divided by N, the number of all particles, and given in units of kT, so
/// translational + rotational = total. Equipartition gives d/2 in d dimensions for the first and R/(2N) for the second,
/// where R is the number of ways to rotate (in two dimensions, the number of particles that are not round).
namespace vitrel {

struct EnergySeries {
  std::vector<double> time;
  std::vector<double> translational;  ///< Σ m v²/2 / N
  std::vector<double> rotational;     ///< Σ I ω²/2 / N, over rotors
  std::vector<double> total;
};

/// Returns the energies from the velocities of every frame.
template <int Dim>
EnergySeries energies(Trajectory<Dim>& trajectory);

/// Returns the mean over the run by blocking; it has no error if the series is not evenly spaced in time.
Estimate time_average(const std::vector<double>& time, const std::vector<double>& series);

/// Returns the mean temperature kT of a run with zero net momentum, 2 E/(d(N − 1) + R) with E = N ⟨total⟩.
double mean_temperature(const EnergySeries& energy, std::size_t particles, std::size_t rotations,
                        int dimension);

struct CompressibilitySeries {
  std::vector<double> time;   ///< middle of the interval between two frames
  std::vector<double> value;  ///< Z in that interval
  Estimate mean;              ///< over the whole run, with the error by blocking of `value`
};

/// Returns the compressibility factor Z = βP/ρ from the virial Σ J n·d, with d from centre to centre, summed over the
/// collisions since the start:
///
///     Z = 1 + Δ(Σ J n·d)/(d N kT Δt).
///
/// kT is the mean temperature of the run. This is exact for zero net momentum, where the virial rate depends on
/// ⟨(v_1 − v_2)²⟩ only and the centre of mass takes none of the energy. `virial` belongs to the times of `energy`.
/// Fewer than two of them give NaN, as does a single particle.
CompressibilitySeries compressibility(const EnergySeries& energy, const std::vector<double>& virial,
                                      std::size_t particles, std::size_t rotations,
                                      int dimension = 2);

}  // namespace vitrel

#pragma once

#include <vector>

#include "analysis/statistics/blocking.h"
#include "analysis/trajectory.h"

/// @file
/// Energies and pressure of a saved run.
///
/// Convention: every energy is divided by N, the number of all particles, and given in units of kT;
/// so translational + rotational = total. Equipartition gives d/2 in d dimensions for the first and
/// R/(2N) for the second, R the number of ways to rotate (in two dimensions, of the particles that are
/// not round).
namespace vitrel {

struct EnergySeries {
  std::vector<double> time;
  std::vector<double> translational;  ///< Σ m v²/2 / N
  std::vector<double> rotational;     ///< Σ I ω²/2 / N, over rotors
  std::vector<double> total;
};

/// From the velocities of every frame.
template <int Dim>
EnergySeries energies(Trajectory<Dim>& trajectory);

/// Mean over the run by blocking; without an error if the series is not evenly spaced in time.
Estimate time_average(const std::vector<double>& time, const std::vector<double>& series);

/// The mean temperature kT of a run with zero net momentum, 2 E/(d(N − 1) + R) with E = N ⟨total⟩.
double mean_temperature(const EnergySeries& energy, std::size_t particles, std::size_t rotations,
                        int dimension);

struct CompressibilitySeries {
  std::vector<double> time;   ///< middle of the interval between two frames
  std::vector<double> value;  ///< Z in that interval
  Estimate mean;              ///< over the whole run; the error by blocking of `value`
};

/// Compressibility factor Z = βP/ρ from the virial Σ J n·d, d from centre to centre, summed over
/// the collisions since the start:
///
///     Z = 1 + Δ(Σ J n·d)/(d N kT Δt).
///
/// kT is the mean temperature of the run: exact for zero net momentum, where the virial rate depends on
/// ⟨(v_1 − v_2)²⟩ only and the centre of mass takes none of the energy. `virial` belongs to the times of `energy`; fewer
/// than two of them give NaN, as does a run without collisions.
CompressibilitySeries compressibility(const EnergySeries& energy, const std::vector<double>& virial,
                                      std::size_t particles, std::size_t rotations,
                                      int dimension = 2);

}  // namespace vitrel

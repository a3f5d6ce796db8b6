#pragma once

#include <vector>

#include "analysis/blocking.h"
#include "analysis/trajectory.h"

/// Energies and pressure of a saved run.
///
/// Convention: every energy is divided by N, the number of all particles, and given in units of kT;
/// so translational + rotational = total. Equipartition gives 1 for the first and R/(2N) for the
/// second, R the number of rotors (particles that are not round).
namespace vitrel {

struct EnergySeries {
  std::vector<double> time;
  std::vector<double> translational;  ///< Σ m v²/2 / N
  std::vector<double> rotational;     ///< Σ I ω²/2 / N, over rotors
  std::vector<double> total;
};

/// From the velocities of every frame.
EnergySeries energies(Trajectory& trajectory);

/// Mean over the run by blocking; without an error if the series is not evenly spaced in time.
Estimate time_average(const std::vector<double>& time, const std::vector<double>& series);

struct CompressibilitySeries {
  std::vector<double> time;   ///< middle of the interval between two frames
  std::vector<double> value;  ///< Z in that interval
  Estimate mean;              ///< over the whole run; the error by blocking of `value`
};

/// Compressibility factor Z = βP/ρ from the virial Σ J n·d, d from centre to centre, summed over
/// the collisions since the start (two dimensions):
///   Z = 1 + Δ(Σ J n·d)/(2 N kT Δt).
/// kT is the mean temperature of the run, 2 E/(2N − 2 + R) with E = N ⟨total⟩: exact for zero net
/// momentum, where the virial rate depends on ⟨(v_1 − v_2)²⟩ only and the centre of mass takes none
/// of the energy. `virial` belongs to the times of `energy`; fewer than two of them give NaN.
CompressibilitySeries compressibility(const EnergySeries& energy, const std::vector<double>& virial,
                                      std::size_t particles, std::size_t rotors);

}  // namespace vitrel

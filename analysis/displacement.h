#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/time_axis.h"
#include "analysis/trajectory.h"

/// Mean squared displacement ⟨|r(t) − r(0)|²⟩ (MSD, units of length squared, a b = 1) and mean
/// squared rotation ⟨(θ(t) − θ(0))²⟩ (MSR, radians squared), from unwrapped positions and angles.
namespace vitrel {

struct DisplacementOptions {
  TimeAxisOptions axis;
  std::size_t memory = std::size_t{512} << 20;  ///< bytes for particle tracks
};

/// A mean square against the time difference.
struct MeanSquare {
  std::vector<double> value;
  std::vector<double> error;  ///< standard error; NaN where none can be given
  std::vector<std::size_t>
      blocks;  ///< blocks of time origins behind the error; 0: spread of particles
};

struct DisplacementGroup {
  std::string name;  ///< "all", or the name of a species
  std::size_t particles = 0;
  std::size_t rotors =
      0;  ///< particles that are not round; the rotation of round ones is not modelled
  MeanSquare translation;
  MeanSquare rotation;  ///< empty without rotors
};

struct Displacements {
  std::vector<double> lag;           ///< time differences t > 0
  std::vector<std::size_t> origins;  ///< time origins averaged over, for every lag
  /// "all" first, then every species that has particles, if there is more than one.
  std::vector<DisplacementGroup> groups;
};

/// Steps.
/// 1. Lags and origins are those of the time axis.
/// 2. At every origin the square is averaged over the particles; the mean over origins is the
/// value.
/// 3. The error is that of this series of origins by blocking, with blocks of four lags or more; it
///    sees correlations in time and between particles. Where the lag is too long for eight such blocks,
///    or with a single origin, it is that of the particles' own means over the origins, taken as
///    independent of each other: good far from the glass, too small by √χ_4 where motion is
///    cooperative. Both include Student's factor.
///
/// The file is read once, or several times for a few particles each if the tracks exceed `memory`;
/// the result does not depend on it. Cost about (lags) × (origins) × N. Throws UserError for fewer
/// than two frames.
Displacements displacements(Trajectory& trajectory, const DisplacementOptions& options = {});

/// Where the main peak of the structure factor of a dense liquid is, about: the first Bragg peak
/// of the triangular lattice of the same number density ρ, q = 2π √(2ρ/√3).
double main_wave_number(const Configuration2& configuration);

/// A long-time diffusion coefficient, D = d⟨|r|²⟩/(2 d dt) (d = 2; for rotation d = 1).
struct Diffusion {
  double value;
  double error;
};
/// Read off between a third of the longest lag T and T, as (m(T) − m(T/3))/(2 d · 2T/3); NaN unless
/// it is honest: the slope between T/9 and T/3 must agree within 10 % or three standard errors, and
/// the particles must have moved by one unit (length or radian) in the mean square. The error is
/// the larger of the change from the earlier slope to this one, and of those of both ends added in
/// squares, an upper bound because they are positively correlated.
Diffusion long_time_diffusion(const std::vector<double>& lag, const MeanSquare& square,
                              int dimension);

}  // namespace vitrel

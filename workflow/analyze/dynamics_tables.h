#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/dynamics/cage_relative.h"
#include "analysis/dynamics/collective_scattering.h"
#include "analysis/dynamics/displacement.h"
#include "analysis/results.h"

namespace vitrel {

/// The time correlations of a run.
struct RunDynamics {
  Displacements displacements;
  CollectiveScattering collective;                 ///< at the wave numbers of the displacements
  std::optional<CageRelative> cage_relative = {};  ///< in two dimensions, at the same wave numbers
};

/// Tables displacements_<group>, self_scattering_<group> and, of groups with rotors,
/// orientation_<group>; in two dimensions cage_relative; wave_numbers, collective_scattering and, if the run has more than one time
/// origin, susceptibility.
std::vector<Table> dynamics_tables(const RunDynamics& dynamics);

/// The time differences of these tables and their origins in words, for the provenance.
std::string time_axis_text(std::span<const double> times, const Displacements& found);

}  // namespace vitrel

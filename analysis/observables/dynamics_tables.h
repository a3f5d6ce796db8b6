#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/dynamics/ageing.h"
#include "analysis/dynamics/cage_relative.h"
#include "analysis/dynamics/collective_scattering.h"
#include "analysis/dynamics/displacement.h"
#include "analysis/observables/observable.h"
#include "analysis/results.h"

namespace vitrel {

/// The time correlations of a run.
struct RunDynamics {
  Displacements displacements;
  CollectiveScattering collective = {};  ///< at the wave numbers of the displacements; may be empty
  std::optional<CageRelative> cage_relative = {};  ///< in two dimensions, at the same wave numbers
  std::vector<AgedMotion> ageing = {};             ///< one entry for every waiting time
};

std::vector<Table> dynamics_tables(const RunDynamics& dynamics);

/// Returns the descriptions of these tables, in their order.
std::vector<Observable> dynamics_observables(int dimension);

/// Returns the time differences of these tables and their origins in words, for the provenance.
std::string time_axis_text(std::span<const double> times, const Displacements& found);

}  // namespace vitrel

#pragma once

#include <optional>
#include <vector>

#include "analysis/dynamics/two_times.h"
#include "analysis/dynamics/velocity_correlation.h"
#include "analysis/dynamics/viscosity.h"
#include "analysis/observables/observable.h"
#include "analysis/results.h"

namespace vitrel {

/// Measurements of the motion between frames, beside the correlations of dynamics_tables.h.
struct RunMotion {
  int dimension = 2;
  std::optional<VelocityCorrelations> velocities = {};  ///< if there are velocities
  std::optional<Viscosity> viscosity = {};              ///< if the file has Helfand moments
  std::vector<Lag> lags = {};                           ///< time differences of `two_times`
  /// Self and distinct part of the Van Hove function, and the four-point structure factor.
  std::vector<TwoTimeAverages> two_times = {};
};

std::vector<Table> motion_tables(const RunMotion& motion);

/// Returns the descriptions of these tables, in their order.
std::vector<Observable> motion_observables();

}  // namespace vitrel

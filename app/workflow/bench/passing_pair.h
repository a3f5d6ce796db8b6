#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/workflow/bench/chart.h"

/// Two ellipsoids that overlap for a moment as they pass (bench/lab/solids/suite.h): a pair of roots so
/// close that a scan for a change of sign steps over both.
namespace vitrel {

/// η₁(t) about the overlap, and what a scan of the usual step sees of it.
Chart passing_pair_chart();

/// The depth, the true contact, and what every method at all its tolerances answers: the time, or null
/// if it finds no contact, and the number of steps or evaluations.
nlohmann::ordered_json passing_pair_json();

}  // namespace vitrel

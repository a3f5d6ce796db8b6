#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>

#include "edmd/options.h"
#include "workflow/stages/stage_interface.h"

/// @file
/// The goal of the stages `grow` and `hybrid`: a packing fraction (by default that of the system), a reduced
/// pressure, or whichever of the two comes first.
namespace vitrel {

template <class S>
struct GrowthGoal : StageDefaults {
  std::optional<double> packing_fraction;
  std::optional<double> reduced_pressure;
  double growth_rate = GrowthOptions().growth_rate;

  StageEnding ending() const { return ending_known_if(!reduced_pressure); }
  std::string description() const {
    return reduced_pressure
               ? fmt::format("{} to reduced pressure {:.4g}", S::method, *reduced_pressure)
               : "";
  }
  /// `end` is the packing fraction at which the stage ends (end_of_stage).
  std::optional<double> packing_fraction_goal(double end) const {
    return reduced_pressure ? packing_fraction : end;
  }
};

}  // namespace vitrel

#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>

#include "workflow/stages/stage_interface.h"

/// @file
/// The goal of the stages `grow` and `hybrid`: a packing fraction (by default that of the system), a reduced
/// pressure, or whichever of the two comes first.
namespace vitrel {

template <class S>
StageEnding growth_ending(const S& stage) {
  return stage.reduced_pressure ? StageEnding::unknown : StageEnding::packing_fraction;
}

template <class S>
double end_of_growth(const S& stage, const SystemParameters& system, double before) {
  return stage.reduced_pressure ? before : stage.packing_fraction.value_or(system.packing_fraction);
}

/// `end`: of the stage, end_of_growth.
template <class S>
std::optional<double> packing_fraction_goal(const S& stage, double end) {
  return stage.reduced_pressure ? stage.packing_fraction : end;
}

template <class S>
std::string growth_description(const S& stage, double end) {
  return stage.reduced_pressure
             ? fmt::format("{} to reduced pressure {:.4g}", S::method, *stage.reduced_pressure)
             : fmt::format("{} to packing fraction {:.4g}", S::method, end);
}

}  // namespace vitrel

#pragma once

#include <cstdint>
#include <string>

#include "workflow/prepare/prepare.h"

/// Preparations that several tests make.
namespace vitrel {

inline void say_nothing(const std::string& /*line*/) {}

template <int Dim = 2>
Preparation<Dim> prepared(const Parameters& parameters) {
  return prepare<Dim>({parameters}, {}, say_nothing);
}

/// The same of parameters that are checked first.
template <int Dim = 2>
Preparation<Dim> prepared_if_valid(const Parameters& parameters) {
  validate(parameters);
  return prepared<Dim>(parameters);
}

/// 49 ellipses, inserted and swollen.
inline Parameters inserted_and_swollen(double packing_fraction) {
  Parameters parameters;
  parameters.system.particles = 49;
  parameters.system.packing_fraction = packing_fraction;
  parameters.stages[1] = SwellStage();
  return parameters;
}

inline HybridStage hybrid_stage(double growth_rate, std::uint64_t stretch_sweeps,
                                Moves moves = HybridStage().moves) {
  HybridStage stage;
  stage.growth_rate = growth_rate;
  stage.stretch_sweeps = stretch_sweeps;
  stage.moves = moves;
  return stage;
}

}  // namespace vitrel

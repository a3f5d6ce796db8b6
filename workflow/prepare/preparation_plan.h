#pragma once

#include <string>
#include <vector>

#include "workflow/prepare/prepare.h"
#include "workflow/prepare/stage_cost.h"

/// @file
/// What a preparation would do, and what each of its stages is expected to cost.
namespace vitrel {

/// Particles as the parameters describe them; at most some thousands.
template <int Dim>
Configuration<Dim> representative_particles(const Parameters& parameters);

/// A line about the system.
std::string system_plan(const Parameters& parameters);

/// What the stages of a preparation are expected to cost, in their order. `start`: the packing fraction of the state that
/// the first stage takes, if it takes one.
template <int Dim>
std::vector<StageCost> stage_costs(const Parameters& parameters, const Configuration<Dim>& some,
                                   double start);

/// A line for each stage. `some`: the particles of the given state that the first stage takes, else
/// some that represent them.
template <int Dim>
std::string preparation_plan(const Parameters& parameters, const Configuration<Dim>& some);

/// The same with the system, for a preparation on its own. UserError if it was begun with other parameters.
std::string preparation_plan(PrepareRequest request);

}  // namespace vitrel

#pragma once

#include <string>
#include <vector>

#include "workflow/prepare/prepare.h"

/// @file
/// What a preparation would do, and what each of its stages is expected to cost.
namespace vitrel {

/// Particles as the parameters describe them; at most some thousands.
template <int Dim>
Configuration<Dim> representative_particles(const Parameters& parameters);

/// What a stage is expected to cost, good to a factor of two or three.
struct StageCost {
  double events = 0;            ///< of growth
  double sweeps = 0;            ///< of Monte Carlo
  double seconds = 0;           ///< on one core of a processor of our days
  bool is_foreseen = true;      ///< false: how many sweeps it takes shows only when they are made
  double packing_fraction = 0;  ///< at the end
  double goal = 0;              ///< the packing fraction that the stage is to reach (end_of_stage)

  void add(const StageCost& other) {
    events += other.events;
    sweeps += other.sweeps;
    seconds += other.seconds;
    is_foreseen = is_foreseen && other.is_foreseen;
  }
};

/// A line about the system.
std::string system_plan(const Parameters& parameters);

/// What the stages of a preparation are expected to cost, in their order. `start`: the packing fraction of the state
/// that the first stage takes, if it takes one.
template <int Dim>
std::vector<StageCost> stage_costs(const Parameters& parameters, const Configuration<Dim>& some,
                                   double start);

/// A line for each stage, the time that they take together, and how they are simulated. `some`: the particles of the
/// given state that the first stage takes, else some that represent them.
template <int Dim>
std::string preparation_plan(const Parameters& parameters, const Configuration<Dim>& some);

/// The same with the system, for a preparation on its own. UserError if it was begun with other parameters.
std::string preparation_plan(PrepareRequest request);

}  // namespace vitrel

#pragma once

#include <string>
#include <vector>

#include "workflow/prepare/prepare.h"

/// @file
/// What a preparation would do, and what each of its stages is expected to cost.
namespace vitrel {

/// Draws particles as the parameters describe them, at most some thousands.
template <int Dim>
Configuration<Dim> representative_particles(const Parameters& parameters);

/// The expected cost of a stage, good to a factor of two or three.
struct StageCost {
  double events = 0;  ///< during growth
  double sweeps = 0;  ///< of Monte Carlo
  /// Wall time on one core of a present-day processor.
  double seconds = 0;
  bool is_foreseen = true;      ///< false if the number of sweeps is known only once they are made
  double packing_fraction = 0;  ///< at the end of the stage
  double goal = 0;              ///< packing fraction that the stage is to reach (end_of_stage)

  void add(const StageCost& other) {
    events += other.events;
    sweeps += other.sweeps;
    seconds += other.seconds;
    is_foreseen = is_foreseen && other.is_foreseen;
  }
};

/// Describes the system in one line.
std::string system_plan(const Parameters& parameters);

/// The expected costs of the stages of a preparation, in their order. `start` is the packing fraction of the given
/// state if the first stage takes one.
template <int Dim>
std::vector<StageCost> stage_costs(const Parameters& parameters, const Configuration<Dim>& some,
                                   double start);

/// A line for each stage, the time that they take together, and how they are simulated. `some` are the particles of
/// the given state if the first stage takes one, else particles that represent those to be prepared.
template <int Dim>
std::string preparation_plan(const Parameters& parameters, const Configuration<Dim>& some);

/// The plan of the system and of all stages, for a preparation on its own. Throws UserError if the preparation was
/// begun with other parameters.
std::string preparation_plan(PrepareRequest request);

}  // namespace vitrel

#pragma once

#include <cstdint>
#include <vector>

#include "analysis/statistics/blocking.h"
#include "core/state/stage.h"
#include "edmd/growth.h"
#include "mc/sweep_state.h"

namespace vitrel {

struct SamplingState;

/// The results of a stage.
struct StageRecord {
  StageReport report;
  double packing_fraction = 0;  ///< at the end of the stage
  /// The mean over the second half of a compression without a target.
  Estimate mean_packing_fraction = {0, 0, 0};
  std::uint64_t sweeps = 0;
  std::uint64_t chain_contacts = 0;  ///< in event chains
  double chain_pressure = 0;         ///< βP/ρ from the event chains; 0 without any
  std::uint64_t decorrelations = 0;  ///< 0 if they were not counted
  TrialCounts trials;
  GrowthState growth;  ///< of `grow` and `hybrid`; its counters are 0 for other stages
  double wall_seconds = 0;
  /// All components of OrientationTensor::matrix at the end of the stage; empty in two dimensions.
  std::vector<double> orientation_tensor = {};

  /// βP/ρ at the end of growth or, if there was none, from event chains; 0 if there were neither.
  double reduced_pressure() const {
    return growth.reduced_pressure > 0 ? growth.reduced_pressure : chain_pressure;
  }

  void add(const SweepState& moves);
  void add(const SamplingState& sampling);
};

}  // namespace vitrel

#pragma once

#include "mc/options.h"
#include "workflow/stages/stage_interface.h"
#include "workflow/storage/state_items.h"

namespace vitrel {

struct SamplingState;

/// Monte Carlo at constant packing fraction (mc/sampling.h).
struct SampleStage : StageDefaults {
  using State = SamplingState;
  static constexpr const char* method = "sample";
  static constexpr const char* summary = "Monte Carlo at constant packing fraction";

  Moves moves = SamplingOptions().moves;
  ExchangeOptions exchanges;
  std::uint64_t decorrelations = SamplingOptions().decorrelations;
  std::uint64_t sweeps = SamplingOptions().sweeps;
  std::uint64_t max_sweeps = SwellingOptions().sweeps;  ///< if a number of decorrelations is given

  static std::vector<StageField<SampleStage>> fields();
  void validate(const Rules& rules, int dimension) const;
  StageEnding ending() const { return StageEnding::unchanged; }
  std::string description() const;
  StageReport advance(SamplingState& state, const StageContext& context) const;
  void record(const SamplingState& state, StageRecord& record) const;

  static void each_item(auto& state, auto&& visit) {
    each_item_of_sampling(state, visit.below("sampling."));
  }
};

}  // namespace vitrel

#pragma once

#include "workflow/stages/growth_goal.h"
#include "workflow/stages/hybrid_options.h"
#include "workflow/storage/state_items.h"

namespace vitrel {

struct HybridState;

/// Alternating growth and Monte Carlo (hybrid.h).
struct HybridStage : GrowthGoal<HybridStage> {
  using State = HybridState;
  static constexpr const char* method = "hybrid";
  static constexpr const char* summary =
      "short intervals of event-driven growth that alternate with Monte Carlo";

  std::uint64_t stretch_sweeps = HybridOptions().stretch.sweeps;
  Moves moves = SamplingOptions().moves;
  ExchangeOptions exchanges;

  static std::vector<StageField<HybridStage>> fields();
  StageReport advance(HybridState& state, const StageContext& context) const;
  void record(const HybridState& state, StageRecord& record) const;

  static void each_item(auto& state, auto&& visit) {
    each_item_of_growth(state.growth, visit.below("hybrid.growth."));
    each_item_of_sampling(state.sampling, visit.below("hybrid."));
    visit("hybrid.stretches", state.stretches);
    visit("hybrid.stretch_end", state.stretch_end);
  }
};

}  // namespace vitrel

#pragma once

#include "workflow/stages/growth_goal.h"
#include "workflow/storage/state_items.h"

namespace vitrel {

struct GrowthState;

/// Event-driven dynamics of growing particles (edmd/growth.h).
struct GrowStage : GrowthGoal<GrowStage> {
  using State = GrowthState;
  static constexpr const char* method = "grow";
  static constexpr const char* summary =
      "event-driven dynamics while the particles grow to a packing fraction or until they jam";

  int retries = 5;

  static std::vector<StageField<GrowStage>> fields();
  StageReport advance(GrowthState& state, const StageContext& context) const;
  void record(const GrowthState& state, StageRecord& record) const;

  static void each_item(auto& state, auto&& visit) {
    each_item_of_growth(state, visit.below("growth."));
  }
};

}  // namespace vitrel

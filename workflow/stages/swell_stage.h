#pragma once

#include <optional>

#include "mc/options.h"
#include "workflow/stages/stage_interface.h"
#include "workflow/storage/state_items.h"

namespace vitrel {

struct SwellingState;

/// Swelling by Monte Carlo (mc/swelling.h).
struct SwellStage : StageDefaults {
  using State = SwellingState;
  static constexpr const char* method = "swell";
  static constexpr const char* summary =
      "Monte Carlo while the particles grow to the target packing fraction";

  std::optional<double> packing_fraction;
  std::uint64_t max_sweeps = SwellingOptions().sweeps;

  static std::vector<StageField<SwellStage>> fields();
  StageReport advance(SwellingState& state, const StageContext& context) const;
  void record(const SwellingState& state, StageRecord& record) const;

  static void each_item(auto& state, auto&& visit) {
    each_item_of_moves(state.moves, visit.below("swelling."));
    visit("swelling.growth", state.growth);
    visit("swelling.watched_sweeps", state.checked_sweeps);
    visit("swelling.watched_packing_fraction", state.checked_packing_fraction);
  }
};

}  // namespace vitrel

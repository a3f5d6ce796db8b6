#pragma once

#include <optional>

#include "mc/options.h"
#include "workflow/stages/stage_interface.h"
#include "workflow/storage/state_items.h"

namespace vitrel {

struct CompressionState;

/// Monte Carlo at constant pressure (mc/compression.h). It ends at a packing fraction if one is given, else after a
/// number of sweeps.
struct CompressStage : StageDefaults {
  using State = CompressionState;
  static constexpr const char* method = "compress";
  static constexpr const char* summary =
      "Monte Carlo at constant pressure, in a box of variable size";

  std::optional<double> packing_fraction;
  std::uint64_t max_sweeps = SwellingOptions().sweeps;  ///< if a packing fraction is given
  double pressure = CompressionOptions().pressure;
  BoxChange box = CompressionOptions().change;
  std::uint64_t sweeps = CompressionOptions().sweeps;  ///< if no packing fraction is given

  static std::vector<StageField<CompressStage>> fields();
  StageEnding ending() const { return ending_known_if(packing_fraction.has_value()); }
  std::string description() const;
  StageReport advance(CompressionState& state, const StageContext& context) const;
  void record(const CompressionState& state, StageRecord& record) const;

  static void each_item(auto& state, auto&& visit) {
    each_item_of_moves(state.moves, visit.below("compression."));
    each_item_of_step(state.box.step, visit.below("compression.box."));
    visit("compression.box.aspect_at_start", state.box.aspect_at_start);
    visit.if_recorded("compression.box.depth_at_start", state.box.depth_at_start);
    visit("compression.box.all_tried", state.box.tried);
    visit("compression.box.all_accepted", state.box.accepted);
    visit("compression.packing_fraction", state.packing_fraction);
  }
};

}  // namespace vitrel

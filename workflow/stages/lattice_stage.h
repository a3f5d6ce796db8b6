#pragma once

#include <optional>

#include "mc/options.h"
#include "workflow/stages/stage_interface.h"

namespace vitrel {

/// Regular positions (mc/lattice.h).
struct LatticeStage : StageDefaults {
  static constexpr const char* method = "lattice";
  static constexpr const char* summary = "regular positions";
  static constexpr bool places_particles = true;

  std::optional<double> packing_fraction;
  Arrangement arrangement = LatticeOptions().arrangement;
  double angle = LatticeOptions().angle;

  static std::vector<StageField<LatticeStage>> fields();
  void validate(const Rules& rules, int dimension) const;
  StageReport advance(NoState& state, const StageContext& context) const;
};

}  // namespace vitrel

#pragma once

#include <optional>

#include "edmd/options.h"
#include "workflow/stages/stage_interface.h"
#include "workflow/storage/state_items.h"

namespace vitrel {

struct GrowthState;

/// Event-driven dynamics of growing particles (edmd/growth.h).
struct GrowStage : StageDefaults {
  using State = GrowthState;
  static constexpr const char* method = "grow";
  static constexpr const char* summary =
      "event-driven dynamics while the particles grow to a packing fraction or until they jam";

  std::optional<double> packing_fraction;
  std::optional<double> reduced_pressure;
  double growth_rate = GrowthOptions().growth_rate;
  int retries = 5;

  static std::vector<StageField<GrowStage>> fields();
  void validate(const Rules& rules, int dimension) const;
  StageEnding ending() const;
  double end(const SystemParameters& system, double before) const;
  std::string description(double goal) const;
  template <int Dim>
  StageReport advance(Configuration<Dim>& configuration, GrowthState& state,
                      const StageContext& context, const RunControl& control) const;
  void record(const GrowthState& state, StageRecord& record) const;

  template <class AnyState, class Visit>
  static void each_item(AnyState& state, Visit&& visit) {
    each_item_of_growth(state, "growth.", visit);
  }
};

}  // namespace vitrel

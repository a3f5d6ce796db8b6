#pragma once

#include <optional>

#include "edmd/options.h"
#include "workflow/stages/hybrid_options.h"
#include "workflow/stages/stage_interface.h"
#include "workflow/storage/state_items.h"

namespace vitrel {

struct HybridState;

/// Alternating growth and Monte Carlo (hybrid.h).
struct HybridStage : StageDefaults {
  using State = HybridState;
  static constexpr const char* method = "hybrid";
  static constexpr const char* summary =
      "short intervals of event-driven growth that alternate with Monte Carlo";

  std::optional<double> packing_fraction;
  std::optional<double> reduced_pressure;
  double growth_rate = GrowthOptions().growth_rate;
  std::uint64_t stretch_sweeps = HybridOptions().stretch.sweeps;
  Moves moves = SamplingOptions().moves;
  ExchangeOptions exchanges;

  static std::vector<StageField<HybridStage>> fields();
  void validate(const Rules& rules, int dimension) const;
  StageEnding ending() const;
  double end(const SystemParameters& system, double before) const;
  std::string description(double goal) const;
  template <int Dim>
  StageReport advance(Configuration<Dim>& configuration, HybridState& state,
                      const StageContext& context, const RunControl& control) const;
  void record(const HybridState& state, StageRecord& record) const;
  static void number_sweeps(HybridState& state, std::uint64_t next_sweep);

  template <class AnyState, class Visit>
  static void each_item(AnyState& state, Visit&& visit) {
    each_item_of_growth(state.growth, "hybrid.growth.", visit);
    each_item_of_sampling(state.sampling, "hybrid.", visit);
    visit("hybrid.stretches", state.stretches);
    visit("hybrid.stretch_end", state.stretch_end);
  }
};

}  // namespace vitrel

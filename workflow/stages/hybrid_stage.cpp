#include "workflow/stages/hybrid_stage.h"

#include "workflow/stages/growth_goal.h"
#include "workflow/stages/hybrid.h"
#include "workflow/stages/stage_fields.h"
#include "workflow/stages/stage_record.h"

namespace vitrel {
namespace {

void describe_stretch_sweeps(HybridStage& stage, FieldVisitor& visit) {
  visit.field({"stretch_sweeps",
               "",
               "Monte Carlo sweeps after every interval of growth. An interval ends when all "
               "lengths have grown by 1 %, or by less at high pressure.",
               {.low = 1, .words = "be at least 1; without sweeps the method is \"grow\""}},
              stage.stretch_sweeps);
}

}  // namespace

std::vector<StageField<HybridStage>> HybridStage::fields() {
  return {{"packing_fraction", describe_packing_fraction},
          {"reduced_pressure", describe_reduced_pressure},
          {"growth_rate", describe_growth_rate},
          {"stretch_sweeps", describe_stretch_sweeps},
          {"moves", describe_moves},
          {"exchanges", describe_exchanges}};
}

StageReport HybridStage::advance(HybridState& state, const StageContext& context) const {
  const HybridOptions options{
      growth_rate, packing_fraction_goal(context.packing_fraction), reduced_pressure,
      SamplingOptions{stretch_sweeps, moves, exchanges, context.threads}, context.seed};
  return context.with_configuration(
      [&](auto& configuration) { return hybrid(configuration, options, state, context.control); });
}

void HybridStage::record(const HybridState& state, StageRecord& record) const {
  record.add(state.sampling);
  record.growth = state.growth;
}

}  // namespace vitrel

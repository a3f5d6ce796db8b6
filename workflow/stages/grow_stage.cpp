#include "workflow/stages/grow_stage.h"

#include "edmd/growth.h"
#include "workflow/stages/growth_goal.h"
#include "workflow/stages/stage_fields.h"
#include "workflow/stages/stage_record.h"

namespace vitrel {
namespace {

void describe_retries(GrowStage& stage, FieldVisitor& visit) {
  visit.field({"retries",
               "",
               "If the particles jam below the packing fraction, all lengths shrink by a tenth and "
               "grow again at half the rate, up to so many times.",
               {0, 30}},
              stage.retries);
}

}  // namespace

std::vector<StageField<GrowStage>> GrowStage::fields() {
  return {{"packing_fraction", describe_packing_fraction},
          {"reduced_pressure", describe_reduced_pressure},
          {"growth_rate", describe_growth_rate},
          {"retries", describe_retries}};
}

StageReport GrowStage::advance(GrowthState& state, const StageContext& context) const {
  const GrowthOptions options{growth_rate, packing_fraction_goal(context.packing_fraction),
                              reduced_pressure, context.seed, retries};
  return context.with_configuration(
      [&](auto& configuration) { return grow(configuration, options, state, context.control); });
}

void GrowStage::record(const GrowthState& state, StageRecord& record) const {
  record.growth = state;
}

}  // namespace vitrel

#include "workflow/stages/grow_stage.h"

#include "edmd/growth.h"
#include "mc/options.h"
#include "workflow/stages/growth_goal.h"
#include "workflow/stages/stage_fields.h"
#include "workflow/stages/stage_record.h"

namespace vitrel {

std::vector<StageField<GrowStage>> GrowStage::fields() {
  return {{"packing_fraction", describe_packing_fraction},
          {"reduced_pressure", describe_reduced_pressure},
          {"growth_rate", describe_growth_rate}};
}

void GrowStage::validate(const Rules& rules, const StageSubject&) const {
  validate_growth_rate(growth_rate, rules);
  validate_reduced_pressure(reduced_pressure, rules);
}

StageEnding GrowStage::ending() const {
  return growth_ending(*this);
}

double GrowStage::end(const SystemParameters& system, double before) const {
  return end_of_growth(*this, system, before);
}

std::string GrowStage::description(double goal) const {
  return growth_description(*this, goal);
}

template <int Dim>
StageReport GrowStage::advance(Configuration<Dim>& configuration, GrowthState& state,
                               const StageContext& context, const RunControl& control) const {
  const GrowthOptions options{growth_rate, packing_fraction_goal(*this, context.packing_fraction),
                              reduced_pressure, context.seed};
  return grow(configuration, options, state, control);
}

template StageReport GrowStage::advance(Configuration2&, GrowthState&, const StageContext&,
                                        const RunControl&) const;
template StageReport GrowStage::advance(Configuration3&, GrowthState&, const StageContext&,
                                        const RunControl&) const;

void GrowStage::record(const GrowthState& state, StageRecord& record) const {
  record.growth = state;
}

}  // namespace vitrel

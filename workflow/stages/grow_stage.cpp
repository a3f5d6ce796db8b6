#include "workflow/stages/grow_stage.h"

#include "edmd/growth.h"
#include "mc/options.h"
#include "workflow/stages/growth_goal.h"
#include "workflow/stages/stage_fields.h"
#include "workflow/stages/stage_record.h"

namespace vitrel {
namespace {

void describe_retries(GrowStage& stage, FieldVisitor& visit) {
  visit.field({"retries", "",
               "If the particles jam below the packing fraction, all lengths shrink by a tenth and "
               "grow again at half the rate, up to so many times."},
              stage.retries);
}

}  // namespace

std::vector<StageField<GrowStage>> GrowStage::fields() {
  return {{"packing_fraction", describe_packing_fraction},
          {"reduced_pressure", describe_reduced_pressure},
          {"growth_rate", describe_growth_rate},
          {"retries", describe_retries}};
}

void GrowStage::validate(const Rules& rules, int /*dimension*/) const {
  validate_growth_rate(growth_rate, rules);
  validate_reduced_pressure(reduced_pressure, rules);
  rules.require(retries >= 0 && retries <= 30, "retries",
                fmt::format("is {}, but must lie between 0 and 30", retries));
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
                              reduced_pressure, context.seed, retries};
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

#include "workflow/stages/sample_stage.h"

#include <fmt/format.h>

#include "mc/sampling.h"
#include "workflow/stages/stage_fields.h"
#include "workflow/stages/stage_record.h"

namespace vitrel {
namespace {

void describe_decorrelations(SampleStage& stage, FieldVisitor& visit) {
  visit.field(
      {"decorrelations", "",
       "If above 0, sampling goes on until the state has decorrelated this often: until places, "
       "orientations and sizes, each place by place, have fallen to 1/e, again and again. From 10 "
       "on, the analysis of a run that starts from the state takes it for one in equilibrium."},
      stage.decorrelations);
}

}  // namespace

std::vector<StageField<SampleStage>> SampleStage::fields() {
  return {{"moves", describe_moves},
          {"exchanges", describe_exchanges},
          {"decorrelations", describe_decorrelations},
          {"max_sweeps", describe_max_sweeps},
          {"sweeps", describe_sweeps}};
}

void SampleStage::validate(const Rules& rules, int /*dimension*/) const {
  const SampleStage defaults;
  rules.require(decorrelations == 0 || sweeps == defaults.sweeps, "sweeps",
                "has no effect beside decorrelations; give max_sweeps instead");
  rules.require(decorrelations > 0 || max_sweeps == defaults.max_sweeps, "max_sweeps",
                "has no effect without decorrelations; give sweeps instead");
}

std::string SampleStage::description() const {
  return decorrelations > 0 ? fmt::format("sample until decorrelated {} times", decorrelations)
                            : fmt::format("sample for {} sweeps", sweeps);
}

StageReport SampleStage::advance(SamplingState& state, const StageContext& context) const {
  const SamplingOptions options{decorrelations > 0 ? max_sweeps : sweeps, moves, exchanges,
                                context.threads, decorrelations};
  return context.with_configuration([&](auto& configuration) {
    return sample(configuration, options, context.seed, state, context.control);
  });
}

void SampleStage::record(const SamplingState& state, StageRecord& record) const {
  record.add(state);
}

}  // namespace vitrel

#include "workflow/stages/sample_stage.h"

#include <fmt/format.h>

#include "mc/sampling.h"
#include "workflow/stages/stage_fields.h"
#include "workflow/stages/stage_record.h"

namespace vitrel {

std::vector<StageField<SampleStage>> SampleStage::fields() {
  return {
      {"moves", describe_moves}, {"exchanges", describe_exchanges}, {"sweeps", describe_sweeps}};
}

void SampleStage::validate(const Rules& rules, int /*dimension*/) const {
  rules.require(sweeps >= 1, "sweeps", "is 0, but must be at least 1");
  validate_exchanges(*this, rules);
}

double SampleStage::end(const SystemParameters&, double before) const {
  return before;
}

std::string SampleStage::description(double) const {
  return fmt::format("sample for {} sweeps", sweeps);
}

template <int Dim>
StageReport SampleStage::advance(Configuration<Dim>& configuration, SamplingState& state,
                                 const StageContext& context, const RunControl& control) const {
  return sample(configuration, {sweeps, moves, exchanges, context.threads}, context.seed, state,
                control);
}

template StageReport SampleStage::advance(Configuration2&, SamplingState&, const StageContext&,
                                          const RunControl&) const;
template StageReport SampleStage::advance(Configuration3&, SamplingState&, const StageContext&,
                                          const RunControl&) const;

void SampleStage::record(const SamplingState& state, StageRecord& record) const {
  record.add(state);
}

void SampleStage::number_sweeps(SamplingState& state, std::uint64_t next_sweep) {
  state.number_sweeps(next_sweep);
}

}  // namespace vitrel

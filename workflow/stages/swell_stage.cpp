#include "workflow/stages/swell_stage.h"

#include <fmt/format.h>

#include "mc/swelling.h"
#include "workflow/stages/stage_fields.h"
#include "workflow/stages/stage_record.h"

namespace vitrel {

std::vector<StageField<SwellStage>> SwellStage::fields() {
  return {{"packing_fraction", describe_packing_fraction}, {"max_sweeps", describe_max_sweeps}};
}

void SwellStage::validate(const Rules& rules, int /*dimension*/) const {
  rules.require(max_sweeps >= 1, "max_sweeps", "is 0, but must be at least 1");
}

double SwellStage::end(const SystemParameters& system, double) const {
  return packing_fraction.value_or(system.packing_fraction);
}

std::string SwellStage::description(double goal) const {
  return fmt::format("swell to packing fraction {:.4g}", goal);
}

template <int Dim>
StageReport SwellStage::advance(Configuration<Dim>& configuration, SwellingState& state,
                                const StageContext& context, const RunControl& control) const {
  return swell(configuration, {context.packing_fraction, max_sweeps, context.threads}, context.seed,
               state, control);
}

template StageReport SwellStage::advance(Configuration2&, SwellingState&, const StageContext&,
                                         const RunControl&) const;
template StageReport SwellStage::advance(Configuration3&, SwellingState&, const StageContext&,
                                         const RunControl&) const;

void SwellStage::record(const SwellingState& state, StageRecord& record) const {
  record.add(state.moves);
}

void SwellStage::number_sweeps(SwellingState& state, std::uint64_t next_sweep) {
  state.moves.next_sweep = next_sweep;
}

}  // namespace vitrel

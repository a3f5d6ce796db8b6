#include "workflow/stages/swell_stage.h"

#include <fmt/format.h>

#include "mc/swelling.h"
#include "workflow/stages/stage_fields.h"
#include "workflow/stages/stage_record.h"

namespace vitrel {

std::vector<StageField<SwellStage>> SwellStage::fields() {
  return {{"packing_fraction", describe_packing_fraction}, {"max_sweeps", describe_max_sweeps}};
}

StageReport SwellStage::advance(SwellingState& state, const StageContext& context) const {
  const SwellingOptions options{context.packing_fraction, max_sweeps, context.threads};
  return context.with_configuration([&](auto& configuration) {
    return swell(configuration, options, context.seed, state, context.control);
  });
}

void SwellStage::record(const SwellingState& state, StageRecord& record) const {
  record.add(state.moves);
}

}  // namespace vitrel

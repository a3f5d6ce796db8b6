#include "workflow/stages/stage_state.h"

namespace vitrel {

StageState first_state(const Stage& stage, std::uint64_t next_sweep) {
  return std::visit(
      [&]<class S>(const S&) {
        StateOf<S> state;
        if constexpr (requires { state.value.number_sweeps(next_sweep); })
          state.value.number_sweeps(next_sweep);
        return StageState(std::move(state));
      },
      stage);
}

StageReport advance_stage(const Stage& stage, StageState& state, const StageContext& context) {
  return std::visit(
      [&]<class S>(const S& options) -> StageReport {
        return options.advance(std::get<StateOf<S>>(state).value, context);
      },
      stage);
}

StageRecord record_of(const Stage& stage, const StageState& state) {
  StageRecord record;
  std::visit(
      [&]<class S>(const S& options) { options.record(std::get<StateOf<S>>(state).value, record); },
      stage);
  return record;
}

}  // namespace vitrel

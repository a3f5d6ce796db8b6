#include "workflow/stages/stage_state.h"

namespace vitrel {

StageState first_state(const Stage& stage, std::uint64_t next_sweep) {
  return std::visit(
      [&]<class S>(const S&) {
        StateOf<S> state;
        S::number_sweeps(state.value, next_sweep);
        return StageState(std::move(state));
      },
      stage);
}

template <int Dim>
StageReport advance_stage(const Stage& stage, StageState& state, Configuration<Dim>& configuration,
                          const StageContext& context, const RunControl& control) {
  return std::visit(
      [&]<class S>(const S& options) -> StageReport {
        return options.advance(configuration, std::get<StateOf<S>>(state).value, context, control);
      },
      stage);
}

template StageReport advance_stage(const Stage&, StageState&, Configuration2&, const StageContext&,
                                   const RunControl&);
template StageReport advance_stage(const Stage&, StageState&, Configuration3&, const StageContext&,
                                   const RunControl&);

StageRecord record_of(const Stage& stage, const StageState& state) {
  StageRecord record;
  std::visit(
      [&]<class S>(const S& options) { options.record(std::get<StateOf<S>>(state).value, record); },
      stage);
  return record;
}

}  // namespace vitrel

#include "workflow/stages/stage_state.h"

#include <stdexcept>

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
        typename S::State& own = std::get<StateOf<S>>(state).value;
        if constexpr (requires { options.advance(configuration, own, context, control); })
          return options.advance(configuration, own, context, control);
        else
          throw std::logic_error("a stage that this dimension does not have");
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

#pragma once

#include <type_traits>
#include <variant>

#include "mc/compression.h"
#include "mc/sampling.h"
#include "mc/swelling.h"
#include "workflow/stages/hybrid.h"
#include "workflow/stages/stage.h"
#include "workflow/stages/stage_record.h"

/// @file
/// Execution of stages.
namespace vitrel {

template <class S>
struct StateOf {
  using Kind = S;
  typename S::State value = {};
};

template <class Variant>
struct StatesOf;
template <class... S>
struct StatesOf<std::variant<S...>> {
  using Type = std::variant<StateOf<S>...>;
};

/// The progress of a stage; the alternative has the index of the stage.
using StageState = StatesOf<Stage>::Type;

/// Returns the state of a stage that has not begun. Its Monte Carlo sweeps are numbered from `next_sweep`.
StageState first_state(const Stage& stage, std::uint64_t next_sweep);

/// Runs the stage, or continues it from `state`. Returns `reached` at the end of the stage, `stalled` if the stage
/// cannot get there, and `stopped` if the run control requests a stop.
StageReport advance_stage(const Stage& stage, StageState& state, const StageContext& context);

/// The results of the stage, as far as its state contains them.
StageRecord record_of(const Stage& stage, const StageState& state);

/// Visits the items of the state that a checkpoint holds; `state` may be constant.
void each_item_of_stage(auto& state, auto&& visit) {
  std::visit([&](auto& one) { std::decay_t<decltype(one)>::Kind::each_item(one.value, visit); },
             state);
}

}  // namespace vitrel

#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/state/observer.h"
#include "core/state/stage.h"
#include "edmd/brownian.h"
#include "edmd/engine.h"

namespace vitrel {

/// Newtonian dynamics, or Brownian: the same with all velocities redrawn every `brownian_step`.
struct DynamicsOptions {
  EngineOptions engine;
  bool brownian = false;
  double brownian_step = 0.1;  ///< τ_B
  Temperature temperature = Temperature::total;
  std::uint64_t seed = 1;
};

/// Everything a run needs to go on, and nothing else: a plain value, written to checkpoints. Only
/// states handed out at block ends continue bit by bit.
template <int Dim>
struct RunState {
  Configuration<Dim> configuration;  ///< synchronised; its time runs from −equilibration
  RunCounters counters;
  std::uint64_t brownian_steps = 0;
  std::uint64_t next_sample = 0;
  std::uint64_t next_tick = 0;
  double start_time = 0;        ///< of the whole run
  double flight_energy = 0;     ///< energy + dissipated energy after the last draw of velocities
  double energy_drift = 0;      ///< largest |change of energy + dissipated|/energy between draws
  double largest_momentum = 0;  ///< largest |Σ m v| between draws
};

/// The state at the start of a run from a configuration with its velocities set.
template <int Dim>
RunState<Dim> begin_run(const Configuration<Dim>& configuration, double start_time);

/// A second schedule beside the samples, for an observer that wants many more of them and keeps none:
/// ticks at 0, interval, 2 interval … ≤ end of the run.
template <int Dim>
struct Ticks {
  double interval = 0;
  Observer<Dim>* observer = nullptr;  ///< null: no ticks
};

/// What is to happen: samples at ascending times (in simulated time), the end, and who is told. The
/// observer sees every sample; `at_block_end` gets a state from which the run continues bit by bit.
/// Samples and ticks change nothing in the motion, except that a block may end at one of them: from there
/// on, two runs with different schedules differ in their rounding.
template <int Dim>
struct RunPlan {
  std::vector<double> sample_times;
  double end_time = 0;
  Observer<Dim>* observer = nullptr;
  std::function<void(const RunState<Dim>&)> at_block_end;
  Ticks<Dim> ticks = {};
};

/// Runs to the end, or to the end of the block in which the control asked to stop. A sample or tick that
/// coincides with a Brownian step is taken before the velocities are redrawn. Throws InvariantError
/// on an overlap, and if time stands still (inelastic collapse); `state` then holds the moment of
/// the failure.
template <int Dim>
StageReport run(RunState<Dim>& state, const DynamicsOptions& options, const RunPlan<Dim>& plan,
                const RunControl& control);

using RunState2 = RunState<2>;
using RunState3 = RunState<3>;
using RunPlan2 = RunPlan<2>;
using RunPlan3 = RunPlan<3>;

}  // namespace vitrel

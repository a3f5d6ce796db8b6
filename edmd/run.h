#pragma once

#include <functional>
#include <vector>

#include "core/state/observer.h"
#include "core/state/stage.h"
#include "edmd/brownian.h"
#include "edmd/engine.h"
#include "edmd/options.h"
#include "edmd/sampling.h"

namespace vitrel {

/// The complete state of a run, a plain value that is written to checkpoints. A run continues with bit-identical
/// results only from a state at the end of a block; the state at the end of the run is not one.
template <int Dim>
struct RunState {
  Configuration<Dim> configuration;  ///< synchronised; its time runs from −equilibration
  RunCounters counters;
  std::uint64_t velocity_steps = 0;  ///< draws of Brownian dynamics, or kicks
  std::uint64_t next_sample = 0;
  std::uint64_t next_tick = 0;
  double start_time = 0;        ///< start of the whole run
  double flight_energy = 0;     ///< energy + dissipated energy after the last draw of velocities
  double energy_drift = 0;      ///< largest |change of energy + dissipated|/energy between draws
  double largest_momentum = 0;  ///< largest |Σ m v| between draws
  /// Wall time of observers and at block ends, outside of the event loop.
  double output_seconds = 0;
};

/// Returns the state at the start of a run from a configuration whose velocities are set.
template <int Dim>
RunState<Dim> begin_run(const Configuration<Dim>& configuration, double start_time);

/// A second schedule in addition to the samples, for an observer that needs many more frames and stores none. The ticks
/// are at 0, interval, 2 interval … ≤ end of the run.
template <int Dim>
struct Ticks {
  double interval = 0;
  Observer<Dim>* observer = nullptr;  ///< null: no ticks
};

/// The schedule of a run: sample times in ascending order (simulated time), the end, and the observers. `observer` sees
/// every sample; `at_block_end` gets a state from which the run continues with bit-identical results, also to a later
/// end. The state at the end of the run is not one. Samples and ticks do not change the motion, but a block ends after
/// a number of them: from there on, runs with different schedules differ by rounding.
template <int Dim>
struct RunPlan {
  SampleTimes sample_times;
  double end_time = 0;
  Observer<Dim>* observer = nullptr;
  std::function<void(const RunState<Dim>&)> at_block_end;
  Ticks<Dim> ticks = {};
  /// Called after every tick later than time 0; if it returns true, the run ends there.
  std::function<bool(double time)> is_over = {};
};

/// Runs to the end, or to the end of the block in which the run control requests a stop. A sample or tick that
/// coincides with a Brownian step or a kick is taken before the velocities change. Throws InvariantError on an overlap,
/// and if time does not advance (inelastic collapse); `state` is then the state at the failure.
template <int Dim>
StageReport run(RunState<Dim>& state, const DynamicsOptions& options, const RunPlan<Dim>& plan,
                const RunControl& control);

using RunState2 = RunState<2>;
using RunState3 = RunState<3>;
using RunPlan2 = RunPlan<2>;
using RunPlan3 = RunPlan<3>;

}  // namespace vitrel

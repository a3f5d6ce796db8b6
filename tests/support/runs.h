#pragma once

#include "edmd/run.h"
#include "edmd/sampling.h"
#include "tests/support/scenes.h"

/// Whole runs of event-driven dynamics.
namespace vitrel {

inline DynamicsOptions brownian(double step) {
  DynamicsOptions options;
  options.brownian = true;
  options.brownian_step = step;
  return options;
}

inline DynamicsOptions with_laws(const ContactLaws& laws, double contact_duration = 0) {
  DynamicsOptions options;
  options.engine.laws = laws;
  options.engine.contact_duration = contact_duration;
  return options;
}

/// The state at time `end` of a run that begins at time 0.
template <int Dim>
RunState<Dim> run_until(const Configuration<Dim>& start, double end,
                        const DynamicsOptions& options = {}) {
  RunState<Dim> state = begin_run(start, 0);
  run(state, options, {{}, end, nullptr, {}}, {});
  return state;
}

/// Frames and tallies at these times of a run that begins at time `begin`.
template <int Dim>
FrameRecorder<Dim> recorded_run(const Configuration<Dim>& start, double begin,
                                const SampleTimes& times, double end,
                                const DynamicsOptions& options = {}) {
  RunState<Dim> state = begin_run(start, begin);
  FrameRecorder<Dim> recorder;
  run(state, options, {times, end, &recorder, {}}, {});
  return recorder;
}

}  // namespace vitrel

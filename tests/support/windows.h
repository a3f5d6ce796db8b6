#pragma once

#include <vector>

#include "tests/support/runs.h"
#include "tests/support/statistics.h"

/// Runs whose averages over windows of time are independent of each other.
namespace vitrel {

/// Frames and tallies at the ends of so many windows of equal duration, of a run that begins at time `begin`.
template <int Dim>
FrameRecorder<Dim> run_in_windows(const Configuration<Dim>& start, double begin, double window,
                                  int windows, const DynamicsOptions& options = {}) {
  const double end = window * windows;
  return recorded_run(start, begin, linear_times(window, end), end, options);
}

/// Z from the virial of the collisions between every frame and the next, which are so much time apart. The values are
/// independent of each other if that is long against the time between collisions.
template <int Dim>
std::vector<double> virial_compressibilities(const FrameRecorder<Dim>& recorder, double window) {
  std::vector<double> values;
  for (std::size_t k = 1; k < recorder.frames.size(); ++k)
    values.push_back(virial_compressibility(
        recorder.frames[k - 1], recorder.tallies[k].virial - recorder.tallies[k - 1].virial,
        window));
  return values;
}

}  // namespace vitrel

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/methods/method.h"
#include "core/state/stage.h"

namespace vitrel::bench {

/// How a whole Newtonian run of the scene of the thesis (woetzel2012; N = 100, κ = 2, φ = 0.5, from a square
/// lattice) goes when one method predicts its collisions. What it overlooks becomes an overlap, for
/// which the thesis has its correction move.
struct WholeRun {
  std::string method;
  double tolerance = 0;
  double simulated_time = 0;  ///< less than wanted if the run stood still, or was stopped
  std::uint64_t collisions = 0;
  std::uint64_t correction_moves = 0;
  double collisions_per_second = 0;
  double energy_drift = 0;     ///< largest |E − E₀|/E₀ at the samples
  double deepest_overlap = 0;  ///< in any sample, by the exact check; in units of b
  bool stood_still = false;    ///< events without end at one time
};

/// Samples every 0.1 units of time.
WholeRun thesis_scene_with(const Method& method, double duration, std::uint64_t seed,
                           const RunControl& control);

/// The methods that can carry a run, each at a series of tolerances.
std::vector<Method> methods_for_whole_runs();

}  // namespace vitrel::bench

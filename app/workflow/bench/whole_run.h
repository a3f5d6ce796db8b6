#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/workflow/bench/chart.h"
#include "bench/lab/whole_run.h"

/// `vitrel bench whole-run`: the scene of the thesis, run with every method that can carry a run, at
/// every tolerance.
namespace vitrel {

struct WholeRunRequest {
  double duration = 100;  ///< simulated time, as in the thesis
  std::uint64_t seed = 1;
  std::vector<std::string> methods;  ///< by name; empty: all
};

struct WholeRunBench {
  std::vector<lab::WholeRun> rows;  ///< of the runs that are done
  bool stopped = false;
};

/// Throws UserError for an unknown method.
WholeRunBench bench_whole_run(const WholeRunRequest& request, const RunControl& control);

nlohmann::ordered_json whole_run_json(const std::vector<lab::WholeRun>& rows);

/// The rows as lines, grouped by method; "·" stands for 0. Below, which runs stood still.
std::string whole_run_text(const std::vector<lab::WholeRun>& rows);

/// Correction moves per 1000 collisions; NaN without collisions.
double corrections_per_thousand(const lab::WholeRun& run);

/// Collisions per second against correction moves per 1000 collisions; hollow: the run stood still.
Chart whole_run_chart(const std::vector<lab::WholeRun>& rows);

}  // namespace vitrel

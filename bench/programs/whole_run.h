#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/programs/report.h"
#include "bench/surveys/whole_run.h"
#include "core/io/json.h"

namespace vitrel::bench {

struct WholeRunOptions {
  double duration = 100;  ///< simulated time, as in the thesis
  std::uint64_t seed = 1;
  std::vector<std::string> methods;  ///< by name; empty: all
};

/// `vitrel-bench whole-run`: the scene of the thesis (woetzel2012), run with every method that
/// can carry a run, at every tolerance. Throws UserError for an unknown method.
int whole_run(const WholeRunOptions& options, const OutputOptions& output);

/// The runs that were done before a stop.
std::vector<WholeRun> measure_whole_runs(const WholeRunOptions& options, Report& report);
Json whole_runs_json(const std::vector<WholeRun>& runs);

}  // namespace vitrel::bench

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/io/json.h"
#include "workflow/sweep/sweep_jobs.h"

/// @file
/// The cost, the progress and the results of the jobs of a sweep.
namespace vitrel {

/// One row per job with its stage and results, "–" where there is none. Below the rows, the table says why jobs
/// failed and, if the sweep runs through seeds, gives averages over them with 95 % intervals.
std::string sweep_table(const std::vector<SweepJob>& jobs, const std::filesystem::path& folder);

/// `jobs` holds for every job its values, its stage, and its summaries if it is done, or how its last attempt ended.
/// `seeds` holds the averages over seeds if the sweep runs through them.
Json sweep_summary(const std::vector<SweepJob>& jobs, const std::filesystem::path& folder);

/// Says in one sentence each what has changed in the parameter file since the jobs were begun: parameters, and jobs
/// that have a folder but are no longer in the file.
std::vector<std::string> sweep_changes(const std::vector<SweepJob>& jobs,
                                       const std::filesystem::path& folder);

/// Says in lines of text what a sweep would do, and writes nothing. A row for every job gives its stage and what its
/// preparation and its run are expected to cost (preparation_plan.h, run_cost.h). The last line gives the sum of what
/// is left with `parallel` jobs at a time.
std::string sweep_plan(const std::vector<SweepJob>& jobs, const std::filesystem::path& folder,
                       int parallel);

}  // namespace vitrel

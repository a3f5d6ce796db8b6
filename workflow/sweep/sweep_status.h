#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/io/json.h"
#include "workflow/sweep/sweep_jobs.h"

/// @file
/// What the jobs of a sweep will cost, how far they are, and what they gave.
namespace vitrel {

/// One row per job: its stage and results, "–" where there is none. Below them, why jobs failed; and if the
/// sweep runs through seeds, averages over them with 95 % intervals.
std::string sweep_table(const std::vector<SweepJob>& jobs, const std::filesystem::path& folder);

/// `jobs`: of every job its values, stage, and summaries (done) or how its last attempt ended; `seeds`: averages over
/// seeds, if the sweep runs through them.
Json sweep_summary(const std::vector<SweepJob>& jobs, const std::filesystem::path& folder);

/// What has changed in the parameter file since jobs were begun, a sentence each: parameters, and jobs in
/// the folder that are no longer in the file.
std::vector<std::string> sweep_changes(const std::vector<SweepJob>& jobs,
                                       const std::filesystem::path& folder);

/// What a sweep would do, in lines for a person: a row for every job with what its preparation and its run are expected
/// to cost (preparation_plan.h, run_cost.h), how far it is, and the sum of what is left, with so many jobs at a time.
/// Nothing is written.
std::string sweep_plan(const std::vector<SweepJob>& jobs, const std::filesystem::path& folder,
                       int parallel);

}  // namespace vitrel

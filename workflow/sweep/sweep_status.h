#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/io/json.h"
#include "workflow/sweep/sweep_jobs.h"

/// @file
/// How far the jobs of a sweep are, and what they gave.
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

}  // namespace vitrel

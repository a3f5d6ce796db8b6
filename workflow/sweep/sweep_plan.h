#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "workflow/sweep/sweep_jobs.h"

namespace vitrel {

/// What a sweep would do, in lines for a person: a row for every job with what its preparation and its run are expected to
/// cost (stage_cost.h, run_cost.h), how far it is, and the sum of what is left, with so many jobs at a time. Nothing is
/// written.
std::string sweep_plan(const std::vector<SweepJob>& jobs, const std::filesystem::path& folder,
                       int parallel);

}  // namespace vitrel

#pragma once

#include <filesystem>
#include <vector>

#include "app/workflow/analyze.h"
#include "app/workflow/glass_study.h"

/// What the runs of a sweep say together.
namespace vitrel {

/// All finished jobs of a sweep with the results that are in their folders; a choice of other
/// parameters makes these anew. Throws FileError or UserError, naming the file.
std::vector<AnalysedRun> analysed_jobs(const std::filesystem::path& folder, AnalysisChoice choice);

/// Relaxation times and verdicts of the runs that could be judged, and fits of the laws of the glass
/// transition to them.
GlassStudy glass_study(const std::vector<AnalysedRun>& runs);

/// Table `runs`, the summaries of all runs, one row each; and those of their glass study.
Results results_of_sweep(const std::vector<AnalysedRun>& runs, const GlassStudy& study);

}  // namespace vitrel

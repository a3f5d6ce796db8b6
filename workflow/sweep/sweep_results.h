#pragma once

#include <vector>

#include "analysis/glass/glass_study.h"
#include "workflow/analyze/analyze.h"
#include "workflow/sweep/sweep.h"

/// @file
/// What the runs of a sweep say together.
namespace vitrel {

/// The finished jobs of a sweep by packing fraction (to six decimals), then by seed, then by name. What only
/// prepares a state has the summary of its preparation; that of a run also has its overlaps and the exceptions
/// of soft particles. Their results are those in their folders; with parameters of its own, the choice has the
/// runs analysed again, and what is in the folders stays. Throws FileError or UserError, naming the file.
std::vector<AnalysedRun> analysed_jobs(const SweepProgress& sweep, const AnalysisChoice& choice,
                                       const AnalysisProgress& progress = {});

/// Relaxation times and verdicts of the runs that could be judged, and fits of the laws of the glass
/// transition to them.
GlassStudy glass_study(const std::vector<AnalysedRun>& runs);

/// Table `runs`, the summaries of all runs with the names of their jobs and their seeds, one row each in their order; if the sweep runs
/// through seeds `seeds`, averages over them (seed_averages.h); and the tables of the glass study. The
/// files of the rows are in the provenance: row_0 ….
Results results_of_sweep(const std::vector<AnalysedRun>& runs, const GlassStudy& study);

}  // namespace vitrel

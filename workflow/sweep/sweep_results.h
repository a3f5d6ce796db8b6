#pragma once

#include <vector>

#include "analysis/glass/glass_study.h"
#include "workflow/analyze/analyze.h"
#include "workflow/sweep/study_axes.h"
#include "workflow/sweep/sweep.h"

/// @file
/// The combined results of the jobs of a sweep.
namespace vitrel {

/// The finished jobs of a sweep.
struct AnalysedSweep {
  /// Sorted by the axes, or without axes by packing fraction (to six decimals), then by seed, then by name.
  std::vector<AnalysedRun> runs;
  std::vector<SweptValues> values;                ///< of each run
  std::vector<std::vector<Published>> published;  ///< of each run
  std::vector<StudyAxis> keys;                    ///< all but the seed
  std::vector<StudyAxis> axes;  ///< keys whose values differ (study_axes); the last is the abscissa

  /// The values that distinguish the job from the others: "κ = 2, φ = 0.5, seed 1".
  std::string label(std::size_t job) const;
};

/// Collects the results of the finished jobs. A job that only prepares a state has the summary of its preparation;
/// the summary of a run also has its overlaps, the exceptions of soft particles, and its cost. The results are those
/// in the folders of the jobs. If `choice` has parameters of its own, the runs are analyzed again, and the folders
/// stay as they are. Throws FileError or UserError, naming the file.
AnalysedSweep analysed_sweep(const SweepProgress& sweep, const AnalysisChoice& choice,
                             const AnalysisProgress& progress = {});

/// Relaxation times and verdicts of the runs that could be judged, with fits of the laws of the glass transition.
/// transition to them.
GlassStudy glass_study(const AnalysedSweep& sweep);

/// The table `runs` has a row for every job, in their order: its name, the values of the keys, the seed, the summary
/// of its analysis, relaxation times and verdicts. If the sweep runs through seeds, the table `seeds` has averages
/// over them (seed_averages.h). The tables `published` and `published_exponents` compare them with publications
/// (published_tables.h). The tables of the glass study follow. The provenance has the files of the rows, row_0 …, and
/// the names of columns of the tables: `axis` is the abscissa of charts, and `series` lists the columns that
/// distinguish curves, separated by commas.
Results results_of_sweep(const AnalysedSweep& sweep, const GlassStudy& study);

}  // namespace vitrel

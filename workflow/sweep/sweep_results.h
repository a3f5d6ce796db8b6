#pragma once

#include <vector>

#include "analysis/glass/glass_study.h"
#include "workflow/analyze/analyze.h"
#include "workflow/sweep/study_axes.h"
#include "workflow/sweep/sweep.h"

/// @file
/// What the jobs of a sweep say together.
namespace vitrel {

/// The finished jobs of a sweep.
struct AnalysedSweep {
  /// By the axes, or by packing fraction (to six decimals) without any, then by seed, then by name.
  std::vector<AnalysedRun> runs;
  std::vector<SweptValues> values;                ///< of each run
  std::vector<std::vector<Published>> published;  ///< of each run
  std::vector<StudyAxis> keys;                    ///< all but the seed
  std::vector<StudyAxis> axes;  ///< those that differ (study_axes); the last one is the abscissa

  /// What tells a job from the others: "κ = 2, φ = 0.5, seed 1".
  std::string label(std::size_t job) const;
};

/// What only prepares a state has the summary of its preparation; that of a run also has its overlaps, the exceptions
/// of soft particles and its cost. Their results are those in their folders; with parameters of its own, the choice has
/// the runs analysed again, and what is in the folders stays. Throws FileError or UserError, naming the file.
AnalysedSweep analysed_sweep(const SweepProgress& sweep, const AnalysisChoice& choice,
                             const AnalysisProgress& progress = {});

/// Relaxation times and verdicts of the runs that could be judged, and fits of the laws of the glass
/// transition to them.
GlassStudy glass_study(const AnalysedSweep& sweep);

/// Table `runs` has a row for every job, in their order: its name, the values of the keys, the seed, the summary of its
/// analysis, relaxation times and verdicts. If the sweep runs through seeds, `seeds` has averages over them
/// (seed_averages.h). What publications say stands beside it in `published` and `published_exponents`
/// (published_tables.h). The tables of the glass study follow. In the provenance are the files of the rows, row_0 …,
/// and the names of columns of both tables: `axis`, the abscissa of charts, and `series`, which tell curves apart, with
/// commas.
Results results_of_sweep(const AnalysedSweep& sweep, const GlassStudy& study);

}  // namespace vitrel

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "workflow/sweep/job_folder.h"
#include "workflow/sweep/study_axes.h"

/// @file
/// Averages over jobs of a sweep that differ in their seeds only.
namespace vitrel {

/// The results of a finished job.
struct JobResult {
  SweptValues values;
  Figures figures;
  std::vector<Published> published = {};
};

/// The average of one number over seeds, from the scatter of the seeds and the errors of the runs (mean_of_runs in
/// blocking.h). It is NaN unless every seed has the number, because seeds that lack it are often special.
struct AveragedFigure {
  std::string name;
  double mean;
  double error;       ///< standard error: mean ± error covers 68.3 %; NaN for one seed
  double half_width;  ///< of the 95 % confidence interval; NaN for one seed
  /// Scatter of the seeds over the errors of the runs; NaN if these are not known.
  double scatter;
  bool is_excessive;  ///< whether the seeds differ by more than the errors of the runs explain
};

/// The average over all jobs whose values differ in system.seed only.
struct SeedAverage {
  SweptValues values;  ///< without the seed
  std::size_t seeds;
  std::vector<AveragedFigure> figures;    ///< numbers that the first of the jobs has
  std::vector<Published> published = {};  ///< entries of the first of the jobs

  /// The values in words: "packing_fraction 0.4, duration 60"; "all" if there are none.
  std::string name() const;
  /// The average of this name; NaN if there is none.
  AveragedFigure find(const std::string& name) const;
};

/// The averages, in the order in which the values first occur.
std::vector<SeedAverage> seed_averages(const std::vector<JobResult>& jobs);

/// Whether a sweep runs through seeds.
bool has_seeds(const SweptValues& values);

}  // namespace vitrel

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "workflow/sweep/job_folder.h"
#include "workflow/sweep/study_axes.h"

/// @file
/// Jobs of a sweep that differ in nothing but their seeds.
namespace vitrel {

/// What a finished job gave.
struct JobResult {
  SweptValues values;
  Figures figures;
  std::vector<Published> published = {};
};

/// The average of one number over seeds, from the scatter of the seeds and the errors of the runs (mean_of_runs in
/// blocking.h); NaN if not every seed has it, as those that lack it are often those that are special.
struct AveragedFigure {
  std::string name;
  double mean;
  double error;       ///< standard error, such that mean ± error covers 68.3 %; NaN for one seed
  double half_width;  ///< of the 95 % interval; NaN for one seed
  double scatter;     ///< of the seeds over the errors of the runs; NaN where these are not known
  bool is_excessive;  ///< the seeds differ by more than the errors of the runs explain
};

/// All jobs with the same values but for system.seed.
struct SeedAverage {
  SweptValues values;  ///< without the seed
  std::size_t seeds;
  std::vector<AveragedFigure> figures;    ///< those that the first of the jobs has
  std::vector<Published> published = {};  ///< the same

  /// "packing_fraction 0.4, duration 60"; "all" without values.
  std::string name() const;
  /// The average of that name; NaN if there is none.
  AveragedFigure find(const std::string& name) const;
};

/// In the order in which the values first occur.
std::vector<SeedAverage> seed_averages(const std::vector<JobResult>& jobs);

/// Whether a sweep runs through seeds.
bool has_seeds(const SweptValues& values);

}  // namespace vitrel

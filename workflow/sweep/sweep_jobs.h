#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/io/json.h"
#include "workflow/configuration/parameters.h"
#include "workflow/sweep/study_axes.h"

/// @file
/// The jobs of a sweep. The keys of [sweep.together] are one axis, every key of [sweep.grid] is
/// another; each combination of the axes' values is a job.
namespace vitrel {

struct SweepJob {
  /// Name of the folder, from the last parts of the keys: "packing_fraction-0.4_seed-1". Of the keys
  /// that advance together, it has the first, or as many as tell the jobs apart.
  std::string id;
  std::vector<std::pair<std::string, std::string>> values;  ///< dotted key, TOML text of the value
  Parameters parameters;
  StudyLayout layout;  ///< the same for all jobs
  std::vector<Published> published;
  bool prepares_only = false;  ///< no key of [dynamics] is given: the job is a state, not a run
  std::string predecessor;     ///< the job of the ladder from whose end it starts; may be empty
};

/// The end of a job, a run or state in its folder.
const char* product_of(const SweepJob& job);

/// All combinations, those of the keys that advance together slowest, the last key of the grid
/// fastest; a file without either is one job. Throws UserError if a combination is impossible, if two
/// have the same name, or if the command line sets a key that the sweep sets.
///
/// Runs in the plane at several packing fractions get one analysis.wave_numbers, unless they are given: that of the
/// main peak (main_wave_number) at the highest number density, so that their relaxation times compare.
std::vector<SweepJob> sweep_jobs(const ParameterSource& source);

/// The job of this name. UserError if there is none.
const SweepJob& job_named(const std::vector<SweepJob>& jobs, const std::string& id);

Json values_json(const SweepJob& job);

}  // namespace vitrel

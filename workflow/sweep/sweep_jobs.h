#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/io/json.h"
#include "workflow/configuration/parameters.h"
#include "workflow/sweep/study_axes.h"

/// @file
/// The jobs of a sweep. The keys of [sweep.together] are one axis, and every key of [sweep.grid] is another. Each
/// combination of values of the axes is a job.
namespace vitrel {

struct SweepJob {
  /// The name of the folder, made from the last parts of the keys: "packing_fraction-0.4_seed-1". Of the keys that
  /// advance together, it contains the first, or as many as distinguish the jobs.
  std::string id;
  std::vector<std::pair<std::string, std::string>> values;  ///< dotted key and value as TOML
  Parameters parameters;
  StudyLayout layout;  ///< identical for all jobs
  std::vector<Published> published;
  /// True if no key of [dynamics] is given: the job makes a state, not a run.
  bool prepares_only = false;
  std::string predecessor;  ///< the job of the ladder from whose end this one starts; may be empty
};

/// The file that the job makes in its folder: a run or a state.
const char* product_of(const SweepJob& job);

/// All combinations of the values of the axes. The keys that advance together vary slowest, the last key of the grid
/// fastest. A file without either makes one job. Throws UserError if a combination is impossible, if two have the
/// same name, or if the command line sets a key that the sweep sets.
///
/// If runs have several packing fractions and none gives analysis.wave_numbers, all get the same one: that of the
/// main peak (main_wave_number) at the highest number density, so that their relaxation times can be compared.
std::vector<SweepJob> sweep_jobs(const ParameterSource& source);

/// The job of this name. Throws UserError if there is none.
const SweepJob& job_named(const std::vector<SweepJob>& jobs, const std::string& id);

Json values_json(const SweepJob& job);

}  // namespace vitrel

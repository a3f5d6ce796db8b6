#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "app/workflow/parameters.h"

/// Many runs from one parameter file. Every combination of the grid's values is a job with a folder
/// of its own:
///
///   sweep/<id>/params.json      the job's values of the grid, and its id
///             /parameters.toml  all its parameters
///             /state.h5 run.h5 results.h5
///                               made by prepare, run, analyze, each in a process of its own
///             /prepare.json run.json analyze.json log.txt
///                               what these said
///             /done.json        written last
///
/// Every step may be repeated: what is complete is left alone, a run that was cut off is continued.
/// So the same command continues a sweep that was stopped or killed.
namespace vitrel {

struct SweepJob {
  std::string id;  ///< name of the folder, from the last parts of the keys: "packing_fraction-0.4"
  std::vector<std::pair<std::string, std::string>> values;  ///< dotted key, TOML text of the value
  Parameters parameters;
};

/// All combinations, the last key of the grid fastest; a file without a grid is one job. Throws
/// UserError if a combination is impossible.
std::vector<SweepJob> sweep_jobs(const ParameterSource& source);

enum class JobStage { waiting, prepared, started, done };
const char* name_of(JobStage stage);
/// By the files in the job's folder.
JobStage job_stage(const std::filesystem::path& folder);

struct SweepRequest {
  ParameterSource source;
  std::filesystem::path folder;
  std::filesystem::path program;  ///< this program, run for every step
  int parallel = 1;               ///< jobs at a time
  double wall_time = 0;           ///< seconds; 0: no limit
};

struct SweepOutcome {
  std::size_t done = 0;
  std::size_t failed = 0;
  int first_failure = 0;  ///< exit code of the first job that failed
  bool stopped = false;
};

/// Makes the folders, works off all jobs, and tells `say` about every job begun, done or failed. A
/// failed job does not stop the others. Throws UserError if a folder belongs to other parameters or
/// another process works on the sweep, FileError if folders cannot be written.
SweepOutcome run_sweep(const SweepRequest& request,
                       const std::function<void(const std::string&)>& say);

/// One row per job: its values, stage and results.
std::string sweep_table(const std::vector<SweepJob>& jobs, const std::filesystem::path& folder);
nlohmann::ordered_json sweep_summary(const std::vector<SweepJob>& jobs,
                                     const std::filesystem::path& folder);

/// The folders of a sweep's finished jobs, in alphabetical order. UserError if there are none.
std::vector<std::filesystem::path> finished_jobs(const std::filesystem::path& folder);

}  // namespace vitrel

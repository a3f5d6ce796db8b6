#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/io/json.h"
#include "core/io/parameters.h"
#include "workflow/sweep/sweep_jobs.h"

/// @file
/// The folder of a job:
///
///     sweep/<id>/params.json      the values of the job, and its place in the sweep
///               /parameters.toml  all parameters of the job
///               /state.h5 run.h5 results.h5
///                                 made by prepare, run and analyze, each in a process of its own
///               /prepare.json run.json analyze.json log.txt
///                                 the output of these processes
///               /done.json        written last
///               /end.json         how the last attempt ended, if the job is not done
namespace vitrel {

enum class JobStage { waiting, prepared, started, stopped, failed, done };
const char* name_of(JobStage stage);
/// The stage of the job as its files show it.
JobStage job_stage(const std::filesystem::path& folder);

/// The file of the job's run or, if it only prepares a state, of its state. The file of a finished job may have been
/// removed, since the results suffice for the analysis of the whole sweep.
std::filesystem::path job_product(const std::filesystem::path& folder);

/// Creates or updates the folder. A finished job is no longer done if the duration of its run or the parameters of
/// its analysis have changed, or if it now has a run and had none before. Throws UserError if the job was begun with
/// other parameters of what is there already, and FileError if the folder cannot be written.
void write_job_folder(const SweepJob& job, const std::filesystem::path& folder);

/// The first parameter whose value differs from that with which the job was begun; no value if it was not begun.
std::optional<ParameterDifference> change_since_begun(const SweepJob& job,
                                                      const std::filesystem::path& folder);

/// Records that an attempt ended before the job was done: the step, the exit code, and the last line of the log. If
/// the file cannot be written, as on a full disk, nothing is recorded.
void write_job_end(JobStage stage, const std::string& step, int exit_code,
                   const std::filesystem::path& folder);
/// The summaries of the steps of a finished job: "prepare", and "run" or "analyze" if the job has them. Throws
/// FileError.
Json job_done(const std::filesystem::path& folder);
/// The place of a job in its sweep.
struct JobPlace {
  SweptValues values;
  StudyLayout layout;
  std::vector<Published> published;
};
/// Reads the place of the job; empty for a run that belongs to no sweep. Throws FileError.
JobPlace job_place(const std::filesystem::path& folder);
/// Reads what write_job_end wrote; null if there is no such file. Throws FileError.
Json job_end(const std::filesystem::path& folder);
/// Puts the end of an attempt into words: "failed in run with exit code 3: run.h5: cannot be written".
std::string job_end_text(const Json& end);
/// Removes the record of the last attempt, before the next one.
void forget_job_end(const std::filesystem::path& folder);

/// The last line of the job's log.
std::string last_log_line(const std::filesystem::path& folder);

/// Numbers by name; NaN for a number that is not known.
using Figures = std::vector<std::pair<std::string, double>>;
/// The numbers in the summaries of a finished job: those of its analysis, and those of its run or, if it only
/// prepares a state, of its preparation. Empty for a job that is not done (null).
Figures job_figures(const Json& done);
/// The number of this name; NaN if there is none.
double figure(const Figures& figures, const std::string& name);

}  // namespace vitrel

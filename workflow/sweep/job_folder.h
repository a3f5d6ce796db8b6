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
///     sweep/<id>/params.json      the job's values, and its place in the sweep
///               /parameters.toml  all its parameters
///               /state.h5 run.h5 results.h5
///                                 made by prepare, run, analyze, each in a process of its own
///               /prepare.json run.json analyze.json log.txt
///                                 what these said
///               /done.json        written last
///               /end.json         of a job that is not done: how the last attempt ended
namespace vitrel {

enum class JobStage { waiting, prepared, started, stopped, failed, done };
const char* name_of(JobStage stage);
/// By the files in the job's folder.
JobStage job_stage(const std::filesystem::path& folder);

/// The run of a job, or if it only prepares a state, that. Of a finished job the file may have been removed: its results
/// are enough for the analysis of the whole sweep.
std::filesystem::path job_product(const std::filesystem::path& folder);

/// Makes the folder. Of a job that was done, the analysis is to be made anew if its parameters have changed, and so
/// is a run that was not asked for before. Throws UserError if the job was begun with other
/// parameters of what is there already, FileError if the folder cannot be written.
void write_job_folder(const SweepJob& job, const std::filesystem::path& folder);

/// The first parameter that has another value than when the job was begun; nothing if it was not begun.
std::optional<ParameterDifference> change_since_begun(const SweepJob& job,
                                                      const std::filesystem::path& folder);

/// Notes that an attempt ended before the job was done: in which step and with which exit code, and the last
/// line of the log. Where nothing can be written, as on a full disk, nothing is noted.
void write_job_end(JobStage stage, const std::string& step, int exit_code,
                   const std::filesystem::path& folder);
/// The summaries of the steps of a job that is done: "prepare", and "run" or "analyze" if there were such. FileError.
Json job_done(const std::filesystem::path& folder);
/// Where a job stands in its sweep.
struct JobPlace {
  SweptValues values;
  StudyLayout layout;
  std::vector<Published> published;
};
/// Empty for a run that belongs to no sweep. FileError.
JobPlace job_place(const std::filesystem::path& folder);
/// What write_job_end wrote; null without it. FileError.
Json job_end(const std::filesystem::path& folder);
/// In words: "failed in run with exit code 3: run.h5: cannot be written".
std::string job_end_text(const Json& end);
/// Before the next attempt.
void forget_job_end(const std::filesystem::path& folder);

/// The last line of the job's log.
std::string last_log_line(const std::filesystem::path& folder);

/// Numbers by name; NaN where one is not known.
using Figures = std::vector<std::pair<std::string, double>>;
/// The numbers that a finished job's summaries give: those of its analysis, and those of its run or, if it only
/// prepares a state, of the preparation. None of a job that is not done (null).
Figures job_figures(const Json& done);
/// The one of that name; NaN if there is none.
double figure(const Figures& figures, const std::string& name);

}  // namespace vitrel

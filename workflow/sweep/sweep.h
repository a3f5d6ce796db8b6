#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/state/stage.h"
#include "workflow/configuration/parameters.h"
#include "workflow/sweep/sweep_jobs.h"

/// @file
/// Many runs from one parameter file, each in a folder of its own (job_folder.h): prepare, run, analyze, each in
/// a process of its own.
///
/// Every step may be repeated: what is complete is left alone, a preparation or a run that was cut off is
/// continued. So the same command continues a sweep that was stopped or killed. To equilibrate is the
/// first part of the run, not a step of its own: both are one trajectory of the dynamics with one
/// checkpoint, and cutting it in two would add a file and a hand-over, but nothing to the results.
namespace vitrel {

struct SweepRequest {
  ParameterSource source;
  std::filesystem::path folder;
  std::filesystem::path program;  ///< this program, run for every step
  int parallel = 0;               ///< jobs at a time; 0: one here, on a cluster what it admits
};

struct SweepOutcome {
  std::size_t done = 0;
  std::size_t failed = 0;
  int first_failure = 0;  ///< exit code of the first job that failed
  bool stopped = false;
};

/// Makes the folders, runs all jobs, and tells `say` about every job begun, done or failed. A failed job
/// does not stop the others, unless it failed because the disk is full. If the control asks to stop, every
/// job stops where it can be continued. The control's progress is the share of the simulated time, jobs
/// weighted by their particles, in finished jobs and, by their logs, in running ones.
/// Throws UserError if a folder belongs to other parameters or another process works on the sweep, FileError
/// if folders cannot be written.
SweepOutcome run_sweep(const SweepRequest& request, const RunControl& control,
                       const std::function<void(const std::string&)>& say);

/// The same of one job, beside other processes that work on other jobs: what a batch system runs. Waits
/// while another process works on this job or on the whole sweep, and then finds what that has done.
SweepOutcome run_job(const SweepRequest& request, const std::string& id, const RunControl& control,
                     const std::function<void(const std::string&)>& say);

/// How far a sweep is, by its folder alone; all in alphabetical order.
struct SweepProgress {
  std::vector<std::filesystem::path> finished;  ///< folders of the jobs that are done
  std::vector<std::string> unfinished;          ///< names of the others

  /// The runs (or states) of the finished jobs, and their results.
  std::vector<std::filesystem::path> files() const;
  /// "12 of 18 jobs are finished".
  std::string share() const;
  /// The same, and the names of those that are left out of what is made of the others.
  std::string left_out() const;
};

/// UserError if no job is finished.
SweepProgress sweep_progress(const std::filesystem::path& folder);

}  // namespace vitrel

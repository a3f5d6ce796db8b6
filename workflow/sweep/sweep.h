#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/state/stage.h"
#include "workflow/configuration/parameters.h"
#include "workflow/sweep/sweep_jobs.h"

/// @file
/// Many runs from one parameter file, each in a folder of its own (job_folder.h). The steps prepare, run and analyze
/// run in processes of their own.
///
/// Every step may be repeated: a complete one is left as it is, and a preparation or run that was interrupted
/// continues. The same command therefore continues a sweep that was stopped or killed. Equilibration is the first
/// part of the run, not a step of its own: both are one trajectory of the dynamics with one checkpoint, and splitting
/// it would add a file and a hand-over, but nothing to the results.
namespace vitrel {

struct SweepRequest {
  ParameterSource source;
  std::filesystem::path folder;
  std::filesystem::path program;  ///< this program, which runs every step
  /// Jobs that run at a time. 0 means one at a time here, and as many as it admits on a cluster.
  int parallel = 0;
};

struct SweepOutcome {
  std::size_t done = 0;
  std::size_t failed = 0;
  int first_failure = 0;  ///< exit code of the first job that failed
  bool stopped = false;
};

/// Creates the folders, runs all jobs, and reports to `say` every job that begins, is done or fails. A failed job
/// does not stop the others, unless it failed because the disk is full. If the control requests a stop, every job
/// stops at a point from which it can continue. The control receives as progress the completed share of the simulated
/// time, with jobs weighted by their particles and with running jobs read from their logs. Throws UserError if a
/// folder belongs to other parameters or another process works on the sweep, and FileError if folders cannot be
/// written.
SweepOutcome run_sweep(const SweepRequest& request, const RunControl& control,
                       const std::function<void(const std::string&)>& say);

/// Runs one job, as a batch system does, while other processes may run other jobs. Waits while another process works
/// on this job or on the whole sweep, and then uses what that process has done.
SweepOutcome run_job(const SweepRequest& request, const std::string& id, const RunControl& control,
                     const std::function<void(const std::string&)>& say);

/// The progress of a sweep as its folder shows it; all lists are in alphabetical order.
struct SweepProgress {
  std::vector<std::filesystem::path> finished;  ///< folders of the jobs that are done
  std::vector<std::string> unfinished;          ///< names of the others

  /// The files of the runs (or states) of the finished jobs, and of their results.
  std::vector<std::filesystem::path> files() const;
  /// The progress in words: "12 of 18 jobs are finished".
  std::string share() const;
  /// The progress in words, with the names of the unfinished jobs, which are left out of the results.
  std::string left_out() const;
};

/// Throws UserError if no job is finished.
SweepProgress sweep_progress(const std::filesystem::path& folder);

}  // namespace vitrel

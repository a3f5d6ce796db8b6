#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/io/atomic_file.h"
#include "workflow/sweep/process.h"
#include "workflow/sweep/sweep_jobs.h"

namespace vitrel {

/// Runs the steps of one job, one process at a time, and keeps its folder up to date (job_folder.h).
class JobWorker {
 public:
  /// Starts the first step that is not complete. Throws FileError.
  JobWorker(const SweepJob& job, const std::filesystem::path& folder,
            const std::filesystem::path& program);

  enum class State { running, done, failed, stopped };
  State state() const { return state_; }
  int exit_code() const { return exit_code_; }
  const SweepJob& job() const { return job_; }

  void ask_to_stop();
  /// Starts the next step if the current one has ended. Throws FileError.
  void poll();
  /// The completed share of the run according to its log; 0 during the preparation.
  double share();

 private:
  struct Step {
    const char* name;
    const char* product;
    bool skip_if_there;  ///< true if the product exists only once it is complete
  };
  static std::vector<Step> steps_of(const SweepJob& job);

  std::filesystem::path summary(const Step& step) const;
  bool is_complete(const Step& step) const;
  void start_next();
  std::vector<std::string> command(const Step& step) const;
  void finish();
  void give_up(State state);

  const SweepJob& job_;
  std::filesystem::path folder_, program_;
  std::vector<Step> steps_;
  std::size_t next_ = 0;
  std::optional<AtomicFile> printed_;  ///< the output of the current step: its summary
  std::optional<ChildProcess> child_;
  State state_ = State::running;
  bool is_asked_to_stop_ = false;
  int exit_code_ = 0;
  double share_ = 0;
};

/// The share of the run that a line of the progress of `vitrel run` states; 0 for other lines.
double share_of_run(const std::string& log_line);

}  // namespace vitrel

#include "workflow/sweep/sweep.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <deque>
#include <memory>
#include <thread>

#include "core/error.h"
#include "core/io/text_file.h"
#include "workflow/sweep/folder_lock.h"
#include "workflow/sweep/job_folder.h"
#include "workflow/sweep/job_worker.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

// An estimate of the cost of a job, in a unit common to the jobs of one sweep.
double work_of(const SweepJob& job) {
  const auto particles = static_cast<double>(job.parameters.system.particles);
  const DynamicsParameters& dynamics = job.parameters.dynamics;
  return job.prepares_only ? particles : particles * (dynamics.equilibration + dynamics.duration);
}

// Whether a file could not be written because the disk is full: the job says so, or hardly any space is left.
bool is_disk_full(const fs::path& folder) {
  constexpr std::uintmax_t hardly_any = 1 << 16;
  std::error_code unknown;
  return last_log_line(folder).find(std::strerror(ENOSPC)) != std::string::npos ||
         fs::space(folder, unknown).available < hardly_any;
}

// Keeps `parallel` jobs running until all are done or the user wants to stop.
class Sweep {
 public:
  Sweep(const SweepRequest& request, const std::vector<SweepJob>& jobs, const RunControl& control,
        const std::function<void(const std::string&)>& say)
      : request_(request), control_(control), say_(say), jobs_(jobs) {}

  SweepOutcome run() {
    make_folder(request_.folder);
    FolderLock lock(request_.folder);
    lock.hold_alone();
    for (const SweepJob& job : jobs_) write_job_folder(job, request_.folder / job.id);
    return run_jobs();
  }

  /// Runs a single job while other processes may run other jobs.
  SweepOutcome run_beside_others() {
    const fs::path folder = request_.folder / jobs_.front().id;
    const std::string& predecessor = jobs_.front().predecessor;
    if (!is_done(predecessor))
      throw UserError(
          fmt::format("{}: starts from the end of the job {}, which is not done; run that first",
                      jobs_.front().id, predecessor));
    make_folder(folder);
    FolderLock sweep(request_.folder), job(folder);
    if (!wait_for(sweep, FolderLock::Share::with_others) ||
        !wait_for(job, FolderLock::Share::alone))
      return {.stopped = true};
    write_job_folder(jobs_.front(), folder);
    return run_jobs();
  }

 private:
  bool wait_for(FolderLock& lock, FolderLock::Share share) const {
    bool told = false;
    return lock.acquire(share, [&] {
      if (!told) say_("waiting for another process that works on this job");
      told = true;
      return control_.stop_requested();
    });
  }

  SweepOutcome run_jobs() {
    for (const SweepJob& job : jobs_) {
      all_work_ += work_of(job);
      if (job_stage(request_.folder / job.id) == JobStage::done)
        note_done(job);
      else
        waiting_.push_back(&job);
    }
    if (outcome_.done > 0)
      say_(fmt::format("{} of {} jobs are done already", outcome_.done, jobs_.size()));
    while (!active_.empty() || (!waiting_.empty() && !stopping_)) {
      pass_on_stop();
      fill();
      give_up_blocked();
      for (auto& worker : active_) worker->poll();
      collect();
      report_progress();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    outcome_.stopped = outcome_.done + outcome_.failed < jobs_.size();
    return outcome_;
  }

  /// Whether the job of this name is done; true for an empty name.
  bool is_done(const std::string& id) const {
    return id.empty() || job_stage(request_.folder / id) == JobStage::done;
  }

  void note_done(const SweepJob& job) {
    ++outcome_.done;
    finished_work_ += work_of(job);
  }

  /// Reports at most once a second, because the progress of a running job is read from its log.
  void report_progress() {
    const Clock::time_point now = Clock::now();
    if (now - reported_ < std::chrono::seconds(1)) return;
    reported_ = now;
    double work = finished_work_;
    for (auto& worker : active_) work += worker->share() * work_of(worker->job());
    control_.report_progress(
        {work / all_work_, static_cast<double>(outcome_.done + outcome_.failed), "jobs"});
  }

  void pass_on_stop() {
    if (!stopping_ && control_.stop_requested())
      stop("stopping: every job stops at the next point from which it can be continued");
  }

  void stop(const std::string& reason) {
    stopping_ = true;
    say_(reason);
    for (auto& worker : active_) worker->ask_to_stop();
  }

  /// Finds the next job whose predecessor is done.
  std::deque<const SweepJob*>::iterator next_ready() {
    return std::ranges::find_if(waiting_,
                                [&](const SweepJob* job) { return is_done(job->predecessor); });
  }

  void fill() {
    while (!stopping_ && active_.size() < std::max<std::size_t>(request_.parallel, 1)) {
      const auto next = next_ready();
      if (next == waiting_.end()) return;
      const SweepJob& job = **next;
      waiting_.erase(next);
      say_(fmt::format("{}: started", job.id));
      active_.push_back(
          std::make_unique<JobWorker>(job, request_.folder / job.id, request_.program));
    }
  }

  /// Gives up the waiting jobs once their predecessors can no longer become done.
  void give_up_blocked() {
    if (!active_.empty() || stopping_ || next_ready() != waiting_.end()) return;
    for (const SweepJob* job : waiting_) {
      say_(fmt::format("{}: not begun, as {} is not done", job->id, job->predecessor));
      finished_work_ += work_of(*job);
    }
    outcome_.failed += waiting_.size();
    waiting_.clear();
  }

  void collect() {
    for (const auto& worker : active_) {
      const std::string& id = worker->job().id;
      if (worker->state() == JobWorker::State::done) {
        note_done(worker->job());
        say_(fmt::format("{}: done ({} of {})", id, outcome_.done, jobs_.size()));
      } else if (worker->state() == JobWorker::State::failed) {
        note_failed(*worker);
      }
    }
    std::erase_if(active_,
                  [](const auto& worker) { return worker->state() != JobWorker::State::running; });
  }

  void note_failed(const JobWorker& worker) {
    constexpr int file_error = 3;
    const fs::path folder = request_.folder / worker.job().id;
    if (outcome_.failed++ == 0) outcome_.first_failure = worker.exit_code();
    finished_work_ += work_of(worker.job());
    say_(fmt::format("{}: failed with exit code {}: {}", worker.job().id, worker.exit_code(),
                     last_log_line(folder)));
    // Every other job would fail in the same way.
    if (!stopping_ && worker.exit_code() == file_error && is_disk_full(folder))
      stop("the disk is full: no more jobs are started; make room, and the same command continues");
  }

  using Clock = std::chrono::steady_clock;

  const SweepRequest& request_;
  const RunControl& control_;
  const std::function<void(const std::string&)>& say_;
  const std::vector<SweepJob>& jobs_;
  std::deque<const SweepJob*> waiting_;
  std::vector<std::unique_ptr<JobWorker>> active_;
  SweepOutcome outcome_;
  bool stopping_ = false;
  double all_work_ = 0, finished_work_ = 0;
  Clock::time_point reported_{};
};

}  // namespace

SweepOutcome run_sweep(const SweepRequest& request, const RunControl& control,
                       const std::function<void(const std::string&)>& say) {
  const std::vector<SweepJob> jobs = sweep_jobs(request.source);
  return Sweep(request, jobs, control, say).run();
}

SweepOutcome run_job(const SweepRequest& request, const std::string& id, const RunControl& control,
                     const std::function<void(const std::string&)>& say) {
  const std::vector<SweepJob> jobs = {job_named(sweep_jobs(request.source), id)};
  return Sweep(request, jobs, control, say).run_beside_others();
}

std::vector<fs::path> SweepProgress::files() const {
  std::vector<fs::path> files;
  for (const fs::path& job : finished)
    files.insert(files.end(), {job_product(job), job / "results.h5"});
  return files;
}

std::string SweepProgress::share() const {
  return fmt::format("{} of {} jobs are finished", finished.size(),
                     finished.size() + unfinished.size());
}

std::string SweepProgress::left_out() const {
  return fmt::format("{}; {} {} left out", share(), fmt::join(unfinished, ", "),
                     unfinished.size() == 1 ? "is" : "are");
}

SweepProgress sweep_progress(const fs::path& folder) {
  SweepProgress progress;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (fs::exists(entry.path() / "done.json"))
      progress.finished.push_back(entry.path());
    else if (fs::exists(entry.path() / "params.json"))
      progress.unfinished.push_back(entry.path().filename().string());
  }
  std::sort(progress.finished.begin(), progress.finished.end());
  std::sort(progress.unfinished.begin(), progress.unfinished.end());
  if (progress.finished.empty())
    throw UserError(
        progress.unfinished.empty()
            ? fmt::format("{}: is neither the folder of a sweep nor that of a job which has begun "
                          "to run; give one of these, or the file of a run",
                          folder.string())
            : fmt::format("{}: none of the {} jobs of this sweep is finished; vitrel sweep runs "
                          "them",
                          folder.string(), progress.unfinished.size()));
  return progress;
}

}  // namespace vitrel

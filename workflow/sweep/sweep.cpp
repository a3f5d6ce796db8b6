#include "workflow/sweep/sweep.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/error.h"
#include "core/io/atomic_file.h"
#include "core/io/json.h"
#include "workflow/storage/text_file.h"
#include "workflow/sweep/folder_lock.h"
#include "workflow/sweep/process.h"
#include "workflow/sweep/snakemake.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

// A preparation or a run saves its state and ends with 5; an analysis has nothing to save, and a
// signal just ends it.
bool is_stop(int exit_code) {
  return exit_code == 5 ||
         std::any_of(stop_signals.begin(), stop_signals.end(),
                     [exit_code](int number) { return exit_code == 128 + number; });
}

// What was begun with other parameters is refused, but for those of the analysis, which is made anew.
void write_job_folder(const SweepJob& job, const fs::path& folder) {
  make_folder(folder);
  const fs::path file = folder / "parameters.toml";
  const std::string text = effective_parameters(job.parameters);
  if (fs::exists(file)) {
    const std::string before = read_text(file);
    if (const auto change = forbidden_change(before, text, Work::run))
      throw UserError(
          fmt::format("{}: this job was begun with {} = {}, but now it is {}; use another "
                      "folder for the sweep, or delete the job's",
                      folder.string(), change->key, change->first, change->second));
    const auto is_elsewhere = [](const std::string& key) { return !key.starts_with("analysis."); };
    if (first_difference(before, text, is_elsewhere)) fs::remove(folder / "done.json");
  }
  write_text(file, text);
  write_text(folder / "params.json",
             json_text({{"id", job.id}, {"values", values_json(job)}}, 2) + "\n");
}

// Runs the steps of one job, a process at a time.
class JobWorker {
 public:
  JobWorker(const SweepJob& job, const fs::path& folder, const fs::path& program)
      : job_(job), folder_(folder), program_(program) {
    start_next();
  }

  enum class State { running, done, failed, stopped };
  State state() const { return state_; }
  int exit_code() const { return exit_code_; }
  const SweepJob& job() const { return job_; }

  void ask_to_stop() {
    if (child_) child_->ask_to_stop();
  }

  /// Starts the next step if the current one has ended.
  void poll() {
    if (state_ != State::running) return;
    const std::optional<int> code = child_->poll();
    if (!code) return;
    exit_code_ = *code;
    if (is_stop(*code)) {
      state_ = State::stopped;
    } else if (*code != 0) {
      state_ = State::failed;
    } else {
      AtomicFile(summary(steps_[next_++])).commit();
      start_next();
    }
  }

 private:
  struct Step {
    const char* name;
    const char* product;
    bool skip_if_there;  ///< the product appears only when complete
  };
  static constexpr std::array<Step, 3> steps_ = {
      {{"prepare", "state.h5", true}, {"run", "run.h5", false}, {"analyze", "results.h5", false}}};

  fs::path summary(const Step& step) const { return folder_ / (std::string(step.name) + ".json"); }

  bool is_complete(const Step& step) const {
    return step.skip_if_there && fs::exists(folder_ / step.product) && fs::exists(summary(step));
  }

  void start_next() {
    while (next_ < steps_.size() && is_complete(steps_[next_])) ++next_;
    if (next_ == steps_.size()) {
      finish();
      return;
    }
    const Step& step = steps_[next_];
    // A product without its summary comes from a sweep killed between the two; it is made again.
    if (step.skip_if_there) fs::remove(folder_ / step.product);
    const fs::path unfinished = summary(step).string() + ".partial";
    child_ = std::make_unique<ChildProcess>(command(step), unfinished, folder_ / "log.txt");
  }

  std::vector<std::string> command(const Step& step) const {
    const auto file = [&](const char* name) { return (folder_ / name).string(); };
    std::vector<std::string> words = {program_.string(), step.name};
    if (step.name == std::string_view("analyze"))
      words.insert(words.end(), {file("run.h5"), "--params", file("parameters.toml")});
    else
      words.push_back(file("parameters.toml"));
    if (step.name == std::string_view("run"))
      words.insert(words.end(), {"--from", file("state.h5")});
    words.insert(words.end(), {"-o", file(step.product), "--json"});
    return words;
  }

  void finish() {
    Json done = {{"id", job_.id}, {"values", values_json(job_)}};
    for (const Step& step : steps_) done[step.name] = read_json(summary(step));
    write_text(folder_ / "done.json", json_text(done, 2) + "\n");
    state_ = State::done;
  }

  const SweepJob& job_;
  fs::path folder_, program_;
  std::size_t next_ = 0;
  std::unique_ptr<ChildProcess> child_;
  State state_ = State::running;
  int exit_code_ = 0;
};

std::string last_line(const fs::path& file) {
  std::string text = read_text(file);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

void hold_alone(FolderLock& lock, const fs::path& folder) {
  // As long as children of a killed sweep may take to die.
  int asked = 0;
  const auto gives_up = [&asked] { return ++asked > 10; };
  if (!lock.acquire(FolderLock::Share::alone, gives_up))
    throw UserError(folder.string() +
                    ": another process works on this sweep; wait for it or stop it "
                    "(vitrel sweep --status shows how far it is)");
}

// Keeps `parallel` jobs going until all are done or the user wants to stop.
class Sweep {
 public:
  Sweep(const SweepRequest& request, const std::vector<SweepJob>& jobs, const RunControl& control,
        const std::function<void(const std::string&)>& say)
      : request_(request), control_(control), say_(say), jobs_(jobs) {}

  SweepOutcome run() {
    make_folder(request_.folder);
    FolderLock lock(request_.folder);
    hold_alone(lock, request_.folder);
    for (const SweepJob& job : jobs_) write_job_folder(job, request_.folder / job.id);
    return run_jobs();
  }

  /// Of a single job, beside others that work on other jobs.
  SweepOutcome run_beside_others() {
    const fs::path folder = request_.folder / jobs_.front().id;
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
      if (job_stage(request_.folder / job.id) == JobStage::done)
        ++outcome_.done;
      else
        waiting_.push_back(&job);
    }
    if (outcome_.done > 0)
      say_(fmt::format("{} of {} jobs are done already", outcome_.done, jobs_.size()));
    while (!active_.empty() || (!waiting_.empty() && !stopping_)) {
      pass_on_stop();
      fill();
      for (auto& worker : active_) worker->poll();
      collect();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    outcome_.stopped = outcome_.done + outcome_.failed < jobs_.size();
    return outcome_;
  }

  void pass_on_stop() {
    if (stopping_ || !control_.stop_requested()) return;
    stopping_ = true;
    say_("stopping: every job stops at the next point from which it can be continued");
    for (auto& worker : active_) worker->ask_to_stop();
  }

  void fill() {
    while (!stopping_ && !waiting_.empty() &&
           active_.size() < static_cast<std::size_t>(request_.parallel)) {
      const SweepJob& job = *waiting_.front();
      waiting_.pop_front();
      say_(fmt::format("{}: started", job.id));
      active_.push_back(
          std::make_unique<JobWorker>(job, request_.folder / job.id, request_.program));
    }
  }

  void collect() {
    for (const auto& worker : active_) {
      const std::string& id = worker->job().id;
      if (worker->state() == JobWorker::State::done) {
        ++outcome_.done;
        say_(fmt::format("{}: done ({} of {})", id, outcome_.done, jobs_.size()));
      } else if (worker->state() == JobWorker::State::failed) {
        if (outcome_.failed++ == 0) outcome_.first_failure = worker->exit_code();
        say_(fmt::format("{}: failed with exit code {}: {}", id, worker->exit_code(),
                         last_line(request_.folder / id / "log.txt")));
      }
    }
    std::erase_if(active_,
                  [](const auto& worker) { return worker->state() != JobWorker::State::running; });
  }

  const SweepRequest& request_;
  const RunControl& control_;
  const std::function<void(const std::string&)>& say_;
  const std::vector<SweepJob>& jobs_;
  std::deque<const SweepJob*> waiting_;
  std::vector<std::unique_ptr<JobWorker>> active_;
  SweepOutcome outcome_;
  bool stopping_ = false;
};

std::string number_cell(const Json& parent, const char* key, const char* format) {
  if (!parent.is_object() || !parent.contains(key) || !parent[key].is_number()) return "-";
  return fmt::format(fmt::runtime(format), parent[key].get<double>());
}

std::vector<std::string> result_cells(const fs::path& folder) {
  const JobStage stage = job_stage(folder);
  std::vector<std::string> cells = {name_of(stage)};
  Json run, analysis;
  if (stage == JobStage::done) {
    const Json done = read_json(folder / "done.json");
    run = done["run"];
    analysis = done["analyze"];
  }
  // Jobs done by earlier versions have the former key.
  const std::string z =
      run.contains("compressibility_factor") ? "compressibility_factor" : "compressibility";
  cells.push_back(number_cell(run, "packing_fraction", "{:.4f}"));
  cells.push_back(number_cell(run, "collisions", "{:.0f}"));
  cells.push_back(number_cell(run, z.c_str(), "{:.3f}"));
  cells.push_back(number_cell(run, (z + "_error").c_str(), "{:.3f}"));
  cells.push_back(number_cell(analysis, "diffusion", "{:.3g}"));
  cells.push_back(number_cell(analysis, "rotational_diffusion", "{:.3g}"));
  cells.push_back(number_cell(run, "overlaps", "{:.0f}"));
  cells.push_back(number_cell(run, "wall_seconds", "{:.1f}"));
  return cells;
}

}  // namespace

const char* name_of(JobStage stage) {
  constexpr const char* names[] = {"waiting", "prepared", "started", "done"};
  return names[static_cast<std::size_t>(stage)];
}

JobStage job_stage(const fs::path& folder) {
  if (fs::exists(folder / "done.json")) return JobStage::done;
  if (fs::exists(folder / "run.h5")) return JobStage::started;
  if (fs::exists(folder / "state.h5")) return JobStage::prepared;
  return JobStage::waiting;
}

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

void export_sweep(const ParameterSource& source, const fs::path& folder, const fs::path& program) {
  const std::vector<SweepJob> jobs = sweep_jobs(source);
  make_folder(folder);
  FolderLock lock(folder);
  hold_alone(lock, folder);
  for (const SweepJob& job : jobs) write_job_folder(job, folder / job.id);
  export_snakemake(source, jobs, folder, program);
}

std::string sweep_table(const std::vector<SweepJob>& jobs, const fs::path& folder) {
  std::vector<std::vector<std::string>> rows = {
      {"job", "stage", "phi", "collisions", "Z", "+-", "D", "D_rot", "overlaps", "seconds"}};
  for (const SweepJob& job : jobs) {
    std::vector<std::string> row = {job.id};
    for (std::string& cell : result_cells(folder / job.id)) row.push_back(std::move(cell));
    rows.push_back(std::move(row));
  }
  std::vector<std::size_t> widths(rows[0].size(), 0);
  for (const auto& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k)
      text += k < 2 ? fmt::format("{:<{}}  ", row[k], widths[k])
                    : fmt::format("{:>{}}  ", row[k], widths[k]);
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  }
  return text;
}

Json sweep_summary(const std::vector<SweepJob>& jobs, const fs::path& folder) {
  Json rows = Json::array();
  for (const SweepJob& job : jobs) {
    const JobStage stage = job_stage(folder / job.id);
    Json row = stage == JobStage::done ? read_json(folder / job.id / "done.json")
                                       : Json{{"id", job.id}, {"values", values_json(job)}};
    row["stage"] = name_of(stage);
    rows.push_back(std::move(row));
  }
  return {{"jobs", std::move(rows)}};
}

std::vector<fs::path> SweepProgress::files() const {
  std::vector<fs::path> files;
  for (const fs::path& job : finished)
    for (const char* name : {"run.h5", "results.h5"}) files.push_back(job / name);
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

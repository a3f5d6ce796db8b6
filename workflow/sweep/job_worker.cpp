#include "workflow/sweep/job_worker.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <string_view>

#include "core/io/json.h"
#include "core/io/text_file.h"
#include "workflow/sweep/job_folder.h"

namespace vitrel {
namespace {

// A preparation or a run that stops saves its state and ends with 5. An analysis has nothing to save, so a signal
// ends it.
bool is_stop(int exit_code) {
  return exit_code == 5 || std::ranges::any_of(stop_signals, [exit_code](int number) {
           return exit_code == 128 + number;
         });
}

}  // namespace

JobWorker::JobWorker(const SweepJob& job, const std::filesystem::path& folder,
                     const std::filesystem::path& program)
    : job_(job), folder_(folder), program_(program), steps_(steps_of(job)) {
  forget_job_end(folder_);
  start_next();
}

// A single state in the plane is not analyzed, because its quality report says everything.
std::vector<JobWorker::Step> JobWorker::steps_of(const SweepJob& job) {
  std::vector<Step> steps = {{"prepare", "state.h5", true}};
  if (!job.prepares_only) steps.push_back({"run", "run.h5", false});
  if (!job.prepares_only || job.parameters.system.dimension == 3)
    steps.push_back({"analyze", "results.h5", false});
  return steps;
}

void JobWorker::ask_to_stop() {
  is_asked_to_stop_ = true;
  if (child_) child_->ask_to_stop();
}

void JobWorker::poll() {
  if (state_ != State::running) return;
  const std::optional<int> code = child_->poll();
  if (!code) return;
  exit_code_ = *code;
  if (is_stop(*code)) {
    give_up(State::stopped);
  } else if (*code != 0) {
    give_up(State::failed);
  } else {
    printed_->commit();
    ++next_;
    // A child that was about to end when it was asked to stop has completed its step.
    if (is_asked_to_stop_ && next_ < steps_.size())
      give_up(State::stopped);
    else
      start_next();
  }
}

double JobWorker::share() {
  if (next_ < steps_.size() && steps_[next_].name == std::string_view("run"))
    share_ = std::max(share_, share_of_run(last_log_line(folder_)));
  return share_;
}

std::filesystem::path JobWorker::summary(const Step& step) const {
  return folder_ / (std::string(step.name) + ".json");
}

bool JobWorker::is_complete(const Step& step) const {
  return step.skip_if_there && std::filesystem::exists(folder_ / step.product) &&
         std::filesystem::exists(summary(step));
}

void JobWorker::start_next() {
  while (next_ < steps_.size() && is_complete(steps_[next_])) ++next_;
  if (next_ == steps_.size()) {
    finish();
    return;
  }
  const Step& step = steps_[next_];
  // A product without its summary is left by a sweep that was killed between the two, so it is made again.
  if (step.skip_if_there) std::filesystem::remove(folder_ / step.product);
  printed_.emplace(summary(step));
  child_.emplace(command(step), printed_->partial(), folder_ / "log.txt");
}

std::vector<std::string> JobWorker::command(const Step& step) const {
  const auto file = [&](const char* name) { return (folder_ / name).string(); };
  std::vector<std::string> words = {program_.string(), step.name};
  if (step.name == std::string_view("analyze"))
    words.insert(words.end(), {file(product_of(job_)), "--params", file("parameters.toml")});
  else
    words.push_back(file("parameters.toml"));
  if (step.name == std::string_view("run")) words.insert(words.end(), {"--from", file("state.h5")});
  words.insert(words.end(), {"-o", file(step.product), "--json"});
  return words;
}

void JobWorker::finish() {
  Json done = {{"id", job_.id}, {"values", values_json(job_)}};
  for (const Step& step : steps_) done[step.name] = read_json(summary(step));
  write_text(folder_ / "done.json", json_text(done, 2) + "\n");
  state_ = State::done;
}

void JobWorker::give_up(State state) {
  state_ = state;
  printed_.reset();
  write_job_end(state == State::failed ? JobStage::failed : JobStage::stopped, steps_[next_].name,
                exit_code_, folder_);
}

double share_of_run(const std::string& log_line) {
  std::istringstream words(log_line);
  std::string word, sign;
  double percent = 0;
  return words >> word >> percent >> sign && word == "run" && sign.starts_with("%") ? percent / 100
                                                                                    : 0;
}

}  // namespace vitrel

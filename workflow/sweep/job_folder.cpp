#include "workflow/sweep/job_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/io/text_file.h"
#include "core/special_values.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

/// The work whose parameters must not change any more: the run if it was begun, else the preparation.
Work work_in(const fs::path& folder) {
  return fs::exists(folder / "run.h5") ? Work::run : Work::preparation;
}

/// Whether a change of this key in a finished job might go unnoticed. A change of other keys makes the run longer or
/// the analysis a new one.
bool may_change_unnoticed(const std::string& key) {
  return !key.starts_with("analysis.") && !key.starts_with("dynamics.duration");
}

void refuse_other_parameters(const fs::path& folder, const std::string& before,
                             const std::string& now) {
  if (const auto change = forbidden_change(before, now, work_in(folder)))
    throw UserError(
        fmt::format("{}: this job was begun with {} = {}, but now it is {}; use another folder "
                    "for the sweep, or delete the job's",
                    folder.string(), change->key, change->first, change->second));
}

/// The present parameters of a job, completed with the recorded ones as for a run that continues.
std::string text_now(const SweepJob& job, const std::string& before, const fs::path& file) {
  return effective_parameters(
      continued(job.parameters, recorded_parameters(before, file.string())));
}

/// Whether a finished job needs no more work: it has a run if one is wanted, and neither its length nor its analysis
/// has changed.
bool is_still_done(const SweepJob& job, const fs::path& folder, const std::string& before,
                   const std::string& now) {
  return !first_difference(before, now, may_change_unnoticed) &&
         job_done(folder).contains("run") != job.prepares_only;
}

Json published_json(const std::vector<Published>& published) {
  Json list = Json::array();
  for (const Published& entry : published) {
    list.push_back({{"source", entry.source},
                    {"quantity", entry.quantity},
                    {entry.is_exponent ? "exponent" : "value", entry.value}});
    if (std::isfinite(entry.from)) list.back()["from"] = entry.from;
    if (std::isfinite(entry.to)) list.back()["to"] = entry.to;
  }
  return list;
}

std::vector<Published> published_in(const Json& list) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::vector<Published> published;
  for (const Json& entry : list) {
    const bool is_exponent = entry.contains("exponent");
    published.push_back({entry.at("source"), entry.at("quantity"),
                         entry.at(is_exponent ? "exponent" : "value"), is_exponent,
                         entry.value("from", -infinite), entry.value("to", infinite)});
  }
  return published;
}

/// Some earlier versions wrote only the former key, others both.
void remove_former_key(Json& figures, const std::string& suffix) {
  const std::string former = "compressibility" + suffix;
  const std::string key = "compressibility_factor" + suffix;
  if (!figures.contains(former)) return;
  if (!figures.contains(key)) figures[key] = Json(figures[former]);
  figures.erase(former);
}

}  // namespace

const char* name_of(JobStage stage) {
  constexpr const char* names[] = {"waiting", "prepared", "started", "stopped", "failed", "done"};
  return names[static_cast<std::size_t>(stage)];
}

JobStage job_stage(const fs::path& folder) {
  if (fs::exists(folder / "done.json")) return JobStage::done;
  if (const Json end = job_end(folder); !end.is_null())
    return end.at("stage") == name_of(JobStage::failed) ? JobStage::failed : JobStage::stopped;
  if (fs::exists(folder / "run.h5")) return JobStage::started;
  if (fs::exists(folder / "state.h5")) return JobStage::prepared;
  return JobStage::waiting;
}

fs::path job_product(const fs::path& folder) {
  const fs::path run = folder / "run.h5", done = folder / "done.json";
  const bool is_run = fs::exists(run) || (fs::exists(done) && job_done(folder).contains("run"));
  return is_run ? run : folder / "state.h5";
}

void write_job_folder(const SweepJob& job, const fs::path& folder) {
  make_folder(folder);
  const fs::path file = folder / "parameters.toml";
  std::string text = effective_parameters(job.parameters);
  if (fs::exists(file)) {
    const std::string before = read_text(file);
    text = text_now(job, before, file);
    refuse_other_parameters(folder, before, text);
    if (job_stage(folder) == JobStage::done && !is_still_done(job, folder, before, text))
      fs::remove(folder / "done.json");
  }
  write_text(file, text);
  write_text(folder / "params.json", json_text({{"id", job.id},
                                                {"values", values_json(job)},
                                                {"together", job.layout.together},
                                                {"published", published_json(job.published)},
                                                {"axis", job.layout.axis.value_or("")}},
                                               2) +
                                         "\n");
}

std::optional<ParameterDifference> change_since_begun(const SweepJob& job, const fs::path& folder) {
  const fs::path file = folder / "parameters.toml";
  if (!fs::exists(file)) return std::nullopt;
  const std::string before = read_text(file), now = text_now(job, before, file);
  if (auto forbidden = forbidden_change(before, now, work_in(folder))) return forbidden;
  return first_difference(before, now, may_change_unnoticed);
}

void write_job_end(JobStage stage, const std::string& step, int exit_code, const fs::path& folder) {
  try {
    const Json end = {{"stage", name_of(stage)},
                      {"step", step},
                      {"exit_code", exit_code},
                      {"message", last_log_line(folder)}};
    write_text(folder / "end.json", json_text(end, 2) + "\n");
  } catch (const FileError&) {
    // The output already reports how the job ended, and that report must not be lost to an error in this one.
  }
}

JobPlace job_place(const fs::path& folder) {
  JobPlace place;
  const fs::path file = folder / "params.json";
  if (!fs::exists(file)) return place;
  read_json_as("the values of a job", file, [&](const Json& job) {
    place.values = swept_values(job.at("values"));
    // Jobs of earlier versions lack these three keys.
    place.published = published_in(job.value("published", Json::array()));
    place.layout.together = job.value("together", std::vector<std::string>());
    if (const std::string axis = job.value("axis", ""); !axis.empty()) place.layout.axis = axis;
  });
  return place;
}

Json job_end(const fs::path& folder) {
  const fs::path file = folder / "end.json";
  Json end;
  if (fs::exists(file))
    read_json_as("the end of a job", file, [&](const Json& json) {
      static_cast<void>(job_end_text(json));  // checks that all fields are there
      end = json;
    });
  return end;
}

std::string job_end_text(const Json& end) {
  return fmt::format("{} in {} with exit code {}: {}", end.at("stage").get<std::string>(),
                     end.at("step").get<std::string>(), end.at("exit_code").get<int>(),
                     end.at("message").get<std::string>());
}

Json job_done(const fs::path& folder) {
  Json done;
  read_json_as("the summary of a job", folder / "done.json", [&](const Json& json) {
    for (const char* step : {"prepare", "run", "analyze"})
      if (json.contains(step)) static_cast<void>(json.at(step).get_ref<const Json::object_t&>());
    static_cast<void>(json.at(json.contains("run") ? "run" : "prepare"));
    done = json;
  });
  return done;
}

void forget_job_end(const fs::path& folder) {
  fs::remove(folder / "end.json");
}

std::string last_log_line(const fs::path& folder) {
  std::string text = read_text(folder / "log.txt");
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

Figures job_figures(const Json& done) {
  Json numbers = Json::object();
  for (const char* step : {"analyze", done.contains("run") ? "run" : "prepare"}) {
    if (!done.contains(step)) continue;
    for (const auto& [key, value] : done.at(step).items())
      if (value.is_number() || value.is_null()) numbers[key] = value;
  }
  for (const char* suffix : {"", "_error"}) remove_former_key(numbers, suffix);
  for (const char* no_result : {"seed", "dimension"}) numbers.erase(no_result);
  Figures figures;
  for (const auto& [key, value] : numbers.items())
    figures.emplace_back(key, number_or(value, unknown));
  return figures;
}

double figure(const Figures& figures, const std::string& name) {
  const auto found = std::ranges::find(figures, name, &Figures::value_type::first);
  return found == figures.end() ? unknown : found->second;
}

}  // namespace vitrel

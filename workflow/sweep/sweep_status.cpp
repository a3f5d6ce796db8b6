#include "workflow/sweep/sweep_status.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/io/number_text.h"
#include "workflow/sweep/job_folder.h"
#include "workflow/sweep/seed_averages.h"
#include "workflow/sweep/text_table.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

using Row = std::vector<std::string>;

/// A number of the summaries that has a column.
struct ShownFigure {
  const char* title;
  const char* key;
  const char* format;
  bool is_averaged;  ///< over seeds, too
};

constexpr ShownFigure shown_figures[] = {
    {"phi", "packing_fraction", "{:.4f}", true},
    {"collisions", "collisions", "{:.0f}", false},
    {"Z", "compressibility_factor", "{:.3f}", true},
    {"+-", "compressibility_factor_error", "{:.3f}", false},
    {"Z", "reduced_pressure", "{:.4g}", true},
    {"D", "diffusion", "{:.3g}", true},
    {"D_rot", "rotational_diffusion", "{:.3g}", true},
    {"tau_alpha", "tau_translation", "{:.4g}", true},
    {"tau_2", "tau_rotation", "{:.4g}", true},
    {"orientation", "orientation_ratio", "{:.4f}", true},
    {"contacts", "contact_number", "{:.3f}", true},
    {"early", "early_releases_per_collision", "{:.3g}", true},
    {"blocked", "blocked_rotations_per_collision", "{:.3g}", true},
    {"overlaps", "overlaps", "{:.0f}", false},
    {"seconds", "wall_seconds", "{:.2f}", true}};

/// Null unless the job is done.
Json done_of(const fs::path& folder) {
  return job_stage(folder) == JobStage::done ? job_done(folder) : Json();
}

std::string number_cell(const Figures& figures, const ShownFigure& shown) {
  const double value = figure(figures, shown.key);
  return std::isnan(value) ? missing_cell : fmt::format(fmt::runtime(shown.format), value);
}

std::string job_rows(const std::vector<SweepJob>& jobs, const fs::path& folder) {
  std::vector<Row> rows = {{"job", "stage"}};
  for (const ShownFigure& shown : shown_figures) rows[0].emplace_back(shown.title);
  for (const SweepJob& job : jobs) {
    const fs::path job_folder = folder / job.id;
    Row& row = rows.emplace_back(Row{job.id, name_of(job_stage(job_folder))});
    const Figures figures = job_figures(done_of(job_folder));
    for (const ShownFigure& shown : shown_figures) row.push_back(number_cell(figures, shown));
  }
  return text_table(rows, 2);
}

std::vector<SeedAverage> averages_of(const std::vector<SweepJob>& jobs, const fs::path& folder) {
  std::vector<JobResult> results;
  for (const SweepJob& job : jobs) {
    const Json done = done_of(folder / job.id);
    const SweptValues values = swept_values(values_json(job));
    if (!done.is_null() && has_seeds(values)) results.push_back({values, job_figures(done)});
  }
  return seed_averages(results);
}

/// Of which averages the seeds differ by more than the errors of their runs explain.
std::string scatter_text(const std::vector<SeedAverage>& averages) {
  std::string text;
  for (const SeedAverage& average : averages)
    for (const ShownFigure& shown : shown_figures)
      if (const AveragedFigure figure = average.find(shown.key);
          shown.is_averaged && figure.is_excessive)
        text += fmt::format(
            "{}: the seeds of {} differ {:.1f} times as much as the errors of their runs explain\n",
            average.name(), shown.title, figure.scatter);
  return text;
}

std::string seed_rows(const std::vector<SeedAverage>& averages) {
  std::vector<Row> rows = {{"mean over seeds ± 95 %", "seeds"}};
  for (const ShownFigure& shown : shown_figures)
    if (shown.is_averaged) rows[0].emplace_back(shown.title);
  for (const SeedAverage& average : averages) {
    Row& row = rows.emplace_back(Row{average.name(), fmt::format("{}", average.seeds)});
    for (const ShownFigure& shown : shown_figures)
      if (shown.is_averaged) {
        const AveragedFigure figure = average.find(shown.key);
        row.push_back(with_error(figure.mean, figure.half_width));
      }
  }
  return text_table(rows, 1) + scatter_text(averages);
}

Json seeds_json(const std::vector<SeedAverage>& averages) {
  Json rows = Json::array();
  for (const SeedAverage& average : averages) {
    Json figures = Json::object();
    for (const AveragedFigure& figure : average.figures)
      figures[figure.name] = {
          {"mean", figure.mean},
          {"error", figure.error},
          {"scatter", figure.scatter},
          {"excessive_scatter", figure.is_excessive},
          {"interval", {figure.mean - figure.half_width, figure.mean + figure.half_width}}};
    Json values = Json::object();
    for (const auto& [key, text] : average.values) values[key] = parse_json(text, key);
    rows.push_back(
        {{"values", std::move(values)}, {"seeds", average.seeds}, {"figures", std::move(figures)}});
  }
  return rows;
}

Json job_json(const SweepJob& job, const fs::path& folder) {
  const JobStage stage = job_stage(folder);
  Json row = done_of(folder);
  if (row.is_null()) row = {{"id", job.id}, {"values", values_json(job)}};
  row["stage"] = name_of(stage);
  if (stage == JobStage::failed || stage == JobStage::stopped) row["end"] = job_end(folder);
  return row;
}

/// "seed-1 was begun", or of many jobs their number.
std::string begun_text(const std::vector<std::string>& ids) {
  constexpr std::size_t max_named = 3;
  return ids.size() > max_named
             ? fmt::format("{} jobs were begun", ids.size())
             : fmt::format("{} {} begun", fmt::join(ids, ", "), ids.size() == 1 ? "was" : "were");
}

/// Folders of jobs that are none of these.
std::vector<std::string> strangers(const std::vector<SweepJob>& jobs, const fs::path& folder) {
  std::set<std::string> ids;
  if (!fs::exists(folder)) return {};
  for (const auto& entry : fs::directory_iterator(folder))
    if (fs::exists(entry.path() / "params.json")) ids.insert(entry.path().filename().string());
  for (const SweepJob& job : jobs) ids.erase(job.id);
  return {ids.begin(), ids.end()};
}

}  // namespace

std::string sweep_table(const std::vector<SweepJob>& jobs, const fs::path& folder) {
  std::string text = job_rows(jobs, folder);
  for (const SweepJob& job : jobs)
    if (job_stage(folder / job.id) == JobStage::failed)
      text += fmt::format("{}: {}\n", job.id, job_end_text(job_end(folder / job.id)));
  const std::vector<SeedAverage> averages = averages_of(jobs, folder);
  return averages.empty() ? text : text + "\n" + seed_rows(averages);
}

Json sweep_summary(const std::vector<SweepJob>& jobs, const fs::path& folder) {
  Json rows = Json::array();
  for (const SweepJob& job : jobs) rows.push_back(job_json(job, folder / job.id));
  Json summary = {{"jobs", std::move(rows)}};
  if (has_seeds(swept_values(values_json(jobs.front()))))
    summary["seeds"] = seeds_json(averages_of(jobs, folder));
  return summary;
}

std::vector<std::string> sweep_changes(const std::vector<SweepJob>& jobs, const fs::path& folder) {
  std::map<std::string, std::vector<std::string>> changed;
  for (const SweepJob& job : jobs)
    if (const auto change = change_since_begun(job, folder / job.id))
      changed[fmt::format("{} was {} and is {} now", change->key, change->first, change->second)]
          .push_back(job.id);
  std::vector<std::string> sentences;
  for (const auto& [what, ids] : changed)
    sentences.push_back(
        fmt::format("the parameters have changed since {}: {}", begun_text(ids), what));
  if (const auto ids = strangers(jobs, folder); !ids.empty())
    sentences.push_back(
        fmt::format("no longer among the jobs of the parameter file: {}", fmt::join(ids, ", ")));
  return sentences;
}

}  // namespace vitrel

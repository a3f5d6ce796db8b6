#include "workflow/sweep/sweep_status.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/io/number_text.h"
#include "workflow/prepare/preparation_plan.h"
#include "workflow/run/run_cost.h"
#include "workflow/sweep/job_folder.h"
#include "workflow/sweep/seed_averages.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

using Row = std::vector<std::string>;

/// The text of a cell without a value.
constexpr const char* missing_cell = "–";

/// The width in characters, not bytes.
std::size_t width_of(const std::string& utf8) {
  return static_cast<std::size_t>(
      std::ranges::count_if(utf8, [](char c) { return (c & 0xC0) != 0x80; }));
}

/// Prints rows of cells, with the titles in the first row, as aligned columns. Columns without any value are left
/// out. The first `texts` columns are flush left, the others flush right.
std::string text_table(const std::vector<Row>& rows, std::size_t texts) {
  std::vector<std::string> text(rows.size());
  for (std::size_t k = 0; k < rows[0].size(); ++k) {
    const auto is_missing = [k](const auto& row) { return row[k] == missing_cell; };
    if (rows.size() > 1 && std::all_of(rows.begin() + 1, rows.end(), is_missing)) continue;
    std::size_t width = 0;
    for (const auto& row : rows) width = std::max(width, width_of(row[k]));
    for (std::size_t n = 0; n < rows.size(); ++n)
      text[n] += k < texts ? fmt::format("{:<{}}  ", rows[n][k], width)
                           : fmt::format("{:>{}}  ", rows[n][k], width);
  }
  std::string all;
  for (std::string& line : text) all += line.erase(line.find_last_not_of(' ') + 1) + '\n';
  return all;
}

/// A number of the summaries that has a column in the table.
struct ShownFigure {
  const char* title;
  const char* key;
  const char* format;
  bool is_averaged;  ///< whether there is also an average over seeds
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

/// The summaries of the job; null unless it is done.
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

/// Reports the averages whose seeds differ by more than the errors of their runs explain.
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

/// Names the jobs that were begun: "seed-1 was begun", or gives their number if there are many.
std::string begun_text(const std::vector<std::string>& ids) {
  constexpr std::size_t max_named = 3;
  return ids.size() > max_named
             ? fmt::format("{} jobs were begun", ids.size())
             : fmt::format("{} {} begun", fmt::join(ids, ", "), ids.size() == 1 ? "was" : "were");
}

/// The names of jobs that have a folder but are not among these.
std::vector<std::string> strangers(const std::vector<SweepJob>& jobs, const fs::path& folder) {
  std::set<std::string> ids;
  if (!fs::exists(folder)) return {};
  for (const auto& entry : fs::directory_iterator(folder))
    if (fs::exists(entry.path() / "params.json")) ids.insert(entry.path().filename().string());
  for (const SweepJob& job : jobs) ids.erase(job.id);
  return {ids.begin(), ids.end()};
}

struct JobCost {
  StageCost preparation;
  RunCost run;  ///< zero for a job that only prepares a state

  double seconds() const { return preparation.seconds + run.seconds; }
};

/// `start` is the packing fraction of the state from which the job starts, or 0.
template <int Dim>
JobCost cost_of(const SweepJob& job, double start) {
  const Configuration<Dim> some = representative_particles<Dim>(job.parameters);
  JobCost cost;
  for (const StageCost& stage : stage_costs(job.parameters, some, start))
    cost.preparation.add(stage);
  if (!job.prepares_only) cost.run = run_cost(job.parameters, some);
  return cost;
}

/// The packing fraction from which the job starts. A state on file is assumed to be as dense as the job requires.
double start_of(const SweepJob& job, const std::map<std::string, double>& density_of) {
  if (!start_state(job.parameters.stages)) return 0;
  const auto before = density_of.find(job.predecessor);
  return before == density_of.end() ? job.parameters.system.packing_fraction : before->second;
}

/// The cell is empty for a job without a run.
std::string number_of_run(double number) {
  return number > 0 ? fmt::format("{:.2g}", number) : missing_cell;
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

std::string sweep_plan(const std::vector<SweepJob>& jobs, const fs::path& folder, int parallel) {
  std::vector<Row> rows = {{"job", "stage", "prepare / s", "run / s", "events", "MB on disk"}};
  std::map<std::string, double> density_of;
  double left = 0, disk = 0;
  bool is_foreseen = true;
  for (const SweepJob& job : jobs) {
    density_of[job.id] = job.parameters.system.packing_fraction;
    const double start = start_of(job, density_of);
    const JobCost cost =
        job.parameters.system.dimension == 2 ? cost_of<2>(job, start) : cost_of<3>(job, start);
    const JobStage stage = job_stage(folder / job.id);
    if (stage != JobStage::done) {
      left += cost.seconds();
      disk += cost.run.disk_bytes;
      is_foreseen = is_foreseen && cost.preparation.is_foreseen;
    }
    rows.push_back({job.id, name_of(stage),
                    (cost.preparation.is_foreseen ? "" : "> ") +
                        fmt::format("{:.2g}", cost.preparation.seconds),
                    number_of_run(cost.run.seconds), number_of_run(cost.run.events),
                    number_of_run(cost.run.disk_bytes / 1e6)});
  }
  const int at_a_time = std::max(parallel, 1);
  return text_table(rows, 2) + fmt::format(
                                   "{} jobs; what is left is expected to take {}{:.2g} s with {} "
                                   "job{} at a time, and {:.3g} MB on disk\n",
                                   jobs.size(), is_foreseen ? "" : "more than ", left / at_a_time,
                                   at_a_time, at_a_time == 1 ? "" : "s", disk / 1e6);
}

}  // namespace vitrel

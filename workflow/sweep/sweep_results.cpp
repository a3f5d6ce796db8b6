#include "workflow/sweep/sweep_results.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <tuple>

#include "core/error.h"
#include "core/io/h5md.h"
#include "core/io/json.h"
#include "core/io/text_file.h"
#include "core/special_values.h"
#include "workflow/analyze/glass_report.h"
#include "workflow/analyze/glass_tables.h"
#include "workflow/sweep/job_folder.h"
#include "workflow/sweep/seed_averages.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const AnalysedRun& run) {
  return run.file.parent_path();
}

/// Adds the value in the row of another table, unknown if it has none.
void add_value(Column& column, const Table& row) {
  const Column* value = row.find(column.name);
  column.value.push_back(value ? value->value.front() : unknown);
  if (!column.error.empty())
    column.error.push_back(value && !value->error.empty() ? value->error.front() : unknown);
}

/// The summaries below each other; columns that a run does not have are unknown there.
Table runs_table(const std::vector<AnalysedRun>& runs) {
  Table table{"runs", "Averages over every run of the sweep, one run per row.", {}};
  Column jobs{"job", "1", {}, {}}, seeds{"seed", "1", {}, {}};
  for (const AnalysedRun& run : runs) {
    const Table& row = *run.results.find("summary");
    jobs.value.push_back(static_cast<double>(jobs.labels.size()));
    jobs.labels.push_back(run.name());
    seeds.value.push_back(static_cast<double>(run.seed()));
    if (table.columns.empty())
      table.columns = row.columns;
    else
      for (Column& column : table.columns) add_value(column, row);
  }
  table.columns.insert(table.columns.begin(), {std::move(jobs), std::move(seeds)});
  return table;
}

/// The unit of a number of the analysis.
std::string unit_of(const std::string& name, const Results& results) {
  for (const char* table : {"summary", "relaxation"})
    if (const Table* found = results.find(table))
      if (const Column* column = found->find(name)) return column->unit;
  return "1";
}

/// NaN for other texts.
double number(const std::string& json) {
  const Json value = parse_json(json, "value");
  return value.is_number() ? value.get<double>() : unknown;
}

/// Of a value of the sweep: numbers, or texts as the labels of codes.
Column value_column(const std::vector<SeedAverage>& averages, std::size_t k) {
  Column column{identifier(averages.front().values[k].first), "1", {}, {}};
  const bool is_number = std::ranges::none_of(averages, [k](const SeedAverage& average) {
    return std::isnan(number(average.values[k].second));
  });
  for (const SeedAverage& average : averages) {
    const std::string& text = average.values[k].second;
    column.value.push_back(is_number ? number(text) : static_cast<double>(column.labels.size()));
    if (!is_number) column.labels.push_back(text);
  }
  return column;
}

/// Means with their errors, and half the width of their intervals.
void add_figure(const std::vector<SeedAverage>& averages, const std::string& name,
                const std::string& unit, Table& table) {
  Column mean{name, unit, {}, {}}, interval{name + "_interval", unit, {}, {}},
      scatter{name + "_scatter", "1", {}, {}};
  for (const SeedAverage& average : averages) {
    const AveragedFigure figure = average.find(name);
    mean.value.push_back(figure.mean);
    mean.error.push_back(figure.error);
    interval.value.push_back(figure.half_width);
    scatter.value.push_back(figure.scatter);
  }
  const bool has_errors =
      std::ranges::any_of(scatter.value, [](double ratio) { return std::isfinite(ratio); });
  table.columns.insert(table.columns.end(), {std::move(mean), std::move(interval)});
  if (has_errors) table.columns.push_back(std::move(scatter));
}

Table seeds_table(const std::vector<SeedAverage>& averages, const Results& units) {
  Table table{
      "seeds",
      "Averages over the runs that differ in their seeds only, a row for every combination "
      "of the other values of the sweep. <name>_error: standard error of the mean; "
      "<name>_interval: half the width of its 95 % confidence interval; <name>_scatter: scatter "
      "of the seeds over the errors of their runs, about 1 if these explain it.",
      {}};
  const SeedAverage& first = averages.front();
  for (std::size_t k = 0; k < first.values.size(); ++k)
    table.columns.push_back(value_column(averages, k));
  Column seeds{"seeds", "1", {}, {}};
  for (const SeedAverage& average : averages)
    seeds.value.push_back(static_cast<double>(average.seeds));
  table.columns.push_back(std::move(seeds));
  for (const AveragedFigure& figure : first.figures)
    add_figure(averages, figure.name, unit_of(figure.name, units), table);
  return table;
}

/// The values of its job; empty for a run that belongs to no sweep.
SweptValues values_of(const AnalysedRun& run) {
  const fs::path file = folder_of(run) / "params.json";
  SweptValues values;
  if (fs::exists(file))
    read_json_as("the values of a job", file,
                 [&](const Json& job) { values = swept_values(job.at("values")); });
  return values;
}

void add_seeds(const std::vector<AnalysedRun>& runs, Results& results) {
  std::vector<JobResult> jobs;
  for (const AnalysedRun& run : runs)
    if (SweptValues values = values_of(run); has_seeds(values))
      jobs.push_back({std::move(values), job_figures({{"analyze", analysis_summary(run)}})});
  if (jobs.empty()) return;
  const std::vector<SeedAverage> averages = seed_averages(jobs);
  results.tables.push_back(seeds_table(averages, runs.front().results));
}

struct Quantity {
  const char* name;
  const char* unit;
};
/// What the summary of a preparation may say of the state.
constexpr Quantity of_preparation[] = {
    {"packing_fraction", "1"},  {"particles", "1"},     {"reduced_pressure", "1"},
    {"orientation_ratio", "1"}, {"nematic_order", "1"}, {"collisions", "1"},
    {"contact_number", "1"},    {"rattlers", "1"},      {"smallest_gap", "length"},
    {"overlaps", "1"},          {"wall_seconds", "s"}};
/// What that of a run may say beyond its analysis. No times: tables of runs are reproducible.
constexpr Quantity of_run[] = {{"overlaps", "1"},
                               {"early_releases_per_collision", "1"},
                               {"blocked_rotations_per_collision", "1"}};

/// Adds to the summary of the analysis what it does not have or does not know.
void add_figures(const Json& job, std::span<const Quantity> quantities, Results& results) {
  auto summary = std::find_if(results.tables.begin(), results.tables.end(),
                              [](const Table& table) { return table.name == "summary"; });
  if (summary == results.tables.end())
    summary = results.tables.insert(summary, {"summary", "The prepared state.", {}});
  for (const auto& [name, unit] : quantities) {
    if (!job.contains(name)) continue;
    const double value = job[name].is_number() ? job[name].get<double>() : unknown;
    const auto known = std::ranges::find(summary->columns, name, &Column::name);
    if (known == summary->columns.end())
      summary->columns.push_back({name, unit, {value}, {}});
    else if (std::isnan(known->value.front()))
      known->value.front() = value;
  }
}

AnalysedRun analysed_job(const fs::path& job, const AnalysisChoice& choice,
                         const AnalysisProgress& progress) {
  const Json done = job_done(job);
  AnalysedRun run{job_product(job), {}};
  if (!done.contains("analyze"))
    run.results.provenance = provenance_rows(TrajectoryReader(run.file).provenance());
  else if (choice.given())
    run = analyze_run(run.file, choice, progress);
  else
    run = stored_analysis(run.file, job / "results.h5");
  if (done.contains("analyze") && !run.results.find("summary"))
    throw FileError((job / "results.h5").string() +
                    ": has no table 'summary'; delete it and repeat the sweep");
  if (done.contains("run"))
    add_figures(done["run"], of_run, run.results);
  else
    add_figures(done.at("prepare"), of_preparation, run.results);
  return run;
}

/// Densities are prepared to a goal, and miss it by rounding errors.
std::tuple<double, std::uint64_t, fs::path> place(const AnalysedRun& run) {
  return {std::round(run.packing_fraction() * 1e6), run.seed(), folder_of(run)};
}

/// What may differ between runs to which one law is fitted.
bool is_free(const std::string& key) {
  return key == "system.packing_fraction" || key == "system.seed" || key == "dynamics.duration" ||
         key == "dynamics.equilibration" || key.starts_with("prepare.") ||
         key.starts_with("output.");
}

/// The other keys that do differ between the jobs, with commas.
std::string differing_keys(const std::vector<AnalysedRun>& runs) {
  std::map<std::string, std::set<std::string>> values;
  for (const AnalysedRun& run : runs)
    for (const auto& [key, value] : values_of(run))
      if (!is_free(key)) values[key].insert(value);
  std::vector<std::string> keys;
  for (const auto& [key, different] : values)
    if (different.size() > 1) keys.push_back(key);
  return fmt::format("{}", fmt::join(keys, ", "));
}

}  // namespace

std::vector<AnalysedRun> analysed_jobs(const SweepProgress& sweep, const AnalysisChoice& choice,
                                       const AnalysisProgress& progress) {
  std::vector<AnalysedRun> runs;
  AnalysisProgress of_job = progress;
  if (progress.begin)
    of_job.begin = [&](const std::string& phase) {
      progress.begin(
          fmt::format("job {} of {}: {}", runs.size() + 1, sweep.finished.size(), phase));
    };
  for (const fs::path& job : sweep.finished) runs.push_back(analysed_job(job, choice, of_job));
  std::sort(runs.begin(), runs.end(), [](const AnalysedRun& left, const AnalysedRun& right) {
    return place(left) < place(right);
  });
  return runs;
}

GlassStudy glass_study(const std::vector<AnalysedRun>& runs) {
  std::vector<GlassRun> judged;
  std::size_t others = 0;
  for (const AnalysedRun& run : runs) {
    if (run.glass) judged.push_back(*run.glass);
    others += !run.results.text("not_judged").empty();
  }
  const std::string mixed = judged.empty() ? "" : differing_keys(runs);
  GlassStudy study = study_glass(std::move(judged), mixed);
  if (others > 0)
    study.remarks.push_back(fmt::format(
        "{} of {} runs cannot be judged, as their samples are not evenly spaced in time "
        "([output] samples)",
        others, runs.size()));
  return study;
}

Results results_of_sweep(const std::vector<AnalysedRun>& runs, const GlassStudy& study) {
  Results results;
  results.tables.push_back(runs_table(runs));
  for (const AnalysedRun& run : runs)
    results.provenance.emplace_back(fmt::format("row_{}", results.provenance.size()),
                                    run.file.string());
  add_seeds(runs, results);
  if (!study.runs.empty())
    for (Table& table : glass_tables(study)) results.tables.push_back(std::move(table));
  for (auto& note : glass_notes(study)) results.provenance.push_back(std::move(note));
  return results;
}

}  // namespace vitrel

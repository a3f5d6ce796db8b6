#include "workflow/sweep/sweep_results.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <span>
#include <tuple>

#include "core/error.h"
#include "core/io/h5md.h"
#include "core/io/json.h"
#include "core/special_values.h"
#include "workflow/analyze/glass_report.h"
#include "workflow/analyze/glass_tables.h"
#include "workflow/sweep/job_folder.h"
#include "workflow/sweep/published_tables.h"
#include "workflow/sweep/seed_averages.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const AnalysedRun& run) {
  return run.file.parent_path();
}

/// Adds a row to the table from the first row of `row`; cells are unknown where `row` lacks the column.
void add_row(Table& table, const Table& row, std::size_t rows) {
  for (const Column& column : row.columns)
    if (!table.find(column.name))
      table.columns.push_back({column.name, column.unit, {}, {}, column.labels});
  for (Column& column : table.columns) {
    column.value.resize(rows + 1, unknown);
    if (!column.error.empty()) column.error.resize(rows + 1, unknown);
    const Column* found = row.find(column.name);
    if (!found) continue;
    column.value[rows] = found->value.front();
    if (found->error.empty()) continue;
    column.error.resize(rows + 1, unknown);
    column.error[rows] = found->error.front();
  }
}

Column column_of(const StudyAxis& axis) {
  return {axis.column(), axis.unit, axis.value, {}, axis.labels};
}

/// Columns of the table `relaxation` that the summary of a run may lack.
constexpr const char* of_relaxation[] = {"verdict",         "verdict_translation", "wave_number",
                                         "tau_translation", "tau_rotation",        "nematic_order",
                                         "orientation"};

/// The summary of a run, with verdicts and relaxation times if they are known.
Table row_of(const AnalysedRun& run) {
  Table row = *run.results.find("summary");
  if (const Table* relaxation = run.results.find("relaxation"))
    for (const char* name : of_relaxation)
      if (const Column* column = relaxation->find(name); column && !row.find(name))
        row.columns.push_back(*column);
  return row;
}

Table runs_table(const AnalysedSweep& sweep) {
  Table table{"runs",
              "The jobs of the sweep, one per row: the values of its keys, the averages over every "
              "run, relaxation times and verdicts.",
              {}};
  Column jobs{"job", "1"}, seeds{"seed", "1"};
  std::size_t rows = 0;
  for (const AnalysedRun& run : sweep.runs) {
    jobs.value.push_back(static_cast<double>(jobs.labels.size()));
    jobs.labels.push_back(run.name());
    seeds.value.push_back(static_cast<double>(run.seed()));
    add_row(table, row_of(run), rows++);
  }
  std::vector<Column> first = {std::move(jobs)};
  for (const StudyAxis& key : sweep.keys) first.push_back(column_of(key));
  first.push_back(std::move(seeds));
  table.columns.insert(table.columns.begin(), first.begin(), first.end());
  return table;
}

/// Adds the means with their errors, the half widths of their intervals and, if known, their scatter.
void add_figure(const std::vector<SeedAverage>& averages, const std::string& name,
                const std::string& unit, Table& table) {
  Column mean{name, unit}, interval{name + "_interval", unit}, scatter{name + "_scatter", "1"};
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

/// The numbers of a row, without those that are codes.
Figures figures_of(const Table& row) {
  Figures figures;
  for (const Column& column : row.columns) {
    if (!column.labels.empty()) continue;
    figures.emplace_back(column.name, column.value.front());
    if (!column.error.empty()) figures.emplace_back(column.name + "_error", column.error.front());
  }
  return figures;
}

std::vector<SeedAverage> averages_of(const AnalysedSweep& sweep) {
  std::vector<JobResult> jobs;
  for (std::size_t k = 0; k < sweep.runs.size(); ++k)
    jobs.push_back({sweep.values[k], figures_of(row_of(sweep.runs[k])), sweep.published[k]});
  return seed_averages(jobs);
}

Table seeds_table(const std::vector<SeedAverage>& averages, const Table& runs) {
  std::vector<SweptValues> values;
  for (const SeedAverage& average : averages) values.push_back(average.values);
  Table table{
      "seeds",
      "Averages over the runs that differ in their seeds only, a row for every combination "
      "of the other values of the sweep. <name>_error: standard error of the mean; "
      "<name>_interval: half the width of its 95 % confidence interval; <name>_scatter: scatter "
      "of the seeds over the errors of their runs, about 1 if these explain it.",
      {}};
  for (const StudyAxis& key : study_keys(values)) table.columns.push_back(column_of(key));
  Column seeds{"seeds", "1"};
  for (const SeedAverage& average : averages)
    seeds.value.push_back(static_cast<double>(average.seeds));
  table.columns.push_back(std::move(seeds));
  for (const AveragedFigure& figure : averages.front().figures)
    add_figure(averages, figure.name, runs.find(figure.name)->unit, table);
  return table;
}

struct Quantity {
  const char* name;
  const char* unit;
};
/// The numbers of a state that the summary of a preparation may contain.
constexpr Quantity of_preparation[] = {
    {"packing_fraction", "1"},  {"particles", "1"},     {"reduced_pressure", "1"},
    {"orientation_ratio", "1"}, {"nematic_order", "1"}, {"collisions", "1"},
    {"contact_number", "1"},    {"rattlers", "1"},      {"smallest_gap", "length"},
    {"overlaps", "1"},          {"wall_seconds", "s"}};
/// The numbers that the summary of a run may contain in addition to its analysis.
constexpr Quantity of_run[] = {{"overlaps", "1"},
                               {"correction_moves", "1"},
                               {"early_releases_per_collision", "1"},
                               {"blocked_rotations_per_collision", "1"},
                               {"wall_seconds", "s"},
                               {"collisions_per_second_with_output", "1/s"}};

/// Adds to the summary of the analysis the numbers that it lacks or does not know.
void add_figures(const Json& job, std::span<const Quantity> quantities, Results& results) {
  auto summary = std::ranges::find(results.tables, "summary", &Table::name);
  if (summary == results.tables.end())
    summary = results.tables.insert(summary, {"summary", "The prepared state.", {}});
  for (const auto& [name, unit] : quantities) {
    if (!job.contains(name)) continue;
    const double value = job[name].is_number() ? job[name].get<double>() : unknown;
    const auto known = std::ranges::find(summary->columns, name, &Column::name);
    if (known == summary->columns.end())
      summary->columns.push_back({name, unit, {value}});
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

/// Whether this key may differ between runs to which one law is fitted.
bool is_free(const std::string& key) {
  return key == "system.packing_fraction" || key == "system.seed" ||
         key.starts_with("dynamics.duration") || key == "dynamics.equilibration" ||
         key.starts_with("prepare.") || key.starts_with("output.");
}

/// Adds the names of the columns along which the tables are to be drawn.
void add_axes(const std::vector<StudyAxis>& axes, Results& results) {
  if (axes.empty()) return;
  std::vector<std::string> series;
  for (const StudyAxis& axis : std::span(axes).first(axes.size() - 1))
    series.push_back(axis.column());
  results.provenance.emplace_back("axis", axes.back().column());
  results.provenance.emplace_back("series", fmt::format("{}", fmt::join(series, ",")));
}

/// The other keys whose values differ between the jobs, separated by commas.
std::string differing_keys(const AnalysedSweep& sweep) {
  std::vector<std::string> keys;
  for (const StudyAxis& key : sweep.keys)
    if (!is_free(key.key) && key.distinct_values() > 1) keys.push_back(key.key);
  std::ranges::sort(keys);
  return fmt::format("{}", fmt::join(keys, ", "));
}

/// The place of a job in the order of rows. Packing fractions are rounded, because preparations miss their target by
/// rounding errors.
using Place = std::tuple<std::vector<double>, double, std::uint64_t, fs::path>;
Place place_of(const AnalysedSweep& sweep, std::size_t job) {
  const AnalysedRun& run = sweep.runs[job];
  std::vector<double> on_axes;
  for (const StudyAxis& axis : sweep.axes) on_axes.push_back(axis.value[job]);
  return {std::move(on_axes), sweep.axes.empty() ? std::round(run.packing_fraction() * 1e6) : 0,
          run.seed(), folder_of(run)};
}

/// Keeps the entries with these indices, in this order.
template <class T>
void pick(const std::vector<std::size_t>& numbers, std::vector<T>& entries) {
  std::vector<T> picked;
  for (const std::size_t k : numbers) picked.push_back(std::move(entries[k]));
  entries = std::move(picked);
}

void sort_jobs(AnalysedSweep& sweep) {
  std::vector<std::size_t> order(sweep.runs.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](std::size_t job) { return place_of(sweep, job); });
  pick(order, sweep.runs);
  pick(order, sweep.values);
  pick(order, sweep.published);
  for (std::vector<StudyAxis>* axes : {&sweep.keys, &sweep.axes})
    for (StudyAxis& axis : *axes) pick(order, axis.value);
}

bool runs_through_seeds(const AnalysedSweep& sweep) {
  return std::ranges::all_of(sweep.values, [](const auto& values) { return has_seeds(values); });
}

}  // namespace

std::string AnalysedSweep::label(std::size_t job) const {
  std::vector<std::string> parts;
  if (!axes.empty())
    parts.push_back(axes_text(axes, job));
  else
    parts.push_back(fmt::format("φ = {:.6g}", runs[job].packing_fraction()));
  const auto has_same_axes = [&](std::size_t other) {
    return std::ranges::all_of(
        axes, [&](const StudyAxis& axis) { return axis.value[other] == axis.value[job]; });
  };
  std::size_t same = 0;
  for (std::size_t other = 0; other < runs.size(); ++other) same += has_same_axes(other);
  if (same > 1) parts.push_back(fmt::format("seed {}", runs[job].seed()));
  return fmt::format("{}", fmt::join(parts, ", "));
}

AnalysedSweep analysed_sweep(const SweepProgress& progress_of_sweep, const AnalysisChoice& choice,
                             const AnalysisProgress& progress) {
  AnalysedSweep sweep;
  AnalysisProgress of_job = progress;
  if (progress.begin)
    of_job.begin = [&](const std::string& phase) {
      progress.begin(fmt::format("job {} of {}: {}", sweep.runs.size() + 1,
                                 progress_of_sweep.finished.size(), phase));
    };
  StudyLayout layout;
  for (const fs::path& folder : progress_of_sweep.finished) {
    sweep.runs.push_back(analysed_job(folder, choice, of_job));
    JobPlace place = job_place(folder);
    sweep.values.push_back(std::move(place.values));
    sweep.published.push_back(std::move(place.published));
    layout = std::move(place.layout);
  }
  sweep.keys = study_keys(sweep.values);
  sweep.axes = study_axes(sweep.keys, layout);
  sort_jobs(sweep);
  return sweep;
}

GlassStudy glass_study(const AnalysedSweep& sweep) {
  std::vector<GlassRun> judged;
  std::size_t others = 0;
  for (const AnalysedRun& run : sweep.runs) {
    if (run.glass) judged.push_back(*run.glass);
    others += !run.results.text("not_judged").empty();
  }
  const std::string mixed = judged.empty() ? "" : differing_keys(sweep);
  GlassStudy study = study_glass(std::move(judged), mixed);
  if (others > 0)
    study.remarks.push_back(fmt::format(
        "{} of {} runs cannot be judged, as their samples are not evenly spaced in time "
        "([output] samples)",
        others, sweep.runs.size()));
  return study;
}

Results results_of_sweep(const AnalysedSweep& sweep, const GlassStudy& study) {
  Results results;
  results.tables.push_back(runs_table(sweep));
  for (const AnalysedRun& run : sweep.runs)
    results.provenance.emplace_back(fmt::format("row_{}", results.provenance.size()),
                                    run.file.string());
  const std::vector<SeedAverage> averages = averages_of(sweep);
  if (runs_through_seeds(sweep))
    results.tables.push_back(seeds_table(averages, results.tables.front()));
  for (Table& table : published_tables(averages, sweep.axes))
    results.tables.push_back(std::move(table));
  if (!study.runs.empty())
    for (Table& table : glass_tables(study)) results.tables.push_back(std::move(table));
  for (auto& note : glass_notes(study)) results.provenance.push_back(std::move(note));
  add_axes(sweep.axes, results);
  return results;
}

}  // namespace vitrel

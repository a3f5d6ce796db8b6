#include "workflow/sweep/sweep_results.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "core/error.h"
#include "core/io/json.h"
#include "workflow/analyze/glass_report.h"
#include "workflow/analyze/glass_tables.h"
#include "workflow/storage/text_file.h"

namespace vitrel {
namespace {

/// The summaries below each other; columns that a run does not have are unknown there.
Table runs_table(const std::vector<AnalysedRun>& runs) {
  Table table{"runs", "Averages over every run of the sweep, one run per row.", {}};
  for (const AnalysedRun& run : runs) {
    const Table& row = *run.results.find("summary");
    if (table.columns.empty()) {
      table.columns = row.columns;
      continue;
    }
    for (Column& column : table.columns) {
      const Column* value = row.find(column.name);
      constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
      column.value.push_back(value ? value->value.front() : unknown);
      if (!column.error.empty())
        column.error.push_back(value && !value->error.empty() ? value->error.front() : unknown);
    }
  }
  return table;
}

/// Densities are prepared to a goal, and miss it by rounding errors.
std::tuple<double, std::uint64_t, std::string> place(const AnalysedRun& run) {
  return {std::round(run.packing_fraction() * 1e6), run.seed(), run.name()};
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
  for (const AnalysedRun& run : runs) {
    const std::filesystem::path file = run.file.parent_path() / "params.json";
    if (!std::filesystem::exists(file)) continue;
    const Json job = read_json(file);
    for (const auto& [key, value] : job.at("values").items())
      if (!is_free(key)) values[key].insert(json_text(value));
  }
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
  for (const std::filesystem::path& job : sweep.finished) {
    runs.push_back(choice.given() ? analyze_run(job / "run.h5", choice, of_job)
                                  : AnalysedRun{job / "run.h5", read_results(job / "results.h5")});
    if (!runs.back().results.find("summary"))
      throw FileError((job / "results.h5").string() +
                      ": has no table 'summary'; delete it and repeat the sweep");
  }
  std::sort(runs.begin(), runs.end(), [](const AnalysedRun& left, const AnalysedRun& right) {
    return place(left) < place(right);
  });
  return runs;
}

GlassStudy glass_study(const std::vector<AnalysedRun>& runs) {
  std::vector<GlassRun> judged;
  for (const AnalysedRun& run : runs)
    if (const auto glass = stored_glass_run(run.name(), run.results)) judged.push_back(*glass);
  const std::size_t others = runs.size() - judged.size();
  GlassStudy study = study_glass(std::move(judged), differing_keys(runs));
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
  if (!study.runs.empty())
    for (Table& table : glass_tables(study)) results.tables.push_back(std::move(table));
  for (auto& note : glass_notes(study)) results.provenance.push_back(std::move(note));
  return results;
}

}  // namespace vitrel

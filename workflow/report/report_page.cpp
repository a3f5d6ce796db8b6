#include "workflow/report/report_page.h"
#include "core/io/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "workflow/report/assets.h"
#include "workflow/report/glass_rows.h"
#include "workflow/report/page_parts.h"
#include "workflow/report/page_tables.h"
#include "workflow/report/runs_rows.h"

namespace vitrel {

namespace {

constexpr std::size_t max_bytes = 2'000'000;
constexpr double min_rows_per_decade = 5;

Json run_data(const ReportRun& run, const std::vector<Observable>& observables,
              const Thinning& thinning) {
  return {{"label", run.label},
          {"name", run.name},
          {"dynamics", run.dynamics},
          {"evenlySampled", !run.results.text("time_axis").starts_with("unevenly")},
          {"tables", tables_data(run.results, observables, thinning)},
          {"movie", movie_data(run.movie)}};
}

/// The table of all jobs; null unless the page is about a sweep.
const Table* jobs_of(const ReportData& data) {
  return data.runs.size() > 1 ? data.study.find("runs") : nullptr;
}

std::vector<ReportAxis> axes_of(const ReportData& data) {
  if (!data.axes.empty()) return data.axes;
  return {{"packing_fraction", "φ", "packing fraction"}};
}

Json study_data(const ReportData& data) {
  Json study = tables_data(data.study, {});
  const Table* averages = data.study.find("seeds");
  if (const Table* jobs = jobs_of(data)) study["jobs"] = table_data(averages ? *averages : *jobs);
  for (const ReportAxis& axis : axes_of(data))
    study["axes"].push_back({{"column", axis.column}, {"symbol", axis.symbol}});
  return study;
}

/// The labels by the names of runs; empty if runs differ in their packing fraction only.
std::map<std::string, std::string> labels_of(const ReportData& data) {
  std::map<std::string, std::string> labels;
  if (data.axes.size() > 1)
    for (const ReportRun& run : data.runs) labels[run.name] = run.label;
  return labels;
}

/// The heading and the rows of the table of runs.
std::pair<std::string, std::string> table_of_runs(const ReportData& data, const PageUnits& units) {
  const Table* summary = data.runs.empty() ? nullptr : data.runs.front().results.find("summary");
  const Table* jobs = jobs_of(data);
  if (!jobs && !summary) return {};
  RunsTable table{jobs ? *jobs : *summary, {}, {}, {}};
  for (const ReportAxis& axis : axes_of(data)) {
    table.keys.push_back(axis.column);
    table.symbols.push_back(axis.symbol);
  }
  for (const ReportRun& run : data.runs) table.names.push_back(run.name);
  return {runs_heading(table, units), runs_rows(table)};
}

std::string text_of(const PageProvenance& provenance, std::size_t k) {
  return k < provenance.size() ? provenance[k].second : "";
}

/// Whether the k-th text is the same for all runs.
bool is_shared(const std::vector<ReportRun>& runs, std::size_t k) {
  return std::ranges::all_of(runs, [&](const ReportRun& run) {
    return text_of(run.provenance, k) == text_of(runs.front().provenance, k);
  });
}

/// The provenance that all runs share, followed by that of the page.
PageProvenance shared_provenance(const ReportData& data) {
  PageProvenance shared;
  if (!data.runs.empty())
    for (std::size_t k = 0; k < data.runs.front().provenance.size(); ++k)
      if (is_shared(data.runs, k)) shared.push_back(data.runs.front().provenance[k]);
  shared.insert(shared.end(), data.provenance.begin(), data.provenance.end());
  return shared;
}

/// A table of the provenance that runs do not share; empty if they share everything.
std::string job_provenance(const std::vector<ReportRun>& runs) {
  std::string head, rows;
  std::vector<std::size_t> columns;
  for (std::size_t k = 0; !runs.empty() && k < runs.front().provenance.size(); ++k) {
    if (is_shared(runs, k)) continue;
    columns.push_back(k);
    head += "<th scope=\"col\">" + escaped(runs.front().provenance[k].first) + "</th>";
  }
  if (columns.empty()) return "";
  for (const ReportRun& run : runs) {
    rows += "<tr><th scope=\"row\">" + escaped(run.name) + "</th>";
    for (const std::size_t k : columns) rows += table_cell(escaped(text_of(run.provenance, k)));
    rows += "</tr>\n";
  }
  return filled(asset("page/job_provenance.html"), {{"head", head}, {"rows", rows}});
}

/// The section about the cooling of a single run; empty if the page has several runs, or if the run does not cool.
std::string cooling_section(const std::vector<ReportRun>& runs, int dimension) {
  if (runs.size() != 1 || !runs.front().cooling) return "";
  const Cooling& cooling = *runs.front().cooling;
  return cooling_section(cooling, haff_law(cooling, runs.front().results, dimension), dimension);
}

/// The section with the verdict on a single run and its relaxation times; empty if the page has several runs.
std::string result_section(const ReportData& data, int dimension) {
  if (data.runs.size() != 1) return "";
  const std::string rows = result_rows(data.runs.front().results, dimension, data.units);
  return rows.empty() ? "" : filled(asset("page/result.html"), {{"rows", rows}});
}

int dimension_of(const ReportData& data) {
  const bool in_space =
      !data.runs.empty() && std::holds_alternative<Movie3>(data.runs.front().movie);
  return in_space ? 3 : 2;
}

std::string page_with(const ReportData& data, const Thinning& thinning) {
  const int dimension = dimension_of(data);
  const std::vector<Observable> tables = observables(dimension);
  std::vector<Observable> drawn = tables;
  if (data.runs.size() > 1) drawn.push_back(jobs_observable());
  Json runs = Json::array();
  for (const ReportRun& run : data.runs) {
    Json& entry = runs.emplace_back(run_data(run, tables, thinning));
    if (run.cooling)
      entry["cooling"] = cooling_data(haff_law(*run.cooling, run.results, dimension));
  }
  const auto [heading, rows] = table_of_runs(data, page_units(dimension, data.units));
  return whole_page(
      {data.title,
       data.subtitle,
       "page/runs_sections.html",
       "page/report.js",
       {{"cooling", cooling_section(data.runs, dimension)},
        {"result", result_section(data, dimension)},
        {"table_heading", heading},
        {"table_rows", rows},
        {"abscissa", escaped(axes_of(data).back().name)},
        {"job_provenance", job_provenance(data.runs)},
        {"relaxation_rows", relaxation_rows(data.study, labels_of(data))},
        {"fit_rows", fit_rows(data.study)},
        {"study_notes", study_notes(data.study)}},
       script_safe(Json{
           {"runs", std::move(runs)}, {"charts", charts_data(drawn)}, {"study", study_data(data)}}),
       data.parameters,
       shared_provenance(data),
       dimension,
       data.units});
}

}  // namespace

std::string report_page(const ReportData& data) {
  Thinning thinning;
  std::string page = page_with(data, thinning);
  while (page.size() > max_bytes && thinning.rows_per_decade > min_rows_per_decade) {
    thinning.rows_per_decade *= 0.75;
    thinning.max_rows = thinning.max_rows * 3 / 4;
    page = page_with(data, thinning);
  }
  return page;
}

}  // namespace vitrel

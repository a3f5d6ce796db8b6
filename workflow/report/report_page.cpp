#include "workflow/report/report_page.h"
#include "core/io/json.h"
#include "core/io/number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "workflow/report/assets.h"
#include "workflow/report/glass_rows.h"
#include "workflow/report/page_parts.h"
#include "workflow/report/page_tables.h"

namespace vitrel {

namespace {

constexpr std::size_t max_bytes = 2'000'000;
constexpr double min_rows_per_decade = 5;

/// What comes after the beginning that all these names share, cut behind an underscore.
std::string distinction(const std::string& name, const std::vector<std::string>& names) {
  std::size_t shared = name.size();
  for (const std::string& other : names) {
    const auto apart = std::mismatch(name.begin(), name.end(), other.begin(), other.end());
    if (other != name)
      shared = std::min(shared, static_cast<std::size_t>(apart.first - name.begin()));
  }
  const std::size_t underscore = name.substr(0, shared).rfind('_');
  return underscore == std::string::npos ? name : name.substr(underscore + 1);
}

/// "φ = 0.5", with the name of the run where another one has the same density.
std::string label(const ReportRun& run, const std::vector<ReportRun>& runs) {
  std::vector<std::string> equals;
  for (const ReportRun& other : runs)
    if (density_text(other.packing_fraction) == density_text(run.packing_fraction))
      equals.push_back(other.name);
  return "φ = " + density_text(run.packing_fraction) +
         (equals.size() > 1 ? " (" + distinction(run.name, equals) + ")" : "");
}

Json run_data(const ReportRun& run, const ReportData& data,
              const std::vector<Observable>& observables, const Thinning& thinning) {
  return {{"label", label(run, data.runs)},
          {"name", run.name},
          {"dynamics", run.dynamics},
          {"packingFraction", page_number(run.packing_fraction)},
          {"collisionsPerSecond", page_number(run.collisions_per_second)},
          {"evenlySampled", !run.results.text("time_axis").starts_with("unevenly")},
          {"tables", tables_data(run.results, observables, thinning)},
          {"movie", movie_data(run.movie)}};
}

std::string cell(const std::string& text) {
  return "<td>" + text + "</td>";
}

std::string count_cell(double count) {
  return cell(std::isfinite(count) ? grouped(static_cast<std::uint64_t>(count)) : "–");
}

std::string table_row(const ReportRun& run) {
  const auto text = [&](const char* column) {
    return cell(table_text(run.results, "summary", column));
  };
  const auto value = [&](const char* column) {
    return table_value(run.results, "summary", column);
  };
  const double duration = value("duration");
  return "<tr><th scope=\"row\">" + density_text(run.packing_fraction) + "</th>" +
         text("compressibility_factor") + text("diffusion") + text("rotational_diffusion") +
         text("translational_energy") +
         (value("rotations") == 0 ? cell("–") : text("rotational_energy")) +
         count_cell(value("collisions")) + count_cell(run.collisions_per_second) +
         cell(std::isfinite(duration) ? fmt::format("{:.6g}", duration) : "–") +
         count_cell(value("particles")) + cell(escaped(run.name)) + "</tr>\n";
}

std::string text_of(const PageProvenance& provenance, std::size_t k) {
  return k < provenance.size() ? provenance[k].second : "";
}

/// Whether the k-th text is the same for all runs.
bool is_shared(const std::vector<ReportRun>& runs, std::size_t k) {
  return std::all_of(runs.begin(), runs.end(), [&](const ReportRun& run) {
    return text_of(run.provenance, k) == text_of(runs.front().provenance, k);
  });
}

/// What the runs share, then what is said of the page.
PageProvenance shared_provenance(const ReportData& data) {
  PageProvenance shared;
  if (!data.runs.empty())
    for (std::size_t k = 0; k < data.runs.front().provenance.size(); ++k)
      if (is_shared(data.runs, k)) shared.push_back(data.runs.front().provenance[k]);
  shared.insert(shared.end(), data.provenance.begin(), data.provenance.end());
  return shared;
}

/// A table of what the runs do not share; empty if there is nothing.
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
    for (const std::size_t k : columns) rows += cell(escaped(text_of(run.provenance, k)));
    rows += "</tr>\n";
  }
  return filled(asset("page/job_provenance.html"), {{"head", head}, {"rows", rows}});
}

/// Of a single run that cools.
std::string cooling_section(const std::vector<ReportRun>& runs, int dimension) {
  if (runs.size() != 1 || !runs.front().cooling) return "";
  const Cooling& cooling = *runs.front().cooling;
  return cooling_section(cooling, haff_law(cooling, runs.front().results, dimension), dimension);
}

/// The verdict on a single run, and its relaxation times.
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
  Json runs = Json::array();
  std::string rows;
  for (const ReportRun& run : data.runs) {
    Json& entry = runs.emplace_back(run_data(run, data, tables, thinning));
    if (run.cooling)
      entry["cooling"] = cooling_data(haff_law(*run.cooling, run.results, dimension));
    rows += table_row(run);
  }
  return whole_page({data.title,
                     data.subtitle,
                     "page/runs_sections.html",
                     "page/report.js",
                     {{"cooling", cooling_section(data.runs, dimension)},
                      {"result", result_section(data, dimension)},
                      {"table_rows", rows},
                      {"job_provenance", job_provenance(data.runs)},
                      {"relaxation_rows", relaxation_rows(data.study)},
                      {"fit_rows", fit_rows(data.study)},
                      {"study_notes", study_notes(data.study)}},
                     script_safe(Json{{"runs", std::move(runs)},
                                      {"charts", charts_data(tables)},
                                      {"study", tables_data(data.study, {})}}),
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

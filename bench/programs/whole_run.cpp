#include "bench/programs/whole_run.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/terminal/exit_codes.h"
#include "bench/programs/number_text.h"
#include "bench/surveys/choice.h"
#include "core/io/json.h"

namespace vitrel::bench {

namespace {

/// NaN without collisions.
double corrections_per_thousand(const WholeRun& run) {
  if (run.collisions == 0) return std::numeric_limits<double>::quiet_NaN();
  return 1000 * static_cast<double>(run.correction_moves) / static_cast<double>(run.collisions);
}

std::string corrections_text(const WholeRun& run) {
  const double moves = corrections_per_thousand(run);
  return moves == 0 ? "·" : std::isnan(moves) ? "–" : ratio_text(moves);
}

std::string row_text(const WholeRun& run) {
  return fmt::format("  {:<9.2g} {:>8.4g} {:>11} {:>12} {:>9} {:>11.0f} {:>12} {:>12}\n",
                     run.tolerance, run.simulated_time, count_text(run.collisions),
                     count_text(run.correction_moves), corrections_text(run),
                     run.collisions_per_second, error_text(run.energy_drift),
                     run.deepest_overlap == 0 ? "·" : error_text(run.deepest_overlap));
}

std::string method_heading(const std::string& method) {
  return fmt::format("{}\n  {:<9} {:>8} {:>11} {:>12} {:>9} {:>11} {:>12} {:>12}\n", method,
                     "tolerance", "time", "collisions", "corrections", "per 1000", "coll./s",
                     "energy drift", "overlap (b)");
}

/// The rows as lines, grouped by method; "·" stands for 0. Below, which runs stood still.
std::string whole_run_text(const std::vector<WholeRun>& rows) {
  std::string text, method, remarks;
  for (const WholeRun& run : rows) {
    if (run.method != method) {
      if (!text.empty()) text += '\n';
      text += method_heading(run.method);
    }
    method = run.method;
    text += row_text(run);
    if (run.stood_still)
      remarks += fmt::format("{} with tolerance {:.2g} stood still after {:.4g} units of time.\n",
                             run.method, run.tolerance, run.simulated_time);
  }
  if (!remarks.empty()) text += '\n';
  return text + remarks;
}

}  // namespace

std::vector<WholeRun> measure_whole_runs(const WholeRunOptions& options, Report& report) {
  report.say("whole runs");
  const RunControl& control = report.control();
  const std::vector<Method> methods = chosen(methods_for_whole_runs(), options.methods, "method");
  std::vector<WholeRun> runs;
  for (const Method& method : methods) {
    const auto done = static_cast<double>(runs.size());
    control.report_progress({done / static_cast<double>(methods.size()), done, "runs"});
    const WholeRun run = thesis_scene_with(method, options.duration, options.seed, control);
    if (control.stop_requested()) break;
    runs.push_back(run);
  }
  return runs;
}

Json whole_runs_json(const std::vector<WholeRun>& runs) {
  Json list = Json::array();
  for (const WholeRun& run : runs)
    list.push_back({{"method", run.method},
                    {"tolerance", run.tolerance},
                    {"simulated_time", run.simulated_time},
                    {"collisions", run.collisions},
                    {"correction_moves", run.correction_moves},
                    {"collisions_per_second", run.collisions_per_second},
                    {"energy_drift", run.energy_drift},
                    {"deepest_overlap", run.deepest_overlap},
                    {"stood_still", run.stood_still}});
  return list;
}

int whole_run(const WholeRunOptions& options, const OutputOptions& output) {
  Report report(output);
  const std::vector<WholeRun> runs = measure_whole_runs(options, report);
  const Json rows = whole_runs_json(runs);
  report.print(rows, whole_run_text(runs));
  if (report.control().stop_requested()) return report.stopped_early();
  if (!report.is_wanted()) return success;
  Json data = {{"rows", rows}};
  report.add_provenance(
      data,
      {{"scene", fmt::format("{:g} units of time, seed {}", options.duration, options.seed)}});
  report.write_data("whole-run", data);
  report.write_page("whole-run",
                    {"Complete runs: speed and correction moves",
                     "The scene of the thesis, with different methods to predict its collisions"},
                    {{"whole_runs", rows}, {"provenance", data["provenance"]}});
  return success;
}

}  // namespace vitrel::bench

#include "app/workflow/bench/whole_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/workflow/bench/choice.h"
#include "app/workflow/bench/figures.h"

namespace vitrel {
namespace {

using lab::Method;
using lab::WholeRun;

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

std::string point_note(const WholeRun& run) {
  return fmt::format(
      "{}, tolerance {:.2g}: {:.3g} collisions per second, {} correction moves and "
      "{} collisions in {:.4g} units of time{}",
      run.method, run.tolerance, run.collisions_per_second, run.correction_moves, run.collisions,
      run.simulated_time, run.stood_still ? ", then stood still" : "");
}

/// A power of ten below what a single correction move would be in the longest of the runs.
double chart_floor(const std::vector<WholeRun>& rows) {
  double most = 1;
  for (const WholeRun& run : rows) most = std::max(most, static_cast<double>(run.collisions));
  return std::pow(10, std::ceil(std::log10(1000 / most)) - 1);
}

}  // namespace

WholeRunBench bench_whole_run(const WholeRunRequest& request, const RunControl& control) {
  const std::vector<Method> methods =
      chosen(lab::methods_for_whole_runs(), request.methods, "method");
  WholeRunBench bench;
  for (const Method& method : methods) {
    const auto done = static_cast<double>(bench.rows.size());
    control.report_progress({done / static_cast<double>(methods.size()), done, "runs"});
    const WholeRun run = lab::thesis_scene_with(method, request.duration, request.seed, control);
    bench.stopped = control.stop_requested();
    if (bench.stopped) return bench;
    bench.rows.push_back(run);
  }
  return bench;
}

nlohmann::ordered_json whole_run_json(const std::vector<WholeRun>& rows) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const WholeRun& run : rows)
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

double corrections_per_thousand(const WholeRun& run) {
  if (run.collisions == 0) return std::numeric_limits<double>::quiet_NaN();
  return 1000 * static_cast<double>(run.correction_moves) / static_cast<double>(run.collisions);
}

Chart whole_run_chart(const std::vector<WholeRun>& rows) {
  Chart chart;
  chart.title = "The scene of the thesis: speed against correction moves";
  chart.x = {"collisions per second", true, {}};
  chart.y = {"correction moves per 1000 collisions", true, {}};
  chart.floor = chart_floor(rows);
  chart.floor_label = "none";
  chart.notes = {"one point per tolerance", "hollow: the run stood still"};
  for (const WholeRun& run : rows) {
    if (chart.series.empty() || chart.series.back().name != run.method)
      chart.series.push_back({run.method, {}, true});
    chart.series.back().points.push_back({run.collisions_per_second, corrections_per_thousand(run),
                                          run.stood_still, point_note(run)});
  }
  return chart;
}

}  // namespace vitrel

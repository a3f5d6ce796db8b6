#include "app/workflow/bench/overlap.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/workflow/bench/choice.h"
#include "app/workflow/bench/figures.h"

namespace vitrel {
namespace {

using lab::OverlapRow;

/// What one criterion did on all classes of one aspect ratio.
struct Charted {
  std::string method;
  int vertices;
  double ns_per_call, largest_wrong_gap;
  std::uint64_t wrong, pairs;
};

std::vector<Charted> charted(const std::vector<OverlapRow>& rows) {
  std::vector<Charted> result;
  for (const OverlapRow& row : rows) {
    if (row.aspect_ratio != rows.front().aspect_ratio) continue;
    auto found = std::ranges::find(result, row.method, &Charted::method);
    if (found == result.end())
      found = result.insert(found, {row.method, row.vertices, row.ns_per_call, 0, 0, 0});
    if (row.case_class == "near_contact") found->ns_per_call = row.ns_per_call;
    found->largest_wrong_gap = std::max(found->largest_wrong_gap, row.largest_wrong_gap);
    found->wrong += row.wrong();
    found->pairs += row.pairs;
  }
  return result;
}

std::string note(const Charted& point) {
  return fmt::format("{}: {} per call, largest gap judged wrongly {} b, {} of {} answers wrong",
                     point.method, time_text(point.ns_per_call),
                     error_text(point.largest_wrong_gap), point.wrong, point.pairs);
}

}  // namespace

lab::OverlapSurvey bench_overlap(const OverlapRequest& request, const RunControl& control) {
  return lab::survey_overlap({chosen(lab::overlap_criteria(), request.methods, "method"),
                              chosen(lab::overlap_classes(), request.classes, "class"),
                              request.pairs, request.seconds, request.seed},
                             control);
}

nlohmann::ordered_json overlap_json(const std::vector<OverlapRow>& rows) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const OverlapRow& row : rows)
    list.push_back({{"method", row.method},
                    {"class", row.case_class},
                    {"aspect_ratio", row.aspect_ratio},
                    {"pairs", row.pairs},
                    {"wrong_overlap", row.wrong_overlap},
                    {"wrong_disjoint", row.wrong_disjoint},
                    {"largest_wrong_gap", row.largest_wrong_gap},
                    {"ns_per_call", row.ns_per_call}});
  return list;
}

std::string overlap_text(const std::vector<OverlapRow>& rows) {
  std::string text, group;
  for (const OverlapRow& row : rows) {
    const std::string heading = fmt::format("{}, κ = {:g}", row.case_class, row.aspect_ratio);
    if (heading != group)
      text += fmt::format("{}{}\n  {:<28} {:>9} {:>14} {:>14} {:>18} {:>10}\n",
                          text.empty() ? "" : "\n", heading, "method", "pairs", "wrong overlap",
                          "wrong disjoint", "largest wrong gap", "per call");
    group = heading;
    text += fmt::format("  {:<28} {:>9} {:>14} {:>14} {:>18} {:>10}\n", row.method, row.pairs,
                        count_text(row.wrong_overlap), count_text(row.wrong_disjoint),
                        row.wrong() == 0 ? "·" : error_text(row.largest_wrong_gap),
                        time_text(row.ns_per_call));
  }
  return text;
}

Chart overlap_chart(const std::vector<OverlapRow>& rows) {
  Chart chart;
  chart.title = "Time per overlap test against the largest gap judged wrongly";
  if (!rows.empty()) chart.title += fmt::format(" (κ = {:g})", rows.front().aspect_ratio);
  chart.x = {"time per call", true, ChartAxis::Quantity::nanoseconds};
  chart.y = {"largest gap judged wrongly, in semi-minor axes", true, {}};
  chart.floor = lab::smallest_judged_gap;
  chart.notes = {"filled: no pair wrong", "hollow: some are"};
  ChartSeries polygons{"polygons", {}, true};
  for (const Charted& point : charted(rows)) {
    const ChartPoint drawn{point.ns_per_call, point.largest_wrong_gap, point.wrong > 0,
                           note(point)};
    if (point.vertices > 0)
      polygons.points.push_back(drawn);
    else
      chart.series.push_back({point.method, {drawn}, true});
  }
  if (polygons.points.empty()) return chart;
  chart.series.push_back(polygons);
  chart.notes.insert(chart.notes.end(), {"polygons: 8, 16 … 256 vertices,", "from left to right"});
  return chart;
}

}  // namespace vitrel

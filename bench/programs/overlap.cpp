#include "bench/programs/overlap.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/terminal/exit_codes.h"
#include "bench/programs/number_text.h"
#include "bench/surveys/choice.h"
#include "core/io/json.h"

namespace vitrel::bench {

namespace {

/// The rows as lines, grouped by class; "·" stands for 0.
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

}  // namespace

OverlapSurvey measure_overlap(const OverlapOptions& options, Report& report) {
  report.say("overlap criteria");
  return survey_overlap({chosen(overlap_criteria(), options.methods, "method"),
                         chosen(overlap_classes(), options.classes, "class"), options.pairs,
                         options.seconds, options.seed},
                        report.control());
}

Json overlap_json(const std::vector<OverlapRow>& rows) {
  Json list = Json::array();
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

int overlap(const OverlapOptions& options, const OutputOptions& output) {
  Report report(output);
  const OverlapSurvey survey = measure_overlap(options, report);
  const Json rows = overlap_json(survey.rows);
  report.print(rows, overlap_text(survey.rows));
  if (survey.stopped) return report.stopped_early();
  if (!report.is_wanted()) return success;
  Json data = {{"rows", rows}};
  report.add_provenance(
      data, {{"pairs", fmt::format("{} of each class, seed {}", options.pairs, options.seed)},
             {"time limit", fmt::format("{:g} s for a criterion", options.seconds)}});
  report.write_data("overlap", data);
  report.write_page(
      "overlap",
      {"Overlap tests: speed and accuracy", "All criteria on the same pairs of ellipses"},
      {{"overlap", rows}, {"provenance", data["provenance"]}});
  return success;
}

}  // namespace vitrel::bench

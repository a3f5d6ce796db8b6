#include "bench/programs/collision_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "app/terminal/exit_codes.h"
#include "bench/methods/ellipsoids/methods.h"
#include "bench/programs/number_text.h"
#include "bench/programs/overlap.h"
#include "bench/programs/whole_run.h"
#include "bench/surveys/choice.h"
#include "bench/surveys/ellipsoid_suite.h"
#include "bench/surveys/failing_case.h"
#include "bench/surveys/passing_pair.h"
#include "bench/surveys/recorded_class.h"
#include "bench/surveys/survey.h"
#include "bench/surveys/thesis_scene.h"
#include "core/io/json.h"

namespace vitrel::bench {
namespace {

/// In the chart of all tolerances a coarse answer counts as correct if it is off by no more than this.
constexpr double charted_tolerance = 1e-2;

/// What there is to choose from.
template <int Dim>
struct Supply {
  std::vector<MethodOf<Dim>> methods;  ///< the default first
  std::vector<MethodOf<Dim>> methods_by_tolerance;
  std::vector<CaseClassOf<Dim>> classes;
};

/// The default method answers all pairs, the others what their time allows.
template <int Dim>
std::vector<CandidateOf<Dim>> candidates(const Supply<Dim>& supply,
                                         const CollisionTimeOptions& options) {
  const std::string default_method = supply.methods.front().name;
  std::vector<CandidateOf<Dim>> result;
  for (const MethodOf<Dim>& method : chosen(supply.methods, options.methods, "method")) {
    CandidateOf<Dim> candidate{method};
    if (method.name != default_method) candidate.seconds = options.seconds;
    result.push_back(candidate);
  }
  return result;
}

/// Every method at every tolerance; those of one method share its time.
template <int Dim>
std::vector<CandidateOf<Dim>> candidates_by_tolerance(const Supply<Dim>& supply,
                                                      const CollisionTimeOptions& options) {
  const std::vector<MethodOf<Dim>> methods =
      chosen(supply.methods_by_tolerance, options.methods, "method");
  std::map<std::string, int> tolerances;
  for (const MethodOf<Dim>& method : methods) ++tolerances[method.name];
  std::vector<CandidateOf<Dim>> result;
  for (const MethodOf<Dim>& method : methods)
    result.push_back({method, options.seconds / tolerances[method.name]});
  return result;
}

/// Random pairs of the smallest aspect ratio.
template <int Dim>
std::vector<CaseClassOf<Dim>> charted_classes(const Supply<Dim>& supply) {
  std::vector<CaseClassOf<Dim>> classes;
  for (const char* const name : {"generic", "tumbling"})
    if (const auto first = std::ranges::find(supply.classes, name, &CaseClassOf<Dim>::name);
        first != supply.classes.end())
      classes.push_back(*first);
  return classes;
}

// 98 columns.
std::string line(const auto&... cells) {
  return fmt::format("  {:<20} {:>3} {:>7} {:>5} {:>5} {:>6} {:>5} {:>6} {:>6} {:>8} {:>7} {:>7}\n",
                     cells...);
}

std::string row_text(const SurveyRow& row) {
  return line(row.case_class, row.aspect_ratio, row.pairs, count_text(row.early),
              count_text(row.late), count_text(row.missed), count_text(row.false_contacts),
              count_text(row.not_converged), count_text(row.degenerate), time_text(row.ns_per_call),
              error_text(row.largest_error), error_text(row.largest_gap_error));
}

std::string method_heading(const SurveyRow& row) {
  return fmt::format("{} (tolerance {:.2g})\n", row.method, row.tolerance) +
         line("class", "κ", "pairs", "early", "late", "missed", "false", "no ans", "degen.",
              "per call", "error", "gap");
}

Json rows_json(const std::vector<SurveyRow>& rows) {
  Json list = Json::array();
  for (const SurveyRow& row : rows)
    list.push_back({{"method", row.method},
                    {"tolerance", row.tolerance},
                    {"class", row.case_class},
                    {"aspect_ratio", row.aspect_ratio},
                    {"pairs", row.pairs},
                    {"contacts", row.contacts},
                    {"correct", row.correct},
                    {"early", row.early},
                    {"late", row.late},
                    {"missed", row.missed},
                    {"false", row.false_contacts},
                    {"not_converged", row.not_converged},
                    {"degenerate", row.degenerate},
                    {"ns_per_call", row.ns_per_call},
                    {"largest_error", row.largest_error},
                    {"median_error", row.median_error},
                    {"largest_gap_error", row.largest_gap_error},
                    {"largest_moot_gap", row.largest_moot_gap}});
  return list;
}

/// Grouped by method; "·" stands for 0.
std::string rows_text(const std::vector<SurveyRow>& rows) {
  std::vector<std::string> methods;
  for (const SurveyRow& row : rows)
    if (!std::ranges::count(methods, row.method)) methods.push_back(row.method);
  std::string text;
  for (const std::string& method : methods) {
    const auto first = std::ranges::find(rows, method, &SurveyRow::method);
    if (!text.empty()) text += '\n';
    text += method_heading(*first);
    for (const SurveyRow& row : rows)
      if (row.method == method) text += row_text(row);
  }
  return text;
}

template <int Dim>
struct Measured {
  SurveyOf<Dim> survey;               ///< every method at its usual tolerance
  std::vector<SurveyRow> tolerances;  ///< every tolerance, on the charted classes
};

/// The tolerances only if there is to be a page.
template <int Dim>
Measured<Dim> measure(const Supply<Dim>& supply, const CollisionTimeOptions& options,
                      Report& report) {
  SurveyRequestOf<Dim> request{candidates(supply, options),
                               chosen(supply.classes, options.classes, "class"), options.pairs,
                               options.seed, options.allowed};
  Measured<Dim> measured;
  report.say(fmt::format("stability of {} methods on {} classes", request.candidates.size(),
                         request.classes.size()));
  measured.survey = survey(request, report.control());
  if (report.is_wanted() && !measured.survey.stopped) {
    request.candidates = candidates_by_tolerance(supply, options);
    request.classes = charted_classes(supply);
    request.tolerance = {charted_tolerance, charted_tolerance};
    report.say(fmt::format("accuracy of {} methods and tolerances", request.candidates.size()));
    measured.tolerances = survey(request, report.control()).rows;
  }
  report.print(rows_json(measured.survey.rows), rows_text(measured.survey.rows));
  return measured;
}

template <int Dim>
Json classes_json(const std::vector<CaseClassOf<Dim>>& classes) {
  Json list = Json::array();
  for (const CaseClassOf<Dim>& of : classes)
    list.push_back(
        {{"class", of.name}, {"aspect_ratio", of.aspect_ratio}, {"meaning", of.meaning}});
  return list;
}

template <int Dim>
Json data_of(const Measured<Dim>& measured, const Supply<Dim>& supply) {
  return {{"rows", rows_json(measured.survey.rows)},
          {"classes", classes_json(supply.classes)},
          {"tolerances", rows_json(measured.tolerances)},
          {"tolerances_judged_by", charted_tolerance}};
}

PageProvenance described(const CollisionTimeOptions& options) {
  return {
      {"pairs", fmt::format("{} of each class, seed {}", options.pairs, options.seed)},
      {"time limit", fmt::format("{:g} s for a method that is not the default", options.seconds)}};
}

Json failures_json(const std::vector<FailingCase>& failures) {
  Json list = Json::array();
  for (const FailingCase& failure : failures) list.push_back(failing_case_json(failure));
  return list;
}

}  // namespace

int collision_time(const CollisionTimeOptions& options, const OutputOptions& output) {
  const Supply<2> supply{collision_time_methods(), collision_time_methods_by_tolerance(),
                         all_classes()};
  Report report(output);
  const Measured<2> measured = measure(supply, options, report);
  if (report.control().stop_requested()) return report.stopped_early();
  if (!report.is_wanted()) return success;
  OverlapOptions criteria;
  criteria.seed = options.seed;
  const OverlapSurvey overlap = measure_overlap(criteria, report);
  WholeRunOptions scene;
  scene.duration = options.duration;
  scene.seed = options.seed;
  const std::vector<WholeRun> runs = measure_whole_runs(scene, report);
  if (report.control().stop_requested()) return report.stopped_early();
  Json data = data_of(measured, supply);
  data["scene"] = thesis_scene_answers_json();
  data["failures"] = failures_json(measured.survey.failures);
  data["overlap"] = overlap_json(overlap.rows);
  data["whole_runs"] = whole_runs_json(runs);
  PageProvenance what = described(options);
  what.push_back({"whole runs", fmt::format("{:g} units of time", options.duration)});
  report.add_provenance(data, what);
  report.write_data("collision-time", data);
  report.write_page(
      "collision-time",
      {"Collision time: speed, accuracy, stability",
       "All methods on the same pairs, compared with a guaranteed reference in 80-bit arithmetic"},
      data);
  return success;
}

int collision_time_of_ellipsoids(const CollisionTimeOptions& options, const OutputOptions& output) {
  const Supply<3> supply{ellipsoid_methods(), ellipsoid_methods_by_tolerance(), ellipsoid_suite()};
  Report report(output);
  const Measured<3> measured = measure(supply, options, report);
  if (report.control().stop_requested()) return report.stopped_early();
  if (!report.is_wanted()) return success;
  Json data = data_of(measured, supply);
  data["passing_pair"] = passing_pair_json();
  report.add_provenance(data, described(options));
  report.write_data("collision-time", data);
  report.write_page(
      "collision-time",
      {"Collision time of ellipsoids: speed, accuracy, stability",
       "All methods on the same pairs, compared with a reference in 80-bit arithmetic"},
      data);
  return success;
}

}  // namespace vitrel::bench

// Which method finds the time of the first contact, how accurately, and at what cost?

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "bench/studies/choice.h"
#include "bench/studies/study.h"
#include "bench/surveys/failing_case.h"
#include "bench/surveys/recorded_class.h"
#include "bench/surveys/survey.h"
#include "bench/surveys/verdict.h"

namespace vitrel::bench {
namespace {

/// If the tolerance is varied, a coarse answer counts as correct with errors up to this value.
constexpr double coarse_tolerance = 1e-2;

/// Classes of random pairs with the smallest aspect ratio.
template <int Dim>
std::vector<CaseClassOf<Dim>> random_classes() {
  std::vector<CaseClassOf<Dim>> result;
  const auto all = all_classes<Dim>();
  for (const char* const name : {"generic", "tumbling"})
    if (const auto first = std::ranges::find(all, name, &CaseClassOf<Dim>::name);
        first != all.end())
      result.push_back(*first);
  return result;
}

Json rows_json(const std::vector<SurveyRow>& rows) {
  Json list = Json::array();
  for (const SurveyRow& row : rows) {
    list.push_back({{"method", row.method},
                    {"tolerance", row.tolerance},
                    {"class", row.case_class},
                    {"aspect_ratio", row.aspect_ratio},
                    {"pairs", row.pairs},
                    {"contacts", row.contacts},
                    {"degenerate", row.degenerate},
                    {"ns_per_call", row.ns_per_call},
                    {"largest_error", row.largest_error},
                    {"median_error", row.median_error},
                    {"largest_gap_error", row.largest_gap_error},
                    {"largest_moot_gap", row.largest_moot_gap}});
    for (std::size_t k = 0; k < verdict_names.size(); ++k)
      list.back()[verdict_names[k]] = row.verdicts[k];
  }
  return list;
}

/// Measures every method at its usual tolerance. The default method answers all pairs, the others as many as their
/// time allows.
template <int Dim>
Json measure(const StudyContext& context) {
  const StudyOptions& options = context.options;
  const double usual = Dim == 2 ? 1e-8 : 1e-12;
  AllowedError allowed{usual, 1e-8};
  if (options.tolerance > 0) allowed = {options.tolerance, options.tolerance};
  if (options.gap_tolerance > 0) allowed.gap = options.gap_tolerance;
  SurveyRequestOf<Dim> request{
      {}, selected(all_classes<Dim>(), options.classes), options.pairs, options.seed, allowed};
  const std::string default_method = collision_time_methods<Dim>().front().name;
  for (const MethodOf<Dim>& method : selected(collision_time_methods<Dim>(), options.methods)) {
    request.candidates.push_back({method});
    if (method.name != default_method) request.candidates.back().seconds = options.seconds;
  }
  const SurveyOf<Dim> found = survey(request, context.control);
  if constexpr (Dim == 2)
    for (const FailingCase& failure : found.failures)
      context.more["failures"].push_back(failing_case_json(failure));
  return rows_json(found.rows);
}

/// Measures every method at every tolerance. All tolerances of a method share its time.
template <int Dim>
Json measure_tolerances(const StudyContext& context) {
  const StudyOptions& options = context.options;
  const auto all = selected(collision_time_methods_by_tolerance<Dim>(), options.methods);
  std::map<std::string, int> tolerances;
  for (const MethodOf<Dim>& method : all) ++tolerances[method.name];
  SurveyRequestOf<Dim> request{
      {}, random_classes<Dim>(), options.pairs, options.seed, {coarse_tolerance, coarse_tolerance}};
  for (const MethodOf<Dim>& method : all)
    request.candidates.push_back({method, options.seconds / tolerances[method.name]});
  return rows_json(survey(request, context.control).rows);
}

/// The answers of the reference and of these methods for one pair, without methods that are not made for it.
template <int Dim>
Json answers(const CollisionCaseOf<Dim>& asked, const std::vector<MethodOf<Dim>>& all) {
  const auto truth = static_cast<double>(truth_of(asked).time);
  Json rows = Json::array({{{"method", "reference"}, {"time", truth}}});
  for (const MethodOf<Dim>& method : all) {
    const Prediction<Dim> found = method.predict(asked);
    if (found.outcome == Outcome::not_converged) continue;
    rows.push_back(
        {{"method", method.name}, {"tolerance", method.tolerance}, {"steps", found.steps}});
    if (found.outcome == Outcome::contact)
      rows.back().update({{"time", found.time}, {"error", std::abs(found.time - truth)}});
  }
  return rows;
}

/// The scene of appendix B.1 of the thesis (woetzel2012).
Json measure_thesis_scene(const StudyContext&) {
  const Flight<Ellipse> resting{{1, 0.5}, {{0, 0}, 0}, {{0, 0}, 0}};
  const Flight<Ellipse> coming{{1, 0.5}, {{1, 1}, 0}, {{-1, 0}, std::numbers::pi}};
  return answers<2>({of_constant_size(resting), of_constant_size(coming), 2},
                    collision_time_methods<2>());
}

Json measure_passing_pair(const StudyContext&) {
  constexpr double depth = 3e-5;
  return answers<3>(passing_pair(depth), collision_time_methods_by_tolerance<3>());
}

const std::vector<Column> pair_classes = {{"class"}, {"aspect_ratio", "κ"}};
const Column time_per_call = {"ns_per_call", "time per call", Shown::time};
const Column largest_error = {"largest_error", "largest error", Shown::error, "horizon"};
const std::vector<Column> verdicts = {
    {"early"}, {"late"}, {"missed"}, {"false"}, {"not_converged", "no answer"}};

template <int Dim>
Part failures(const std::string& name, const std::string& about) {
  return {.name = name,
          .about = about,
          .measure = measure<Dim>,
          .cases = pair_classes,
          .cost = time_per_call,
          .verdicts = verdicts,
          .others = {{"degenerate", "", Shown::count},
                     largest_error,
                     {"median_error", "median error", Shown::error},
                     {"largest_gap_error", "largest gap error", Shown::error}},
          .method_names = names_of(collision_time_methods<Dim>()),
          .class_names = names_of(all_classes<Dim>())};
}

template <int Dim>
Part tolerances(const std::string& name) {
  return {.name = name,
          .about =
              "Random pairs, a point for each tolerance. Errors refer to pairs whose contact "
              "exists and is found; below 10⁻¹⁷ they are drawn there. Hollow: some answers are "
              "missing, false, or off by more than 1 %.",
          .measure = measure_tolerances<Dim>,
          .cases = pair_classes,
          .cost = time_per_call,
          .error = largest_error,
          .verdicts = verdicts,
          .others = {{"median_error", "median error", Shown::error}},
          .varied = "tolerance",
          .method_names = names_of(collision_time_methods<Dim>()),
          .smallest_error = 1e-17};
}

Part one_pair(const std::string& name, const std::string& about,
              Json (*measure)(const StudyContext&)) {
  return {.name = name,
          .about = about,
          .measure = measure,
          .cases = {},
          .others = {{"tolerance"},
                     {"time", "contact at", Shown::all_digits},
                     {"error", "off by", Shown::error},
                     {"steps"}}};
}

}  // namespace

Study contact_time_study() {
  const std::string meaning =
      "Early, late: the time is off by more than the tolerance. Missed: there is a contact, but "
      "none is reported. False: a contact is reported, but the true gap at that time exceeds the "
      "tolerance. Errors are fractions of the horizon, and those of gaps are in shortest "
      "semi-axes; they exclude degenerate pairs, whose surfaces cross so slowly that a gap of the "
      "order of rounding corresponds to a long time.";
  return {
      .name = "contact-time",
      .aliases = {{"collision-time"},
                  {"collision-time-of-ellipsoids", {"space", "space_tolerances", "passing_pair"}},
                  {"collision-time-of-solids", {"space", "space_tolerances", "passing_pair"}}},
      .question =
          "Which method finds the time of the first contact, how accurately, and at what cost?",
      .parts = {failures<2>("plane",
                            "Pairs of ellipses, compared with a reference in 80-bit arithmetic. " +
                                meaning),
                tolerances<2>("plane_tolerances"),
                one_pair("thesis_scene",
                         "Two ellipses with a = 1, b = 0.5. One is at rest at the origin; the "
                         "other starts at (1, 1) with velocity (−1, 0) and angular velocity π. "
                         "They touch, overlap, and touch again from inside the overlap at t = 1, "
                         "a trap for methods that accept any root.",
                         measure_thesis_scene),
                failures<3>(
                    "space",
                    "Pairs of ellipsoids, compared with a reference in 80-bit arithmetic. " +
                        meaning),
                tolerances<3>("space_tolerances"),
                one_pair("passing_pair",
                         "Two ellipsoids that overlap for a moment as they pass. The two roots "
                         "are so close that a scan for a change of sign steps over both.",
                         measure_passing_pair)},
      .defaults = {.pairs = 2000, .seconds = 4},
      .has_tolerance = true,
      .has_quick = false};
}

}  // namespace vitrel::bench

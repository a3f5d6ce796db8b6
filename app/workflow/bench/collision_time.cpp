#include "app/workflow/bench/collision_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "app/workflow/bench/choice.h"
#include "app/workflow/bench/figures.h"
#include "bench/lab/recorded_class.h"
#include "bench/lab/solids/methods.h"
#include "bench/lab/solids/suite.h"

namespace vitrel {
namespace {

using lab::CaseClassOf;
using lab::EntrantOf;
using lab::MethodOf;
using lab::SurveyRow;

/// What there is to choose from.
template <int Dim>
struct Laboratory {
  std::vector<MethodOf<Dim>> methods;  ///< the default first
  std::vector<MethodOf<Dim>> methods_by_tolerance;
  std::vector<CaseClassOf<Dim>> classes;
};

/// The default method answers all pairs, the others what their time allows.
template <int Dim>
std::vector<EntrantOf<Dim>> entrants(const Laboratory<Dim>& lab,
                                     const CollisionTimeRequest& request) {
  const std::string default_method = lab.methods.front().name;
  std::vector<EntrantOf<Dim>> result;
  for (const MethodOf<Dim>& method : chosen(lab.methods, request.methods, "method")) {
    EntrantOf<Dim> entrant{method};
    if (method.name != default_method) entrant.seconds = request.seconds;
    result.push_back(entrant);
  }
  return result;
}

/// Every method at every tolerance; those of one method share its time.
template <int Dim>
std::vector<EntrantOf<Dim>> entrants_by_tolerance(const Laboratory<Dim>& lab,
                                                  const CollisionTimeRequest& request) {
  const std::vector<MethodOf<Dim>> methods =
      chosen(lab.methods_by_tolerance, request.methods, "method");
  std::map<std::string, int> tolerances;
  for (const MethodOf<Dim>& method : methods) ++tolerances[method.name];
  std::vector<EntrantOf<Dim>> result;
  for (const MethodOf<Dim>& method : methods)
    result.push_back({method, request.seconds / tolerances[method.name]});
  return result;
}

template <int Dim>
std::vector<CaseClassOf<Dim>> generic_class(const Laboratory<Dim>& lab) {
  std::vector<CaseClassOf<Dim>> classes = chosen(lab.classes, {"generic"}, "class");
  classes.resize(1);
  return classes;
}

template <int Dim>
CollisionTimeBenchOf<Dim> bench_in(const Laboratory<Dim>& lab, const CollisionTimeRequest& request,
                                   const RunControl& control, const Say& say) {
  lab::SurveyRequestOf<Dim> asked{entrants(lab, request),
                                  chosen(lab.classes, request.classes, "class"), request.pairs,
                                  request.seed, request.tolerance};
  CollisionTimeBenchOf<Dim> bench;
  say(fmt::format("stability of {} methods on {} classes", asked.entrants.size(),
                  asked.classes.size()));
  bench.survey = lab::survey(asked, control);
  if (request.with_chart && !bench.survey.stopped) {
    asked.entrants = entrants_by_tolerance(lab, request);
    asked.classes = generic_class(lab);
    asked.tolerance = {charted_tolerance, charted_tolerance};
    say(fmt::format("accuracy of {} methods and tolerances", asked.entrants.size()));
    bench.tolerances = lab::survey(asked, control).rows;
  }
  bench.stopped = control.stop_requested();
  return bench;
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

double charted(const SurveyRow& row, ChartedError error) {
  return error == ChartedError::median ? row.median_error : row.largest_error;
}

}  // namespace

CollisionTimeBench bench_collision_time(const CollisionTimeRequest& request,
                                        const RunControl& control, const Say& say) {
  const Laboratory<2> lab{lab::collision_time_methods(), lab::collision_time_methods_by_tolerance(),
                          lab::all_classes()};
  return bench_in(lab, request, control, say);
}

CollisionTimeBenchOf<3> bench_collision_time_of_solids(const CollisionTimeRequest& request,
                                                       const RunControl& control, const Say& say) {
  const Laboratory<3> lab{lab::solid_methods(), lab::solid_methods_by_tolerance(),
                          lab::solid_suite()};
  return bench_in(lab, request, control, say);
}

nlohmann::ordered_json collision_time_json(const std::vector<SurveyRow>& rows) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
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

std::string collision_time_text(const std::vector<SurveyRow>& rows) {
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

Chart speed_chart(const std::vector<SurveyRow>& rows, ChartedError error) {
  Chart chart;
  const std::string which = error == ChartedError::median ? "median" : "largest";
  const std::string aspect_ratio =
      rows.empty() ? "" : fmt::format(" (random pairs, κ = {:g})", rows.front().aspect_ratio);
  chart.title = "Time per prediction against its " + which + " error" + aspect_ratio;
  chart.x = {"time per call", true, ChartAxis::Quantity::nanoseconds};
  chart.y = {which + " error of the time, as a fraction of the horizon", true, {}};
  chart.floor = 1e-17;
  chart.notes = {"one point per tolerance", "hollow: some answers missing,",
                 "false, or off by more than 1 %"};
  for (const SurveyRow& row : rows) {
    if (!row.applies()) continue;
    if (chart.series.empty() || chart.series.back().name != row.method)
      chart.series.push_back({row.method, {}, true});
    chart.series.back().points.push_back(
        {row.ns_per_call, charted(row, error), row.wrong() > 0,
         fmt::format("{}, tolerance {:.2g}: {} per call, {} error {}, {} of {} missing, false or "
                     "off by more than 1 %",
                     row.method, row.tolerance, time_text(row.ns_per_call), which,
                     error_text(charted(row, error)), row.wrong(), row.pairs)});
  }
  return chart;
}

}  // namespace vitrel

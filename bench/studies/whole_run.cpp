// Which contact-time method can carry a whole run?

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "bench/baselines/method_engine.h"
#include "bench/studies/choice.h"
#include "bench/studies/study.h"
#include "bench/surveys/thesis_run.h"
#include "edmd/brownian.h"

namespace vitrel::bench {
namespace {

/// The methods that can carry a run, each at a series of tolerances.
std::vector<Method> able_methods() {
  std::vector<Method> methods = collision_time_methods_by_tolerance();
  constexpr std::array able{"separating_axis", "slsqp", "slsqp_checked", "psi_root",
                            "perram_wertheim_root"};
  std::erase_if(methods,
                [&](const Method& method) { return !std::ranges::count(able, method.name); });
  return methods;
}

Json row_of(const Method& method, const StudyContext& context) {
  EngineOptions correcting;
  correcting.on_overlap = OnOverlap::correct;
  Configuration2 start = on_lattice({});
  set_initial_velocities(start, context.options.seed, InitialVelocities::maxwell,
                         Temperature::total);
  const ThesisRun run = run_thesis(make_method_engine(method, correcting), start,
                                   {context.options.duration}, context.control);
  const auto collisions = static_cast<double>(run.counters.collisions),
             moves = static_cast<double>(run.counters.correction_moves);
  Json row = run_json(run);
  row.update({{"method", method.name}, {"tolerance", method.tolerance}});
  if (collisions > 0)
    row.update({{"ns_per_collision", 1e9 * run.seconds / collisions},
                {"corrections_per_1000", 1000 * moves / collisions}});
  return row;
}

Json measure(const StudyContext& context) {
  const std::vector<Method> methods = selected(able_methods(), context.options.methods);
  Json rows = Json::array();
  for (const Method& method : methods) {
    const auto done = static_cast<double>(rows.size());
    context.control.report_progress({done / static_cast<double>(methods.size()), done, "runs"});
    const Json row = row_of(method, context);
    if (context.control.stop_requested()) break;
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

Study whole_run_study() {
  return {
      .name = "whole-run",
      .aliases = {},
      .question = "Which contact time carries a whole run?",
      .parts = {{.name = "thesis",
                 .about =
                     "The scene of the thesis (100 ellipses of κ = 2 at φ = 0.5, from a square "
                     "lattice), a run for each method and tolerance. A missed contact leads to an "
                     "overlap, which the correction move of the thesis removes. Stood still: "
                     "collisions repeat endlessly at one time. False collisions and correction "
                     "moves conserve energy, too. Overlaps are measured at the samples.",
                 .measure = measure,
                 .cases = {},
                 .cost = {"ns_per_collision", "time per collision", Shown::time},
                 .error = {"corrections_per_1000", "correction moves per 1000 collisions",
                           Shown::number},
                 .others = {{"simulated_time", "time"},
                            {"collisions", "", Shown::count},
                            {"correction_moves", "correction moves", Shown::count},
                            {"energy_drift", "energy drift", Shown::error},
                            {"deepest_overlap", "deepest overlap", Shown::error, "b"},
                            {"stood_still", "stood still"}},
                 .varied = "tolerance",
                 .method_names = names_of(able_methods()),
                 .smallest_error = 1e-3}},
      .defaults = {.duration = 100},
      .has_quick = false};
}

}  // namespace vitrel::bench

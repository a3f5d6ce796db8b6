// What do runs of the thesis (woetzel2012) cost with its program and with this one, and what is wrong with them?

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/studies/study.h"
#include "bench/surveys/thesis_run.h"
#include "edmd/brownian.h"

namespace vitrel::bench {
namespace {

constexpr double brownian_step = 0.1;
constexpr double warm_up = 20;
constexpr double usual_aspect_ratio = 2;
constexpr int largest_size = 400;

const char* dynamics_name(double tau) {
  return tau > 0 ? "Brownian" : "Newtonian";
}

/// Small systems run longer, so that all systems do a similar amount of work. A run of the program of the thesis ends
/// after a number of seconds.
Json row_of(const StudyContext& context, Program program, const ThesisScene& scene, double tau,
            const Configuration2& start) {
  RunLimits limits{context.options.duration, 1e9, tau, context.options.seed};
  if (program == Program::ours)
    limits.duration *= std::max(1.0, static_cast<double>(largest_size) / scene.particles);
  else
    limits.seconds = context.options.seconds;
  const ThesisRun run = run_thesis(make_program(program, start), start, limits, context.control);
  const auto per_time = [&](std::uint64_t count) {
    return static_cast<double>(count) / run.simulated_time;
  };
  Json row = run_json(run);
  row.update({{"method", name_of(program)},
              {"shape", scene.aspect_ratio == 1 ? "circles" : "ellipses"},
              {"aspect_ratio", scene.aspect_ratio},
              {"dynamics", dynamics_name(tau)},
              {"particles", scene.particles},
              {"ns_per_time", 1e9 * run.seconds / run.simulated_time},
              {"collisions_per_time", per_time(run.counters.collisions)},
              {"corrections_per_time", per_time(run.counters.correction_moves)}});
  return row;
}

/// Measures figures 4.1 to 4.4 of the thesis.
Json measure_sizes(const StudyContext& context) {
  const int largest = context.options.quick ? 25 : largest_size;
  Json rows = Json::array();
  for (const int side : {4, 5, 6, 7, 8, 9, 10, 12, 14, 16, 18, 20}) {
    if (side * side > largest) break;
    for (const double kappa : {usual_aspect_ratio, 1.0}) {
      const ThesisScene scene{side * side, kappa, 0.5, context.options.seed};
      const Configuration2 start = equilibrated(scene, warm_up);
      for (const Program program : {Program::ours, Program::thesis, Program::improved})
        for (const double tau : {0.0, brownian_step}) {
          if (context.control.stop_requested()) return rows;
          rows.push_back(row_of(context, program, scene, tau, start));
        }
    }
  }
  return rows;
}

const std::vector<Column> run_columns = {
    {"collisions_per_time", "collisions per time"},
    {"corrections_per_time", "correction moves per time", Shown::count},
    {"energy_drift", "energy drift", Shown::error},
    {"samples_with_overlap", "samples with overlap", Shown::count},
    {"deepest_overlap", "deepest overlap", Shown::error, "b"},
    {"stood_still", "stood still"}};
const Column time_per_time = {"ns_per_time", "time per unit of simulated time", Shown::time};

}  // namespace

Study thesis_study() {
  return {.name = "thesis",
          .aliases = {},
          .question =
              "What do runs of the thesis cost with its program and with this one, and what is "
              "wrong with them?",
          .parts = {{.name = "sizes",
                     .about = "Figures 4.1 to 4.4: φ = 0.5, kT = m = a b = 1, from equilibrium. "
                              "`thesis` has no calendar, lists or cells: after every event it "
                              "predicts the next collision of every pair, of ellipses by SLSQP, "
                              "and separates overlapping pairs by a correction move. `improved` "
                              "keeps a table of the pairs' next events and rejects solutions that "
                              "violate a constraint.",
                     .measure = measure_sizes,
                     .cases = {{"shape"}, {"dynamics"}},
                     .cost = time_per_time,
                     .others = run_columns,
                     .varied = "particles"}},
          .defaults = {.seconds = 1, .duration = 100}};
}

}  // namespace vitrel::bench

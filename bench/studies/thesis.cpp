// What do the figures of chapter 4 of the thesis (woetzel2012) show with its program, and with this one?

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>

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

/// Small systems run longer, so that all have as much to do; a run of the program of the thesis ends after some
/// seconds.
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

/// Figures 4.1 to 4.4.
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

/// Figure 4.3 at equal area.
Json measure_aspect_ratios(const StudyContext& context) {
  Json rows = Json::array();
  for (const double kappa : {1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0}) {
    const ThesisScene scene{100, kappa, 0.5, context.options.seed};
    const Configuration2 start = equilibrated(scene, 5 * warm_up);
    for (const double tau : {0.0, brownian_step}) {
      if (context.control.stop_requested()) return rows;
      rows.push_back(row_of(context, Program::ours, scene, tau, start));
    }
  }
  return rows;
}

/// Figure 4.6.
Json measure_energies(const StudyContext& context) {
  const ThesisScene scene{100, usual_aspect_ratio, 0.5, context.options.seed};
  Json rows = Json::array();
  const auto note = [&](const Configuration2& now) {
    const Mechanics sums = mechanics(now);
    const auto add = [&](const char* kind, double energy) {
      rows.push_back({{"method", kind},
                      {"time", now.time},
                      {"energy", energy / static_cast<double>(now.size())}});
    };
    add("translation", sums.translational_energy);
    add("rotation", sums.rotational_energy);
  };
  const Configuration2 start = equilibrated(scene, warm_up);
  const ThesisRun run = run_thesis(make_program(Program::ours, start), start,
                                   {context.options.duration}, context.control, note);
  if (!rows.empty()) rows.back()["energy_drift"] = run.energy_drift;
  return rows;
}

/// Figure 4.7.
Json measure_relaxation(const StudyContext& context) {
  const int runs = context.options.quick ? 2 : 32;
  constexpr double dense = 0.5, dilute = 0.001, tau = brownian_step;
  Json rows = Json::array();
  for (const auto& [density, share, step, duration] : {std::tuple{dense, 1.0, 0.0, 1.},
                                                       {dense, 0.0, 0.0, 1.},
                                                       {dilute, 1.0, 0.0, 100.},
                                                       {dense, 1.0, tau, 1.},
                                                       {dense, 0.0, tau, 1.},
                                                       {dilute, 1.0, tau, 1.}}) {
    if (context.control.stop_requested()) return rows;
    const Relaxation of = relax(
        {density, share, step, duration * context.options.duration, runs, context.options.seed},
        context.control);
    for (std::size_t k = 0; k < of.times.size(); ++k)
      rows.push_back({{"method", share == 0 ? "from rotation" : "from translation"},
                      {"packing_fraction", density},
                      {"dynamics", dynamics_name(step)},
                      {"time", of.times[k]},
                      {"energy", of.kinetic[k]},
                      {"expected", of.expected},
                      {"standard_error", of.standard_error},
                      {"samples_with_overlap", of.samples_with_overlap}});
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
              "What do the figures of chapter 4 of the thesis show, with its program and with "
              "this one?",
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
                     .varied = "particles"},
                    {.name = "aspect_ratios",
                     .about = "Figure 4.3: collisions of ellipses of equal area.",
                     .measure = measure_aspect_ratios,
                     .cases = {{"dynamics"}},
                     .cost = time_per_time,
                     .others = run_columns,
                     .varied = "aspect_ratio"},
                    {.name = "energies",
                     .about = "Figure 4.6: energies per particle in one Newtonian run.",
                     .measure = measure_energies,
                     .cases = {},
                     .cost = {"energy", "energy per particle"},
                     .others = {{"energy_drift", "energy drift", Shown::error}},
                     .varied = "time"},
                    {.name = "relaxation",
                     .about = "Figure 4.7: kinetic energy of 100 particles from a square lattice "
                              "whose energy, 3/2 kT per particle, is entirely translational or "
                              "rotational. In equilibrium, at zero momentum and fixed energy E, "
                              "it is E times a Beta(N − 1, N/2) variable. Brownian velocities are "
                              "drawn with the first partition.",
                     .measure = measure_relaxation,
                     .cases = {{"packing_fraction", "φ"}, {"dynamics"}},
                     .cost = {"energy", "kinetic energy per particle"},
                     .others = {{"expected", "equipartition"},
                                {"standard_error", "standard error", Shown::error}},
                     .varied = "time"}},
          .defaults = {.seconds = 1, .duration = 100}};
}

}  // namespace vitrel::bench

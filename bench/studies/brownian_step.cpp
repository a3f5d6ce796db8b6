// How short must a step of Brownian dynamics be, and what does a shorter one cost?

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "bench/studies/scratch_folder.h"
#include "bench/studies/study.h"
#include "bench/surveys/engine_speed.h"
#include "bench/surveys/mean.h"
#include "core/io/h5md.h"
#include "workflow/analyze/analyze.h"
#include "workflow/configuration/parameters.h"
#include "workflow/prepare/prepare.h"
#include "workflow/run/run.h"

namespace vitrel::bench {
namespace {

/// Times are in units of 1/D₀ with the diffusion coefficient D₀ = τ_B/2 of a free particle.
struct Liquid {
  double packing_fraction, duration, equilibration, interval;
};
const std::vector<Liquid> liquids = {
    {0.3, 8, 1, 0.01}, {0.5, 8, 1, 0.01}, {0.7, 20, 1, 0.02}, {0.8, 60, 20, 0.05}};
const std::vector<double> steps = {0.03, 0.1, 0.3, 1};

struct Effort {
  int particles = 400;
  std::uint64_t seeds = 8;
  std::size_t liquids = 4, first_step = 0;
  double share = 1;  ///< share of the duration that is run
};
const Effort quick{50, 1, 1, 1, 0.5};

std::string system_text(const Effort& effort, const Liquid& liquid, std::uint64_t seed) {
  return fmt::format(R"([system]
particles = {}
packing_fraction = {}
seed = {}
[[species]]
name = "A"
aspect_ratio = 2
size = {{ distribution = "gaussian", mean = 1, standard_deviation = 0.1 }}
[prepare]
quality_sweeps = 0
)",
                     effort.particles, liquid.packing_fraction, seed);
}

std::string run_text(const Effort& effort, const Liquid& liquid, double step, std::uint64_t seed,
                     const std::filesystem::path& state) {
  const double unit = 2 / step;  // 1/D₀
  return fmt::format(R"([system]
seed = {}
[[prepare.stage]]
method = "state"
file = {}
[dynamics]
kind = "brownian"
brownian_step = {}
equilibration = {}
duration = {}
[output]
velocities = false
samples = {{ interval = {} }}
[analysis]
only = "relaxation,relaxation_times"
longest_lag = 0.25
)",
                     seed, Json(state.string()).dump(), step, unit * liquid.equilibration,
                     unit * liquid.duration * effort.share, unit * liquid.interval);
}

/// The results of one liquid with one step, with an entry for each seed.
struct Seeds {
  std::vector<double> translation, rotation;  ///< D₀ τ
  std::vector<double> seconds;                ///< for D₀ t = 1
};

void add_run(Seeds& seeds, const Effort& effort, const Liquid& liquid, double step,
             std::uint64_t seed, const std::filesystem::path& state, const RunControl& control) {
  const ScratchFolder folder;
  const std::filesystem::path output = folder.partial() / "run.h5";
  const RunRequest request{parse_parameters(run_text(effort, liquid, step, seed, state), "the run"),
                           output};
  const double begin = processor_seconds();
  if (!run_simulation<2>(request, control, {}).complete) return;
  const double time = liquid.equilibration + liquid.duration * effort.share;
  seeds.seconds.push_back((processor_seconds() - begin) / time);
  const Json found = analysis_summary(analyze_run(output, {}));
  const auto scaled = [&](const char* key) {
    return found.contains(key) && found[key].is_number() ? step / 2 * found[key].get<double>()
                                                         : NAN;
  };
  seeds.translation.push_back(scaled("tau_translation"));
  seeds.rotation.push_back(scaled("tau_rotation"));
}

Json row_of(const Liquid& liquid, double step, const Seeds& seeds, const Seeds& shortest) {
  const Mean translation = mean_of(seeds.translation), rotation = mean_of(seeds.rotation);
  Json row = {{"method", fmt::format("τ_B = {:g}", step)},
              {"curve", fmt::format("φ = {:g}", liquid.packing_fraction)},
              {"packing_fraction", liquid.packing_fraction},
              {"brownian_step", step},
              {"ns", 1e9 * mean_of(seeds.seconds).value},
              {"translation", translation.value},
              {"rotation", rotation.value}};
  if (&seeds == &shortest) return row;
  // The runs of a seed begin with the same state, so they are compared seed by seed.
  std::vector<double> ratios;
  for (std::size_t k = 0; k < seeds.translation.size(); ++k)
    ratios.push_back(seeds.translation[k] / shortest.translation[k]);
  const Mean ratio = mean_of(ratios);
  row.update({{"deviation", ratio.value - 1},
              {"error", std::abs(ratio.value - 1)},
              {"deviation_error", ratio.error}});
  return row;
}

/// Prepares one equilibrium state for each seed, from which the runs with all steps begin.
void add_liquid(const StudyContext& context, const Effort& effort, const Liquid& liquid,
                Json& rows) {
  std::vector<Seeds> of_step(steps.size());
  for (std::uint64_t seed = 1; seed <= effort.seeds; ++seed) {
    const ScratchFolder folder;
    const std::filesystem::path state = folder.partial() / "state.h5";
    const Parameters parameters =
        parse_parameters(system_text(effort, liquid, seed), "the preparation");
    write_state(state, prepare<2>({parameters}, context.control, {}).configuration, {});
    for (std::size_t k = effort.first_step; k < steps.size(); ++k) {
      if (context.control.stop_requested()) return;
      add_run(of_step[k], effort, liquid, steps[k], seed, state, context.control);
    }
  }
  const Seeds& shortest = of_step[effort.first_step];
  for (std::size_t k = effort.first_step; k < steps.size(); ++k)
    rows.push_back(row_of(liquid, steps[k], of_step[k], shortest));
}

Json measure(const StudyContext& context) {
  const Effort effort = context.options.quick ? quick : Effort{};
  Json rows = Json::array();
  for (std::size_t k = 0; k < effort.liquids && !context.control.stop_requested(); ++k)
    add_liquid(context, effort, liquids[k], rows);
  return rows;
}

}  // namespace

Study brownian_step_study() {
  return {
      .name = "brownian-step",
      .aliases = {},
      .question =
          "How short must a step of Brownian dynamics be, and what does a shorter one cost?",
      .parts = {{.name = "relaxation",
                 .about = "400 ellipses, κ = 2, sizes spread by 10 %, eight seeds, each of which "
                          "starts with the same state for all steps τ_B. In units of 1/D₀, D₀ = "
                          "τ_B/2, relaxation times no longer depend on a step that is short. The "
                          "error is the deviation of τ_α from that with the shortest step, the "
                          "cost the processor time for D₀ t = 1.",
                 .measure = measure,
                 .cases = {},
                 .cost = {"ns", "time for D₀ t = 1", Shown::time},
                 .error = {"error", "deviation of τα", Shown::error},
                 .others = {{"packing_fraction", "φ"},
                            {"translation", "D₀ τα"},
                            {"rotation", "D₀ τ₂"},
                            {"deviation", "deviation, with its sign"},
                            {"deviation_error", "its standard error", Shown::error}},
                 .varied = "brownian_step",
                 .smallest_error = 1e-3}}};
}

}  // namespace vitrel::bench

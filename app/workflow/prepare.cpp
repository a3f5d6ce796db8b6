#include "app/workflow/prepare.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/error.h"
#include "edmd/growth.h"
#include "mc/sampler.h"

namespace vitrel {
namespace {

using Method = PrepareStage::Method;

/// Sweeps between two adaptations of the step sizes.
constexpr std::uint64_t sweeps_per_tuning = 20;

class Preparer {
 public:
  Preparer(const Parameters& parameters, const Budget& budget, int threads)
      : parameters_(parameters), budget_(budget), threads_(threads) {
    const SystemParameters& system = parameters.system;
    result.configuration =
        draw_particles(parameters.species, static_cast<std::size_t>(system.particles),
                       system.packing_fraction, system.box_aspect, system.seed);
  }

  /// What the stage does, in a few words.
  std::string description(const PrepareStage& stage) const {
    const double goal = end_of_stage(stage, parameters_.system, reached_);
    switch (stage.method) {
      case Method::lattice:
        return fmt::format("lattice at packing fraction {:.4g}", goal);
      case Method::insert:
        return fmt::format("insert at packing fraction {:.4g}", goal);
      case Method::swell:
        return fmt::format("swell to packing fraction {:.4g}", goal);
      case Method::compress:
        return stage.packing_fraction ? fmt::format("compress to packing fraction {:.4g}", goal)
                                      : fmt::format("compress at pressure {:.4g} for {} sweeps",
                                                    stage.pressure, stage.sweeps);
      case Method::grow:
        return stage.reduced_pressure
                   ? fmt::format("grow to reduced pressure {:.4g}", *stage.reduced_pressure)
                   : fmt::format("grow to packing fraction {:.4g}", goal);
      case Method::sample:
        return fmt::format("sample for {} sweeps", stage.sweeps);
    }
    return "";
  }

  /// False if the budget asked to stop.
  bool run(const PrepareStage& stage) {
    const StageReport report = run_stage(stage);
    StageReport& total = result.report;
    total.add_counts(report);
    total.end = report.end;
    total.reason = report.reason;
    if (report.end == StageEnd::stuck)
      throw UserError(fmt::format("preparation, {}: {}", description(stage), report.reason));
    reached_ = end_of_stage(stage, parameters_.system, reached_);
    return report.end != StageEnd::stopped;
  }

  Preparation result;

 private:
  StageReport run_stage(const PrepareStage& stage) {
    Configuration2& configuration = result.configuration;
    const std::uint64_t seed = parameters_.system.seed;
    const double goal = end_of_stage(stage, parameters_.system, reached_);
    switch (stage.method) {
      case Method::lattice:
        place_on_lattice(configuration, stage.lattice);
        return {};
      case Method::insert: {
        const bool aligned = stage.orientations == PrepareStage::Orientations::aligned;
        return insert_particles(configuration, {goal, stage.attempts, aligned}, seed, budget_);
      }
      case Method::swell:
        return swell(configuration, {goal, stage.most_sweeps, threads_}, seed, result.next_sweep,
                     budget_);
      case Method::compress:
        return compress(configuration,
                        {stage.pressure, stage.box, stage.packing_fraction,
                         stage.packing_fraction ? stage.most_sweeps : stage.sweeps, threads_},
                        seed, result.next_sweep, budget_);
      case Method::grow:
        return grow_stage(stage, goal);
      case Method::sample:
        return sample(stage);
    }
    return {};
  }

  StageReport grow_stage(const PrepareStage& stage, double goal) {
    Configuration2& configuration = result.configuration;
    GrowthOptions options;
    options.growth_rate = stage.growth_rate;
    options.packing_fraction = stage.packing_fraction;
    options.reduced_pressure = stage.reduced_pressure;
    if (!stage.reduced_pressure) options.packing_fraction = goal;
    options.seed = parameters_.system.seed;
    result.growth.push_back(grow(configuration, options, budget_));
    std::fill(configuration.velocity.begin(), configuration.velocity.end(), Vec2::Zero());
    std::fill(configuration.angular_velocity.begin(), configuration.angular_velocity.end(), 0.0);
    return result.growth.back();
  }

  // Step sizes adapt all the way: what follows the preparation is what is measured, not this.
  StageReport sample(const PrepareStage& stage) {
    Sampler sampler(result.configuration, parameters_.system.seed, result.next_sweep, threads_);
    StageEnd end = StageEnd::reached;
    for (std::uint64_t k = 0; k < stage.sweeps; ++k) {
      if (budget_.stop_requested()) {
        end = StageEnd::stopped;
        break;
      }
      sampler.sweep();
      if ((k + 1) % sweeps_per_tuning == 0) sampler.tune();
      const double done = static_cast<double>(k + 1);
      budget_.tell({done / static_cast<double>(stage.sweeps), done, "sweep"});
    }
    result.next_sweep = sampler.next_sweep();
    StageReport report = sampler.counts();
    report.end = end;
    return report;
  }

  const Parameters& parameters_;
  const Budget& budget_;
  int threads_;
  double reached_ = 0;
};

}  // namespace

Preparation prepare(const Parameters& parameters, const Budget& budget,
                    const std::function<void(const std::string&)>& say, int threads) {
  const auto start = std::chrono::steady_clock::now();
  Preparer preparer(parameters, budget, threads);
  for (const PrepareStage& stage : parameters.stages) {
    say(preparer.description(stage));
    if (!preparer.run(stage)) break;
  }
  Preparation result = std::move(preparer.result);
  result.wall_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (result.report.end == StageEnd::reached) {
    result.check = exact_check(result.configuration);
    if (!result.check.clean())
      throw InvariantError(
          "the prepared state has overlapping particles; this is a defect of the program");
  }
  return result;
}

}  // namespace vitrel

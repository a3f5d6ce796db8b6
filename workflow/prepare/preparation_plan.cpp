#include "workflow/prepare/preparation_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "core/elementary.h"
#include "core/state/species.h"
#include "core/state/typical_scales.h"
#include "edmd/hard_fluid.h"
#include "workflow/configuration/start_state.h"
#include "workflow/prepare/preparation_model.h"
#include "workflow/stages/hybrid_options.h"

namespace vitrel {
namespace {

/// The input of the estimate for one stage.
struct StageScene {
  const HardFluid& fluid;
  double particles;
  double typical_time;      ///< of the particles (typical_scales.h)
  double packing_fraction;  ///< at the start of the stage
  double end;               ///< at the end of the stage (end_of_stage)
};

/// Measured for growing particles, whose neighbour lists are rebuilt after few events.
double seconds_per_event(const HardFluid& fluid) {
  if (fluid.is_round()) return fluid.dimension() == 2 ? 0.8e-6 : 1.2e-6;
  return fluid.dimension() == 2 ? 1.2e-6 : 6e-6;
}

/// Measured time of one particle in one sweep.
double seconds_per_sweep(const HardFluid& fluid, Moves moves) {
  const bool is_local = moves == Moves::local;
  if (fluid.is_round()) return fluid.dimension() == 2 ? 0.1e-6 : 0.2e-6;
  if (fluid.dimension() == 2) return is_local ? 0.15e-6 : 0.6e-6;
  return is_local ? 0.5e-6 : 2e-6;
}

// Particles count as jamming from the Z `jamming` on. Z then rises by a factor of e in collisions_per_rise/(γ τ)
// collisions of a particle, and ln Z rises by rises_per_stretch in one interval of growth.
constexpr double jamming = 20;
constexpr double collisions_per_rise = 1.5;
constexpr double rises_per_stretch = 0.15;

/// The packing fraction at which the fluid has this Z.
double fraction_at(const HardFluid& fluid, double z) {
  double low = 0, high = 1;
  for (int k = 0; k < 50; ++k) {
    const double middle = 0.5 * (low + high);
    (fluid.compressibility_factor(middle) < z ? low : high) = middle;
  }
  return low;
}

/// A growth has two parts: the particles grow as a fluid up to a packing fraction, then ln Z rises near jamming.
struct Path {
  double fluid_end, rises;
};

Path path_of(const StageScene& scene, const std::optional<double>& reduced_pressure) {
  if (!reduced_pressure) return {scene.end, 0};
  const double end = fraction_at(scene.fluid, std::min(*reduced_pressure, jamming));
  return {std::max(end, scene.packing_fraction),
          logarithm(std::max(*reduced_pressure / jamming, 1.0))};
}

/// Collisions of a particle during growth: ∫ ν dt from φ to `end`, with dt = d ln φ/(D γ).
double collisions_of_growth(const StageScene& scene, double end, double rate) {
  constexpr int steps = 200;
  const double step = logarithm(end / scene.packing_fraction) / steps;
  double sum = 0;
  for (int k = 0; k < steps; ++k)
    sum += scene.fluid.collision_rate(scene.packing_fraction * exponential((k + 0.5) * step));
  return sum * step / (scene.fluid.dimension() * rate);
}

StageCost cost_of_sweeps(const StageScene& scene, double sweeps, Moves moves) {
  StageCost cost;
  cost.sweeps = sweeps;
  cost.seconds = sweeps * scene.particles * seconds_per_sweep(scene.fluid, moves);
  cost.packing_fraction = scene.packing_fraction;
  return cost;
}

StageCost cost_of_growth(const StageScene& scene, double growth_rate,
                         const std::optional<double>& reduced_pressure) {
  const Path path = path_of(scene, reduced_pressure);
  const double collisions =
      collisions_of_growth(scene, path.fluid_end, growth_rate / scene.typical_time) +
      collisions_per_rise * path.rises / growth_rate;
  StageCost cost;
  cost.events = HardFluid::events_per_collision * scene.particles * collisions;
  cost.seconds = cost.events * seconds_per_event(scene.fluid);
  cost.packing_fraction = path.fluid_end;
  return cost;
}

double growth_stretches(const StageScene& scene, const std::optional<double>& reduced_pressure) {
  const Path path = path_of(scene, reduced_pressure);
  const double growth =
      logarithm(path.fluid_end / scene.packing_fraction) / scene.fluid.dimension();
  return std::ceil(growth / largest_growth_of_stretch + path.rises / rises_per_stretch);
}

StageCost cost(const GrowStage& stage, const StageScene& scene) {
  return cost_of_growth(scene, stage.growth_rate, stage.reduced_pressure);
}

StageCost cost(const HybridStage& stage, const StageScene& scene) {
  StageCost cost = cost_of_growth(scene, stage.growth_rate, stage.reduced_pressure);
  const double sweeps =
      growth_stretches(scene, stage.reduced_pressure) * static_cast<double>(stage.stretch_sweeps);
  cost.add(cost_of_sweeps(scene, sweeps, stage.moves));
  return cost;
}

StageCost cost(const SwellStage&, const StageScene& scene) {
  const double z = scene.fluid.compressibility_factor(scene.end);
  StageCost cost = cost_of_sweeps(scene, 3 * std::sqrt(scene.particles) * z, Moves::local);
  cost.packing_fraction = scene.end;
  return cost;
}

StageCost cost(const CompressStage& stage, const StageScene& scene) {
  const bool is_foreseen = !stage.packing_fraction;
  const double sweeps = is_foreseen ? static_cast<double>(stage.sweeps) : 0;
  StageCost cost = cost_of_sweeps(scene, sweeps, Moves::local);
  cost.is_foreseen = is_foreseen;
  cost.packing_fraction = scene.end;
  return cost;
}

StageCost cost(const SampleStage& stage, const StageScene& scene) {
  const bool is_foreseen = stage.decorrelations == 0;
  const double sweeps = is_foreseen ? static_cast<double>(stage.sweeps) : 0;
  StageCost cost = cost_of_sweeps(scene, sweeps, stage.moves);
  cost.is_foreseen = is_foreseen;
  return cost;
}

template <class S>
requires S::places_particles StageCost cost(const S&, const StageScene& scene) {
  StageCost none;
  none.packing_fraction = scene.end;
  return none;
}

/// Growth is that of a fluid up to Z = 20. From there on the particles are assumed to jam: Z rises by a factor of e
/// in 1.5/(γ τ) collisions of a particle. An interval of growth in `hybrid` grows all lengths by 1 % or, near
/// jamming, raises ln Z by 0.15. Swelling takes about 3 √N Z sweeps, as measured for 200 to 1000 disks, ellipses,
/// spheres and ellipsoids at Z = 6 to 26. Stages that only place the particles cost nothing.
StageCost expected_cost(const Stage& stage, const StageScene& scene) {
  return std::visit([&](const auto& options) { return cost(options, scene); }, stage);
}

std::string cost_text(const StageCost& cost) {
  std::string text;
  if (cost.events > 0) text += fmt::format(", {:.2g} events", cost.events);
  if (cost.sweeps > 0) text += fmt::format(", {:.2g} sweeps", cost.sweeps);
  if (cost.seconds > 0) text += fmt::format(", {:.2g} s", cost.seconds);
  return cost.is_foreseen ? text : text + ", as many sweeps as it takes";
}

template <int Dim>
std::string plan_text(PrepareRequest& request) {
  Parameters& p = request.parameters;
  Configuration<Dim> some;
  if (start_state(p.stages))
    some = read_start<Dim>(p, request.overlaps_allowed, {});
  else
    some = representative_particles<Dim>(p);
  require_same_preparation<Dim>(request);
  return system_plan(p) + preparation_plan(p, some) +
         fmt::format("writes       {}\n", request.output.string());
}

}  // namespace

template <int Dim>
Configuration<Dim> representative_particles(const Parameters& p) {
  constexpr std::int64_t enough = 2000;
  const auto count = static_cast<std::size_t>(std::min(p.system.particles, enough));
  return draw_particles<Dim>(p.species, count, p.system.packing_fraction,
                             box_proportions<Dim>(p.system), p.system.seed, p.system.draw);
}

std::string system_plan(const Parameters& p) {
  const std::string fraction =
      has_unknown_end(p.stages) ? "as prepared" : fmt::format("{}", p.system.packing_fraction);
  return fmt::format("system       {} particles, packing fraction {}, seed {}\n",
                     p.system.particles, fraction, p.system.seed);
}

template <int Dim>
std::vector<StageCost> stage_costs(const Parameters& p, const Configuration<Dim>& some,
                                   double start) {
  const HardFluid fluid(some);
  StageScene scene{fluid, static_cast<double>(p.system.particles), typical_time(some), start, 0};
  std::vector<StageCost> costs;
  for (const Stage& stage : p.stages) {
    scene.end = end_of_stage(stage, p.system, scene.packing_fraction);
    costs.push_back(expected_cost(stage, scene));
    costs.back().goal = scene.end;
    scene.packing_fraction = costs.back().packing_fraction;
  }
  return costs;
}

template <int Dim>
std::string preparation_plan(const Parameters& p, const Configuration<Dim>& some) {
  const double start = start_state(p.stages) ? packing_fraction(some) : 0;
  const std::vector<StageCost> costs = stage_costs(p, some, start);
  std::string text;
  StageCost all;
  for (std::size_t k = 0; k < costs.size(); ++k) {
    text += fmt::format("stage        {}{}\n", stage_description(p.stages[k], costs[k].goal),
                        cost_text(costs[k]));
    all.add(costs[k]);
  }
  text +=
      fmt::format("prepares in  {}{:.2g} s\n", all.is_foreseen ? "" : "more than ", all.seconds);
  const std::string model = preparation_model(p, some);
  return model.empty() ? text : text + fmt::format("prepares by  {}\n", model);
}

std::string preparation_plan(PrepareRequest request) {
  return prepared_dimension(request) == 2 ? plan_text<2>(request) : plan_text<3>(request);
}

template Configuration2 representative_particles(const Parameters&);
template Configuration3 representative_particles(const Parameters&);
template std::vector<StageCost> stage_costs(const Parameters&, const Configuration2&, double);
template std::vector<StageCost> stage_costs(const Parameters&, const Configuration3&, double);
template std::string preparation_plan(const Parameters&, const Configuration2&);
template std::string preparation_plan(const Parameters&, const Configuration3&);

}  // namespace vitrel

#include "workflow/prepare/preparation_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/state/species.h"
#include "core/state/typical_scales.h"
#include "edmd/hard_fluid.h"
#include "workflow/configuration/start_state.h"

namespace vitrel {
namespace {

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
  return text +
         fmt::format("prepares in  {}{:.2g} s\n", all.is_foreseen ? "" : "more than ", all.seconds);
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

#include "analysis/glass/glass_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/structure/order.h"
#include "core/special_values.h"

namespace vitrel {
namespace {

constexpr double negligible = 0.05;  // rest of a correlation that counts as decayed

/// Returns whether nothing is left of a correlation at the longest time, except for what its error explains.
bool vanishes(const Decay& correlation) {
  const double error = std::isnan(correlation.error.back()) ? 0 : correlation.error.back();
  return correlation.value.back() <= std::max(negligible, 3 * error);
}

void judge_orientation(GlassRun& run, const GlassRunData& data) {
  run.nematic_order = {unknown, unknown, 0};
  run.plateau = 0;
  run.orientation = OrientationKind::round;
  run.rotation = {unknown, unknown, unknown, unknown, "no particle can turn"};
  if (data.rotors == 0) return;
  run.nematic_order = slow_average(data.nematic_order);
  const auto& [order, error, blocks] = run.nematic_order;
  if (!is_nematic(data)) {
    run.rotation = relaxation_time(data.orientation);
    const bool decays = !std::isnan(run.rotation.value) || !std::isnan(run.rotation.most);
    run.orientation = decays ? OrientationKind::relaxes : OrientationKind::lasting;
    return;
  }
  run.plateau = order * order;
  const Decay connected =
      connected_part(data.orientation, {run.plateau, 2 * order * error, blocks});
  run.rotation = relaxation_time(connected);
  const bool decays = !std::isnan(run.rotation.value) && vanishes(connected);
  run.orientation = decays ? OrientationKind::ordered : OrientationKind::lasting;
}

void judge(GlassRun& run, const GlassRunData& data) {
  RunEvidence evidence{data.duration,
                       data.series,
                       data.halves,
                       {{"tau_alpha", run.translation}},
                       data.starts_in_equilibrium};
  run.translation_equilibration = judge_equilibration(evidence);
  if (data.rotors > 0) {
    evidence.series.push_back({"the nematic order", data.nematic_order});
    evidence.curves.insert(evidence.curves.end(), data.rotation_halves.begin(),
                           data.rotation_halves.end());
    evidence.times.push_back({"tau_2", run.rotation});
  }
  run.equilibration = judge_equilibration(evidence);
  reconcile_verdicts(run);
}

}  // namespace

bool is_nematic(const GlassRunData& data) {
  return data.rotors > 0 && is_nematic(mean_of(data.nematic_order), data.rotors, data.dimension);
}

GlassRun judge_glass_run(const GlassRunData& data) {
  GlassRun run{};
  run.name = data.name;
  run.packing_fraction = data.packing_fraction;
  run.seed = data.seed;
  run.rotors = data.rotors;
  run.nematic_by_chance =
      data.rotors > 0 ? nematic_order_by_chance(data.rotors, data.dimension) : unknown;
  run.duration = data.duration;
  run.wave_number = data.wave_number;
  run.relative_to_cage = data.relative_to_cage;
  run.diffusion = data.diffusion;
  run.rotational_diffusion = data.rotational_diffusion;
  run.translation = relaxation_time(data.scattering);
  judge_orientation(run, data);
  judge(run, data);
  return run;
}

void reconcile_verdicts(GlassRun& run) {
  if (equilibrated(run.equilibration)) run.translation_equilibration = run.equilibration;
  const double known = std::fmin(run.translation.value, run.translation.most);
  if (run.duration >= min_relaxations_from_equilibrium * known) return;
  for (Equilibration* verdict : {&run.equilibration, &run.translation_equilibration})
    if (equilibrated(*verdict))
      *verdict = {EquilibrationVerdict::too_short,
                  fmt::format("the run lasts less than {:g} times tau_alpha",
                              min_relaxations_from_equilibrium),
                  verdict->tests};
}

bool equilibrated(const Equilibration& equilibration) {
  return equilibration.verdict == EquilibrationVerdict::equilibrated;
}

}  // namespace vitrel

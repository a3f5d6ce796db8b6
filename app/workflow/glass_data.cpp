#include "app/workflow/glass_data.h"

#include <algorithm>
#include <optional>

#include "analysis/director_frame.h"

namespace vitrel {
namespace {

constexpr double nematic_order_of_l = 2;  // the n of L_n that is judged

/// Null if it was not measured.
const Correlation* l_2(const Displacements& found) {
  const auto order = std::find(found.orders.begin(), found.orders.end(), nematic_order_of_l);
  const std::vector<Correlation>& orientation = found.groups.front().orientation;
  const auto index = static_cast<std::size_t>(order - found.orders.begin());
  return index < orientation.size() ? &orientation[index] : nullptr;
}

Decay decay(const Displacements& found, const Correlation& correlation) {
  return {found.lag, correlation.value, correlation.error};
}

BlockedCurve blocked(const Displacements& found, const Correlation& correlation) {
  return {found.lag, correlation.value, correlation.error, correlation.blocks};
}

/// L_2 alone, and F_s at the first of the wave numbers.
DisplacementOptions of_glass(DisplacementOptions options, const Displacements& found) {
  options.wave_numbers = {found.wave_numbers.front()};
  options.orders = {nematic_order_of_l};
  return options;
}

/// L_2, from another pass if the run's own correlations do not have it.
Decay orientation_of(Trajectory& seen, const Displacements& found,
                     const DisplacementOptions& options, bool from_director) {
  const Correlation* l = from_director ? nullptr : l_2(found);
  if (l) return decay(found, *l);
  const Displacements again = displacements(seen, options);
  return decay(again, *l_2(again));
}

/// Tells of the first (0) or second (1) of two passes over all particles as halves of one.
ProgressReport half(std::size_t number, std::size_t particles, const ProgressReport& report) {
  if (!report) return {};
  return [&report, done = static_cast<double>(number),
          n = static_cast<double>(particles)](const Progress& pass) {
    report({0.5 * (done + pass.fraction), done * n + pass.value, pass.quantity});
  };
}

void add_halves(GlassRunData& data, Trajectory& trajectory, const DisplacementOptions& options,
                const ProgressReport& report) {
  const std::size_t middle = trajectory.frames() / 2;
  if (middle < 2) return;
  TrajectoryPart early(trajectory, 0, middle);
  TrajectoryPart late(trajectory, middle, trajectory.frames());
  const std::size_t particles = trajectory.read(0).size();
  const Displacements first = displacements(early, options, half(0, particles, report));
  const Displacements second = displacements(late, options, half(1, particles, report));
  const DisplacementGroup& before = first.groups.front();
  const DisplacementGroup& after = second.groups.front();
  data.halves = {{"the mean squared displacement", blocked(first, before.translation),
                  blocked(second, after.translation)},
                 {"F_s", blocked(first, before.self_scattering.front()),
                  blocked(second, after.self_scattering.front())}};
  if (const Correlation* l = l_2(first))
    data.rotation_halves = {{"L_2", blocked(first, *l), blocked(second, *l_2(second))}};
}

}  // namespace

std::optional<GlassRunData> glass_run_data(Trajectory& trajectory, const GlassSource& run,
                                           const DisplacementOptions& options,
                                           const ProgressReport& report) {
  if (!evenly_spaced(trajectory.times())) return std::nullopt;
  const Displacements& found = run.displacements;
  const DisplacementGroup& all = found.groups.front();
  const DisplacementOptions wanted = of_glass(options, found);
  GlassRunData data{};
  data.name = run.name;
  data.packing_fraction = run.packing_fraction;
  data.seed = run.seed;
  data.rotors = run.rotors;
  data.duration = trajectory.times().back() - trajectory.times().front();
  data.wave_number = found.wave_numbers.front();
  data.scattering = decay(found, all.self_scattering.front());
  data.diffusion = run.diffusion;
  data.rotational_diffusion = run.rotational_diffusion;
  if (!run.compressibility.value.empty())
    data.series.push_back({"the compressibility factor", run.compressibility.value});
  data.series.push_back({"the hexatic order", run.order.find("hexatic")->value});
  if (run.rotors == 0) {
    add_halves(data, trajectory, wanted, report);
    return data;
  }
  data.nematic_order = run.order.find("nematic")->value;
  const bool nematic = is_nematic(data);
  std::optional<DirectorFrame> director;
  if (nematic) director.emplace(trajectory);
  Trajectory& seen = nematic ? *director : trajectory;
  data.orientation = orientation_of(seen, found, wanted, nematic);
  add_halves(data, seen, wanted, report);
  return data;
}

}  // namespace vitrel

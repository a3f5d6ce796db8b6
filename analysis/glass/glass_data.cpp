#include "analysis/glass/glass_data.h"

#include <algorithm>
#include <optional>

#include "analysis/dynamics/director_frame.h"

namespace vitrel {
namespace {

constexpr double nematic_order_of_l = 2;  // n of the L_n that is judged

/// Returns the place of L_2 of the first axis among the orders, or nothing if it was not measured.
std::optional<std::size_t> index_of_l_2(const Displacements& found) {
  const auto order = std::ranges::find(found.orders, nematic_order_of_l);
  const auto index = static_cast<std::size_t>(order - found.orders.begin());
  if (index >= found.groups.front().orientation.size()) return std::nullopt;
  return index;
}

Decay decay(const std::vector<double>& lag, const Correlation& correlation) {
  return {lag, correlation.value, correlation.error};
}

/// Returns options that measure L_2 alone.
DisplacementOptions of_orientation(DisplacementOptions options) {
  options.parts = {.displacement = false, .scattering = false, .overlap = false};
  options.orders = {nematic_order_of_l};
  return options;
}

BlockedCurve blocked(const HalfOfRun& half, const Correlation& correlation) {
  return {half.lag, correlation.value, correlation.error, correlation.blocks};
}

void add_halves(GlassRunData& data, const Displacements& found) {
  if (found.halves.empty()) return;
  const HalfOfRun &first = found.halves[0], &second = found.halves[1];
  data.halves = {{"the mean squared displacement", blocked(first, first.translation),
                  blocked(second, second.translation)},
                 {"F_s", blocked(first, first.self_scattering.front()),
                  blocked(second, second.self_scattering.front())}};
}

void add_orientation(GlassRunData& data, const Displacements& found) {
  const std::size_t l = *index_of_l_2(found);
  data.orientation = decay(found.lag, found.groups.front().orientation[l]);
  if (found.halves.empty()) return;
  const HalfOfRun &first = found.halves[0], &second = found.halves[1];
  data.rotation_halves = {
      {"L_2", blocked(first, first.orientation[l]), blocked(second, second.orientation[l])}};
}

/// Returns the data that need no other pass, without L_2.
GlassRunData known_data(const GlassSource& run, int dimension, const std::vector<double>& times) {
  const Displacements& found = run.displacements;
  GlassRunData data{};
  data.name = run.name;
  data.dimension = dimension;
  data.packing_fraction = run.packing_fraction;
  data.seed = run.seed;
  data.rotors = run.rotors;
  data.starts_in_equilibrium = run.starts_in_equilibrium;
  data.duration = times.back() - times.front();
  data.wave_number = found.wave_numbers.front();
  if (const CageRelative* cage = run.cage_relative)
    data.scattering = decay(cage->lag, cage->self_scattering.front());
  else
    data.scattering = decay(found.lag, found.groups.front().self_scattering.front());
  data.relative_to_cage = run.cage_relative;
  data.diffusion = run.diffusion;
  data.rotational_diffusion = run.rotational_diffusion;
  if (!run.compressibility.value.empty())
    data.series.push_back({"the compressibility factor", run.compressibility.value});
  if (!run.order.hexatic.empty()) data.series.push_back({"the hexatic order", run.order.hexatic});
  data.nematic_order = run.order.nematic;
  return data;
}

}  // namespace

template <int Dim>
std::optional<GlassRunData> glass_run_data(Trajectory<Dim>& trajectory, const GlassSource& run,
                                           const DisplacementOptions& options,
                                           const ProgressReport& report) {
  if (!evenly_spaced(trajectory.times())) return std::nullopt;
  const Displacements& found = run.displacements;
  GlassRunData data = known_data(run, Dim, trajectory.times());
  add_halves(data, found);
  if (run.rotors == 0) return data;
  if (is_nematic(data)) {
    DirectorFrame<Dim> seen_from_director(trajectory);
    add_orientation(data, displacements(seen_from_director, of_orientation(options), report));
  } else if (index_of_l_2(found)) {
    add_orientation(data, found);
  } else {
    add_orientation(data, displacements(trajectory, of_orientation(options), report));
  }
  return data;
}

template std::optional<GlassRunData> glass_run_data(Trajectory2&, const GlassSource&,
                                                    const DisplacementOptions&,
                                                    const ProgressReport&);
template std::optional<GlassRunData> glass_run_data(Trajectory3&, const GlassSource&,
                                                    const DisplacementOptions&,
                                                    const ProgressReport&);

}  // namespace vitrel

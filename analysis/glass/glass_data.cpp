#include "analysis/glass/glass_data.h"

#include <algorithm>
#include <optional>

#include "analysis/dynamics/director_frame.h"

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

Decay decay(const std::vector<double>& lag, const Correlation& correlation) {
  return {lag, correlation.value, correlation.error};
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

/// Passes over all particles, told as one piece of work.
class Passes {
 public:
  Passes(std::size_t count, std::size_t particles, const ProgressReport& report)
      : count_(static_cast<double>(count)),
        particles_(static_cast<double>(particles)),
        report_(report) {}

  ProgressReport next() {
    if (!report_) return {};
    return [this, before = begun_++](const Progress& pass) {
      report_({(before + pass.fraction) / count_, before * particles_ + pass.value, pass.quantity});
    };
  }

 private:
  double count_, particles_;
  double begun_ = 0;
  const ProgressReport& report_;
};

/// L_2 from a pass of its own.
template <int Dim>
Decay orientation(Trajectory<Dim>& seen, const DisplacementOptions& options,
                  const ProgressReport& report) {
  const Displacements found = displacements(seen, options, report);
  return decay(found.lag, *l_2(found));
}

template <int Dim>
void add_halves(GlassRunData& data, Trajectory<Dim>& trajectory, const DisplacementOptions& options,
                Passes& passes) {
  const std::size_t middle = trajectory.frames() / 2;
  if (middle < 2) return;
  TrajectoryPart<Dim> early(trajectory, 0, middle);
  TrajectoryPart<Dim> late(trajectory, middle, trajectory.frames());
  const Displacements first = displacements(early, options, passes.next());
  const Displacements second = displacements(late, options, passes.next());
  const DisplacementGroup& before = first.groups.front();
  const DisplacementGroup& after = second.groups.front();
  data.halves = {{"the mean squared displacement", blocked(first, before.translation),
                  blocked(second, after.translation)},
                 {"F_s", blocked(first, before.self_scattering.front()),
                  blocked(second, after.self_scattering.front())}};
  if (const Correlation* l = l_2(first))
    data.rotation_halves = {{"L_2", blocked(first, *l), blocked(second, *l_2(second))}};
}

/// What there is without another pass, but for L_2.
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
  const DisplacementOptions wanted = of_glass(options, found);
  GlassRunData data = known_data(run, Dim, trajectory.times());
  std::optional<DirectorFrame<Dim>> director;
  if (is_nematic(data)) director.emplace(trajectory);
  Trajectory<Dim>& seen = director ? *director : trajectory;
  const Correlation* measured = director ? nullptr : l_2(found);
  const bool is_missing = run.rotors > 0 && !measured;
  Passes passes(is_missing ? 3 : 2, trajectory.read(0).size(), report);
  if (measured) data.orientation = decay(found.lag, *measured);
  if (is_missing) data.orientation = orientation(seen, wanted, passes.next());
  add_halves(data, seen, wanted, passes);
  return data;
}

template std::optional<GlassRunData> glass_run_data(Trajectory2&, const GlassSource&,
                                                    const DisplacementOptions&,
                                                    const ProgressReport&);
template std::optional<GlassRunData> glass_run_data(Trajectory3&, const GlassSource&,
                                                    const DisplacementOptions&,
                                                    const ProgressReport&);

}  // namespace vitrel

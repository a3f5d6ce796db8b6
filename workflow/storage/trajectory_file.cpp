#include "workflow/storage/trajectory_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/special_values.h"

namespace vitrel {
namespace {

std::vector<double> per_particle(std::vector<double> totals, std::size_t particles) {
  for (double& value : totals) value /= static_cast<double>(particles);
  return totals;
}

std::string helfand_moment(std::size_t element) {
  return fmt::format("helfand_moment_{}", shear_element_names[element]);
}

}  // namespace

std::vector<std::string> run_observables(int dimension, bool is_conservative) {
  std::vector<std::string> names = {"collisions", "rotational_energy", "translational_energy",
                                    "virial"};
  const std::size_t elements = dimension == 2 ? shear_elements<2> : shear_elements<3>;
  for (std::size_t k = 0; is_conservative && k < elements; ++k) names.push_back(helfand_moment(k));
  return names;
}

template <int Dim>
Observables measure_run(const Frame<Dim>& frame, const std::vector<std::string>& names) {
  const Mechanics<Dim> sums = mechanics(frame.configuration);
  Observables all = {{"collisions", static_cast<double>(frame.tally.collisions)},
                     {"rotational_energy", sums.rotational_energy},
                     {"translational_energy", sums.translational_energy},
                     {"virial", frame.tally.virial}};
  for (std::size_t k = 0; k < shear_elements<Dim>; ++k)
    all[helfand_moment(k)] = frame.tally.helfand_moment[k];
  std::erase_if(all, [&](const auto& item) { return !std::ranges::count(names, item.first); });
  return all;
}

template Observables measure_run(const Frame<2>&, const std::vector<std::string>&);
template Observables measure_run(const Frame<3>&, const std::vector<std::string>&);

EnergySeries observed_energies(const TrajectoryReader& reader) {
  if (!reader.has_observable("translational_energy") || !reader.has_observable("rotational_energy"))
    return {};
  EnergySeries series;
  series.time = reader.times();
  series.translational =
      per_particle(reader.observable("translational_energy"), reader.particles());
  series.rotational = per_particle(reader.observable("rotational_energy"), reader.particles());
  for (std::size_t k = 0; k < series.time.size(); ++k)
    series.total.push_back(series.translational[k] + series.rotational[k]);
  return series;
}

CompressibilitySeries stored_compressibility(const TrajectoryReader& reader,
                                             const EnergySeries& energy, std::size_t rotations) {
  if (energy.time.empty() || !reader.has_observable("virial"))
    return {{}, {}, {unknown, unknown, 0}};
  return compressibility(energy, reader.observable("virial"), reader.particles(), rotations,
                         reader.dimension());
}

std::vector<std::vector<double>> helfand_moments(const TrajectoryReader& reader) {
  std::vector<std::vector<double>> moments;
  for (std::size_t k = 0; k < shear_element_names.size(); ++k)
    if (reader.has_observable(helfand_moment(k)))
      moments.push_back(reader.observable(helfand_moment(k)));
  return moments;
}

}  // namespace vitrel

#include "analysis/dynamics/energy.h"

#include <cassert>
#include <limits>
#include <numeric>

#include "core/special_values.h"

namespace vitrel {

template <int Dim>
EnergySeries energies(Trajectory<Dim>& trajectory) {
  EnergySeries series;
  series.time = trajectory.times();
  for (std::size_t k = 0; k < trajectory.frames(); ++k) {
    const Configuration<Dim>& frame = trajectory.read(k);
    const Mechanics<Dim> sums = mechanics(frame);
    const double n = static_cast<double>(frame.size());
    series.translational.push_back(sums.translational_energy / n);
    series.rotational.push_back(sums.rotational_energy / n);
    series.total.push_back((sums.translational_energy + sums.rotational_energy) / n);
  }
  return series;
}

template EnergySeries energies(Trajectory2&);
template EnergySeries energies(Trajectory3&);

Estimate time_average(const std::vector<double>& time, const std::vector<double>& series) {
  Estimate estimate = slow_average(series);
  if (!evenly_spaced(time)) estimate = {estimate.mean, std::numeric_limits<double>::quiet_NaN(), 0};
  return estimate;
}

double mean_temperature(const EnergySeries& energy, std::size_t particles, std::size_t rotations,
                        int dimension) {
  const double n = static_cast<double>(particles);
  const double mean_energy = n * std::accumulate(energy.total.begin(), energy.total.end(), 0.0) /
                             static_cast<double>(energy.total.size());
  return 2 * mean_energy / (dimension * (n - 1) + static_cast<double>(rotations));
}

CompressibilitySeries compressibility(const EnergySeries& energy, const std::vector<double>& virial,
                                      std::size_t particles, std::size_t rotations, int dimension) {
  assert(virial.size() == energy.time.size());
  const std::size_t frames = virial.size();
  if (frames < 2 || particles < 2) return {{}, {}, {unknown, unknown, 0}};

  const double n = static_cast<double>(particles);
  const double temperature = mean_temperature(energy, particles, rotations, dimension);
  const auto between = [&](std::size_t from, std::size_t to) {
    const double time = energy.time[to] - energy.time[from];
    return 1 + (virial[to] - virial[from]) / (dimension * n * temperature * time);
  };

  CompressibilitySeries series;
  for (std::size_t k = 1; k < frames; ++k) {
    series.time.push_back(0.5 * (energy.time[k - 1] + energy.time[k]));
    series.value.push_back(between(k - 1, k));
  }
  if (virial.back() == virial.front()) {
    series.mean = {unknown, unknown, 0};
    return series;
  }
  // If intervals differ, the mean over the run is not the mean of the values in the intervals.
  series.mean = time_average(energy.time, series.value);
  series.mean.mean = between(0, frames - 1);
  return series;
}

}  // namespace vitrel

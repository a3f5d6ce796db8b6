#pragma once

#include <cmath>
#include <span>

#include "core/state/configuration.h"

/// Plain statistics for tests, independent of the analysis library that some of them judge.
namespace vitrel {

struct Estimate {
  double mean;
  double error;  ///< standard error
};

/// Mean and standard error of independent values.
inline Estimate estimate(std::span<const double> values) {
  const double n = static_cast<double>(values.size());
  double sum = 0, square = 0;
  for (double value : values) sum += value;
  const double mean = sum / n;
  for (double value : values) square += (value - mean) * (value - mean);
  return {mean, std::sqrt(square / (n - 1) / n)};
}

/// kT = 2E/f at zero net momentum, f = D (N − 1) + N_rot degrees of freedom in D dimensions.
template <int Dim>
double kinetic_temperature(const Configuration<Dim>& configuration) {
  const Mechanics<Dim> sums = mechanics(configuration);
  const double freedoms = Dim * (static_cast<double>(configuration.size()) - 1) +
                          static_cast<double>(rotation_count(configuration));
  return 2 * (sums.translational_energy + sums.rotational_energy) / freedoms;
}

/// Z = βP/ρ = 1 + Σ J n·d/(D N kT t) from the virial of the collisions in a time t.
template <int Dim>
double virial_compressibility(const Configuration<Dim>& configuration, double virial, double time) {
  const double n = static_cast<double>(configuration.size());
  return 1 + virial / (Dim * n * kinetic_temperature(configuration) * time);
}

}  // namespace vitrel

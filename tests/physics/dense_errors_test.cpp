// Errors of correlations in a dense liquid, where particles move together. No closed form is known: the
// truth is the mean of a hundred runs, which differ in their random numbers only.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "analysis/dynamics/displacement.h"
#include "analysis/dynamics/relaxation.h"
#include "analysis/trajectory.h"
#include "tests/support/fluids.h"
#include "tests/support/runs.h"

namespace vitrel {
namespace {

constexpr int runs = 100;
constexpr double duration = 200, equilibration = 30, interval = 0.5;

Displacements dense_run(Configuration2 start, std::uint64_t seed) {
  draw_velocities(start, seed, Purpose::velocities, 0, Temperature::total);
  DynamicsOptions options;
  options.brownian = true;
  options.seed = seed;
  MemoryTrajectory2 trajectory(
      recorded_run(start, -equilibration, linear_times(interval, duration), duration, options)
          .frames);
  DisplacementOptions wanted;
  wanted.wave_numbers = {main_wave_number(start)};
  return displacements(trajectory, wanted);
}

struct Measured {
  double value, error;
};

/// By name: what a run says about curves at some times, and about the numbers taken from them.
std::map<std::string, Measured> measured(const Displacements& found) {
  const DisplacementGroup& all = found.groups.front();
  const std::map<std::string, const Correlation*> curves = {
      {"MSD", &all.translation}, {"F_s", &all.self_scattering.front()},
      {"MSR", &all.rotation},    {"L_2", &all.orientation.front()},
      {"Q", &found.overlap},     {"alpha_2", &all.non_gaussian}};
  std::map<std::string, Measured> result;
  for (const auto& [name, curve] : curves)
    for (std::size_t k = 0; k < found.lag.size(); ++k)
      for (const double time : {1.0, 5.0, 25.0, 75.0})
        if (found.lag[k] <= time && (k + 1 == found.lag.size() || found.lag[k + 1] > time))
          result[fmt::format("{} at {:g}", name, time)] = {curve->value[k], curve->error[k]};
  const auto tau = [&](const Correlation& c) {
    const RelaxationTime time = relaxation_time({found.lag, c.value, c.error});
    return Measured{time.value, time.error};
  };
  result["tau_alpha"] = tau(all.self_scattering[0]);
  result["tau_2"] = tau(all.orientation.front());
  return result;
}

// The part of the values within so many of their standard deviations, and the deviation of its count.
double covered_by(double error) {
  return std::erf(error / std::numbers::sqrt2);
}
double deviation(double error) {
  return std::sqrt(runs * covered_by(error) * (1 - covered_by(error)));
}

// Counts within 3.5 binomial standard deviations of what the errors say at short times, which have errors by blocks of
// time (1 and 5: an eighth and a half of τ_α). Beyond, where particles may stand in for blocks, and in what is taken from
// such points, errors are right within a quarter, of which the scatter of a hundred runs is known to 7 %.
TEST(DenseLiquid, ErrorBarsCoverWhatOtherRunsSay) {
  Configuration2 start = swollen_fluid(48, 2, 0.72);
  start.species_names = {"A"};
  std::map<std::string, std::vector<Measured>> all;
  for (std::uint64_t seed = 1; seed <= runs; ++seed)
    for (const auto& [name, one] : measured(dense_run(start, seed))) all[name].push_back(one);
  for (const auto& [name, values] : all) {
    ASSERT_EQ(values.size(), static_cast<std::size_t>(runs)) << name;
    double mean = 0, scatter = 0, error = 0;
    for (const Measured& one : values) mean += one.value / runs;
    int covered = 0;
    for (const Measured& one : values) {
      covered += std::abs(one.value - mean) < one.error;
      scatter += (one.value - mean) * (one.value - mean) / (runs - 1);
      error += one.error * one.error / runs;
    }
    const bool by_blocks = name.ends_with(" at 1") || name.ends_with(" at 5");
    const double least = by_blocks ? 1 : 0.75, most = by_blocks ? 1 : 1.25;
    EXPECT_GE(covered, runs * covered_by(least) - 3.5 * deviation(least)) << name;
    EXPECT_LE(covered, runs * covered_by(most) + 3.5 * deviation(most)) << name;
    if (by_blocks) continue;
    EXPECT_GT(std::sqrt(error / scatter), least) << name;
    EXPECT_LT(std::sqrt(error / scatter), most) << name;
  }
}

}  // namespace
}  // namespace vitrel

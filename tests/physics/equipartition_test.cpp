// Energy goes where equipartition wants it, and velocities become Gaussian (thesis, figure 4.7).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/equal_bodies.h"
#include "tests/support/runs.h"
#include "tests/support/statistics.h"

namespace vitrel {
namespace {

Configuration2 scene(int side) {
  return square_lattice(side, 0.5, std::numbers::pi / 4, of_aspect_ratio(2));
}

class WrongSplit : public testing::TestWithParam<InitialVelocities> {};

// At fixed energy E and zero momentum, with f = 3N − 2 degrees of freedom: ⟨K⟩ = E (2N − 2)/f and
// ⟨R⟩ = E N/f, about 1 and 1/2 kT per particle for E = 3/2 N kT. 4 standard errors: false alarm
// 6e-5.
TEST_P(WrongSplit, RelaxesToEquipartition) {
  Configuration2 start = scene(10);
  set_initial_velocities(start, 1, GetParam(), Temperature::total);
  const Recorder recorder = recorded_run(start, 0, linear_times(0.25, 620), 620);
  const double window = 20;

  const double first = mechanics(recorder.frames.front()).translational_energy;
  EXPECT_NEAR(first, GetParam() == InitialVelocities::translation ? 150 : 0, 1e-10);
  const std::size_t per_window = static_cast<std::size_t>(window / 0.25);
  std::vector<double> kinetic;
  for (std::size_t at = per_window; at + per_window <= recorder.frames.size(); at += per_window) {
    double sum = 0;
    for (std::size_t k = at; k < at + per_window; ++k)
      sum += mechanics(recorder.frames[k]).translational_energy / 100;
    kinetic.push_back(sum / static_cast<double>(per_window));
  }
  const Estimate k = estimate(kinetic);
  EXPECT_LT(k.error, 0.01);
  EXPECT_NEAR(k.mean, 1.5 * 198 / 298, 4 * k.error);
}

INSTANTIATE_TEST_SUITE_P(Thesis47, WrongSplit,
                         testing::Values(InitialVelocities::translation,
                                         InitialVelocities::rotation),
                         [](const auto& at) {
                           return at.param == InitialVelocities::rotation ? "rotation"
                                                                          : "translation";
                         });

/// Kolmogorov–Smirnov distance of a sample to the standard normal distribution, times √n.
double kolmogorov_smirnov(std::vector<double> sample) {
  std::sort(sample.begin(), sample.end());
  const double n = static_cast<double>(sample.size());
  double distance = 0;
  for (std::size_t k = 0; k < sample.size(); ++k) {
    const double cdf = 0.5 * std::erfc(-sample[k] / std::numbers::sqrt2);
    distance = std::max({distance, (k + 1) / n - cdf, cdf - k / n});
  }
  return distance * std::sqrt(n);
}

// Samples 4 time units apart, some twenty collisions per particle. Level 1e-3: √n D < 1.95.
TEST(Velocities, BecomeGaussian) {
  Configuration2 start = scene(16);
  set_initial_velocities(start, 3, InitialVelocities::translation, Temperature::relative);
  const Recorder recorder = recorded_run(start, -60, linear_times(4, 80), 80);
  const double thermal = std::sqrt(kinetic_temperature(start));
  std::vector<double> v, omega;
  for (const Configuration2& frame : recorder.frames)
    for (std::size_t i = 0; i < frame.size(); ++i) {
      v.push_back(frame.velocity[i].x() / thermal);
      v.push_back(frame.velocity[i].y() / thermal);
      omega.push_back(frame.angular_velocity[i] * std::sqrt(frame.inertia(i)) / thermal);
    }
  EXPECT_LT(kolmogorov_smirnov(v), 1.95);
  EXPECT_LT(kolmogorov_smirnov(omega), 1.95);
  // The test is alive: a distribution with the wrong width by 10 % fails it.
  for (double& value : v) value *= 1.1;
  EXPECT_GT(kolmogorov_smirnov(v), 1.95);
}

}  // namespace
}  // namespace vitrel

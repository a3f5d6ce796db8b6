#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "analysis/observables/frame_observable.h"
#include "tests/support/frames.h"
#include "tests/support/random_gas.h"
#include "tests/support/tables.h"

namespace vitrel {
namespace {

/// Particles of two masses in a gas that drifts as a whole; their velocities are drawn by `component`.
template <int Dim, class Component>
MemoryTrajectory<Dim> moving_gas(std::size_t n, std::size_t frames, Component&& component) {
  Stream draw(1, Purpose::tests);
  const auto set = [&](Configuration<Dim>& c, std::size_t i) {
    c.mass[i] = i % 2 ? 1 : 4;
    for (double& v : c.velocity[i]) v = 100 + component(draw) / std::sqrt(c.mass[i]);
  };
  return trajectory_of(frames, Configuration<Dim>(), [&](auto& frame, std::size_t k) {
    frame = random_gas<Dim>(n, Vec<Dim>::Constant(10), draw, set);
    frame.time = static_cast<double>(k);
  });
}

double mean_of_column(const Table& table, const std::string& name) {
  double sum = 0;
  for (const double value : table.find(name)->value) sum += value;
  return sum / static_cast<double>(table.rows());
}

// 80 000 velocities: T is known to T √(2/(3 · 80 000)), a₂ to √(8/15/80 000) = 0.003; the drift costs 1/4000 of T.
TEST(VelocityObservable, OfAMaxwellianIsGaussian) {
  auto trajectory = moving_gas<3>(4000, 20, [](Stream& draw) { return 3 * draw.normal(); });
  const std::vector<Table> tables = measure_frames(trajectory, {}).tables;
  const Table& velocities = named(tables, "velocities");
  EXPECT_EQ(velocities.rows(), 20u);
  EXPECT_NEAR(mean_of_column(velocities, "temperature"), 9, 4 * 9 * std::sqrt(2.0 / 3 / 80'000));
  EXPECT_NEAR(mean_of_column(velocities, "a_2"), 0, 4 * 0.003);
  const Table& distribution = named(tables, "velocity_distribution");
  const Column& density = *distribution.find("density");
  for (std::size_t k = 0; k < distribution.rows(); ++k) {
    const double c = distribution.columns.front().value[k];
    const double normal = std::exp(-c * c / 2) / std::sqrt(2 * std::numbers::pi);
    // Counts of a bin scatter by the root of their number; the bin is as wide as its curvature allows.
    EXPECT_NEAR(density.value[k], normal, 5 * std::sqrt(normal / (0.1 * 240'000)) + 1e-3) << c;
  }
}

// Components that are ±1: ⟨v⁴⟩ = d² in every frame, a₂ = d/(d + 2) − 1, but for the drift.
TEST(VelocityObservable, SecondSonineCoefficientOfEqualSpeeds) {
  auto trajectory =
      moving_gas<2>(4000, 3, [](Stream& draw) { return draw.uniform(0, 1) < 0.5 ? -1.0 : 1.0; });
  const Table velocities = named(measure_frames(trajectory, {}).tables, "velocities");
  EXPECT_NEAR(mean_of_column(velocities, "a_2"), 2.0 / 4 - 1, 0.005);
  EXPECT_NEAR(mean_of_column(velocities, "temperature"), 1, 0.005);
}

TEST(VelocityObservable, IsLeftOutAtRest) {
  Configuration2 frame = moving_gas<2>(10, 1, [](Stream&) { return 0.0; }).read(0);
  for (Vec2& v : frame.velocity) v.setZero();
  MemoryTrajectory2 still({frame});
  for (const Table& table : measure_frames(still, {}).tables) EXPECT_NE(table.name, "velocities");
}

}  // namespace
}  // namespace vitrel

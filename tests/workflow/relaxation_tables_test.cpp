#include "workflow/analyze/relaxation_tables.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/support/free_brownian.h"
#include "tests/support/solids.h"

namespace vitrel {
namespace {

Configuration2 ellipses_and_disks() {
  Configuration2 configuration = ellipses(150);
  configuration.species_names = {"ellipse", "disk"};
  for (std::size_t i = 100; i < 150; ++i) {
    configuration.shape[i] = {1, 1};
    configuration.species[i] = 1;
  }
  return configuration;
}

/// F_s = exp(−q² MSD/4) and L_n = exp(−n² MSR/2), MSD and MSR proportional to time.
double truth(double kind, double parameter) {
  const double per_time = kind == 0 ? free_msd(1) / 4 : free_msr(1, ellipses(1).inertia(0)) / 2;
  return 1 / (parameter * parameter * per_time);
}

// Four standard errors, and the 0.2 % by which a straight line may be wrong (relaxation.h): false-alarm rate
// 0.06 per mille for each of 20 rows.
void expect_close(const Column& tau, std::size_t row, double expected) {
  EXPECT_GT(tau.error[row], 0) << row;
  EXPECT_LT(tau.error[row], 0.1 * expected) << row;
  EXPECT_NEAR(tau.value[row], expected, 4 * tau.error[row] + 0.002 * expected) << row;
}

void expect_closed_forms(Trajectory2& trajectory) {
  Results results;
  store_relaxation_times(displacements(trajectory, {.wave_numbers = {2, 3}}), nullptr, results);
  const Table& table = *results.find("relaxation_times");
  // Both quantities twice in "all" and "ellipse", F_s in "disk".
  EXPECT_EQ(table.find("group")->value, (std::vector<double>{0, 0, 0, 0, 1, 1, 1, 1, 2, 2}));
  EXPECT_EQ(table.find("kind")->value, (std::vector<double>{0, 0, 1, 1, 0, 0, 1, 1, 0, 0}));
  EXPECT_EQ(table.find("parameter")->value, (std::vector<double>{2, 3, 2, 4, 2, 3, 2, 4, 2, 3}));
  EXPECT_EQ(results.text("group_0"), "all");
  EXPECT_EQ(results.text("group_1"), "ellipse");
  EXPECT_EQ(results.text("group_2"), "disk");
  const Column& tau = *table.find("tau");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double expected =
        truth(table.find("kind")->value[row], table.find("parameter")->value[row]);
    expect_close(tau, row, expected);
    EXPECT_EQ(results.text("relaxation_times_" + std::to_string(row)), "");
  }
}

TEST(RelaxationTables, FreeBrownianParticlesFollowTheClosedForms) {
  MemoryTrajectory2 trajectory = free_brownian(ellipses_and_disks(), 801, 1);
  expect_closed_forms(trajectory);
}

// Independent particles move by 1 + ⟨1/n⟩ as much relative to n neighbours, and n is about 6.
TEST(RelaxationTables, RelativeToTheCageFreeParticlesRelaxSooner) {
  MemoryTrajectory2 trajectory = free_brownian(ellipses_and_disks(), 801, 1);
  const DisplacementOptions options{.wave_numbers = {2, 3}};
  const auto cage = cage_relative(trajectory, options);
  ASSERT_TRUE(cage);
  Results results;
  store_relaxation_times(displacements(trajectory, options), &*cage, results);
  const Table& table = *results.find("relaxation_times");
  ASSERT_EQ(table.rows(), 12u);
  for (const std::size_t row : {10, 11}) {
    EXPECT_EQ(table.find("group")->value[row], 0);
    EXPECT_EQ(table.find("kind")->value[row], 4);
    const double parameter = table.find("parameter")->value[row];
    EXPECT_EQ(parameter, row == 10 ? 2 : 3);
    EXPECT_NEAR(table.find("tau")->value[row] * (1 + 1 / 6.), truth(0, parameter),
                0.1 * truth(0, parameter));
  }
}

TEST(RelaxationTables, SoTheyDoSampledInCycles) {
  MemoryTrajectory2 steps = free_brownian(ellipses_and_disks(), 1601, 2);
  MemoryTrajectory2 trajectory = cycles(steps);
  expect_closed_forms(trajectory);
}

/// Scalene ellipsoids that turn about their middle axis only, by normal angles with that standard
/// deviation, once in a unit of time.
MemoryTrajectory3 turning_about_the_middle_axis(double deviation) {
  Stream draw(4, Purpose::tests);
  Configuration3 c;
  c.box = PeriodicBox<3>(Vec3(4, 5, 6));
  c.species_names = {"A"};
  c.resize(150);
  for (std::size_t i = 0; i < c.size(); ++i) {
    c.shape[i].semi_axes = Vec3(1, 0.5, 2);
    c.orientation[i] = random_orientation(draw);
  }
  std::vector<Configuration3> frames;
  for (std::size_t k = 0; k < 401; ++k) {
    c.time = static_cast<double>(k);
    frames.push_back(c);
    for (Quaternion& orientation : c.orientation)
      orientation = orientation * Eigen::AngleAxisd(deviation * draw.normal(), Vec3::UnitX());
  }
  return MemoryTrajectory3(std::move(frames));
}

// The middle axis keeps its direction. The others turn in a plane by an angle of variance σ² t, so P_1 =
// exp(−σ² t/2) and P_2 = (1 + 3 exp(−2 σ² t))/4. Errors as above.
TEST(RelaxationTables, HaveAllAxesOfScaleneEllipsoids) {
  constexpr double deviation = 0.25;
  MemoryTrajectory3 trajectory = turning_about_the_middle_axis(deviation);
  Results results;
  store_relaxation_times(displacements(trajectory, {.wave_numbers = {1}}), nullptr, results);
  const Table& table = *results.find("relaxation_times");
  EXPECT_EQ(table.find("kind")->value, (std::vector<double>{0, 1, 1, 2, 2, 3, 3}));
  EXPECT_EQ(table.find("parameter")->value, (std::vector<double>{1, 1, 2, 1, 2, 1, 2}));
  EXPECT_EQ(table.find("kind")->labels.size(), 5u);
  const double variance = deviation * deviation;
  const double truth[] = {2 / variance, -std::log((4 / std::numbers::e - 1) / 3) / (2 * variance)};
  const Column& tau = *table.find("tau");
  for (const std::size_t row : {1u, 2u, 5u, 6u}) expect_close(tau, row, truth[(row - 1) % 2]);
  for (const std::size_t row : {3u, 4u}) {
    EXPECT_TRUE(std::isnan(tau.value[row])) << row;
    EXPECT_TRUE(results.text("relaxation_times_" + std::to_string(row)).starts_with("still 1 "));
  }
}

// τ of F_s is 20/q²: 8000 of a run of 10, and 0.0125 between frames 0.1 apart.
TEST(RelaxationTables, SayWhyThereIsNoTime) {
  Configuration2 disks = ellipses(20);
  for (Ellipse& shape : disks.shape) shape = {1, 1};
  MemoryTrajectory2 trajectory = free_brownian(disks, 101, 3);
  const Displacements found = displacements(trajectory, {.wave_numbers = {0.05, 40}});
  Results results;
  store_relaxation_times(found, nullptr, results);
  const Table& table = *results.find("relaxation_times");
  ASSERT_EQ(table.rows(), 2u);
  for (std::size_t row = 0; row < 2; ++row) EXPECT_TRUE(std::isnan(table.find("tau")->value[row]));
  EXPECT_NEAR(table.find("least")->value[0], 5, 1e-12);
  EXPECT_TRUE(std::isnan(table.find("most")->value[0]));
  EXPECT_NEAR(table.find("most")->value[1], 0.1, 1e-12);
  EXPECT_NE(results.text("relaxation_times_0").find("still"), std::string::npos);
  EXPECT_NE(results.text("relaxation_times_1").find("already"), std::string::npos);
}

}  // namespace
}  // namespace vitrel

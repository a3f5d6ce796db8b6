#include "analysis/observables/dynamics_tables.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/free_brownian.h"

namespace vitrel {
namespace {

std::vector<std::string> names(const std::vector<Column>& columns) {
  std::vector<std::string> result;
  for (const Column& column : columns) result.push_back(column.name);
  return result;
}

Results tables_of(Trajectory2& trajectory) {
  const std::vector<double> wave_numbers{2, 4};
  return {dynamics_tables({displacements(trajectory, {.wave_numbers = wave_numbers}),
                           collective_scattering(trajectory, wave_numbers)}),
          {}};
}

using Names = std::vector<std::string>;

TEST(DynamicsTables, HaveTheColumnsThatOthersRelyOn) {
  MemoryTrajectory2 trajectory = free_brownian(ellipses(20), 80, 1);
  const Results results = tables_of(trajectory);
  EXPECT_EQ(names(results.find("displacements_all")->columns),
            (Names{"time", "msd", "msd_parallel", "msd_perpendicular", "quartic", "non_gaussian",
                   "msr", "quartic_rotation", "non_gaussian_rotation", "origins"}));
  EXPECT_EQ(names(results.find("self_scattering_all")->columns), (Names{"time", "fs_1", "fs_2"}));
  EXPECT_EQ(names(results.find("orientation_all")->columns), (Names{"time", "l_2", "l_4"}));
  EXPECT_EQ(names(results.find("susceptibility")->columns), (Names{"time", "overlap", "chi_4"}));
  EXPECT_EQ(names(results.find("collective_scattering")->columns), (Names{"time", "f_1", "f_2"}));
  EXPECT_EQ(names(results.find("wave_numbers")->columns),
            (Names{"index", "q", "q_collective", "modes"}));
  EXPECT_EQ(results.find("wave_numbers")->find("q")->value, (std::vector<double>{2, 4}));
  EXPECT_EQ(results.find("collective_scattering")->find("time")->value.front(), 0);
  for (const Table& table : results.tables)
    for (const Column& column : table.columns) {
      EXPECT_EQ(column.value.size(), table.rows()) << table.name << ' ' << column.name;
      EXPECT_TRUE(column.error.empty() || column.error.size() == table.rows()) << column.name;
    }
}

TEST(DynamicsTables, RoundParticlesHaveNoAnglesAndOneOriginNoSusceptibility) {
  Configuration2 disks = ellipses(5);
  for (Ellipse& shape : disks.shape) shape = {1, 1};
  std::vector<Configuration2> frames(3, disks);
  for (std::size_t k = 0; k < 3; ++k) frames[k].time = static_cast<double>(k * k);
  MemoryTrajectory2 trajectory(std::move(frames));
  const Results results = tables_of(trajectory);
  EXPECT_EQ(names(results.find("displacements_all")->columns),
            (Names{"time", "msd", "quartic", "non_gaussian", "origins"}));
  EXPECT_EQ(results.find("orientation_all"), nullptr);
  EXPECT_EQ(results.find("susceptibility"), nullptr);
}

TEST(DynamicsTables, SayWhichTimesTheyAreOf) {
  MemoryTrajectory2 even = free_brownian(ellipses(1), 81, 1);
  EXPECT_EQ(time_axis_text(even.times(), displacements(even)), "linear, every frame an origin");
  EXPECT_EQ(time_axis_text(even.times(), displacements(even, {.axis = {.max_origins = 10}})),
            "linear, up to 9 origins, evenly thinned");
  // Steps 0, 1, 2, 4, 8 … 64: seven lags, of two origins but for the longest.
  std::vector<Configuration2> frames{even.read(0)};
  for (std::size_t k = 1; k <= 64; k *= 2) frames.push_back(even.read(k));
  MemoryTrajectory2 uneven(std::move(frames));
  EXPECT_EQ(time_axis_text(uneven.times(), displacements(uneven)),
            "unevenly sampled: 7 lags with up to 2 origins");
}

}  // namespace
}  // namespace vitrel

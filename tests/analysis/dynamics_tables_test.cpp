#include "analysis/observables/dynamics_tables.h"

#include <gtest/gtest.h>

#include "tests/support/frames.h"
#include "tests/support/free_brownian.h"
#include "tests/support/tables.h"

namespace vitrel {
namespace {

std::vector<Table> tables_of(Trajectory2& trajectory) {
  const std::vector<double> wave_numbers{2, 4};
  return dynamics_tables({displacements(trajectory, {.wave_numbers = wave_numbers}),
                          collective_scattering(trajectory, wave_numbers)});
}

TEST(DynamicsTables, HaveTheColumnsThatOthersRelyOn) {
  MemoryTrajectory2 trajectory = free_brownian(ellipses(20), 80, 1);
  const std::vector<Table> tables = tables_of(trajectory);
  expect_columns(tables, "displacements_all",
                 {"time", "msd", "msd_parallel", "msd_perpendicular", "quartic", "non_gaussian",
                  "msr", "quartic_rotation", "non_gaussian_rotation", "origins"});
  expect_columns(tables, "self_scattering_all", {"time", "fs_1", "fs_2"});
  expect_columns(tables, "orientation_all", {"time", "l_2", "l_4"});
  expect_columns(tables, "susceptibility", {"time", "overlap", "chi_4"});
  expect_columns(tables, "collective_scattering", {"time", "f_1", "f_2"});
  expect_columns(tables, "wave_numbers", {"index", "q", "q_collective", "modes"});
  EXPECT_EQ(named(tables, "wave_numbers").find("q")->value, (std::vector<double>{2, 4}));
  EXPECT_EQ(named(tables, "collective_scattering").find("time")->value.front(), 0);
  expect_whole_columns(tables);
}

TEST(DynamicsTables, RoundParticlesHaveNoAnglesAndOneOriginNoSusceptibility) {
  Configuration2 disks = ellipses(5);
  for (Ellipse& shape : disks.shape) shape = {1, 1};
  MemoryTrajectory2 trajectory = trajectory_of(
      3, disks, [](Configuration2& c, std::size_t k) { c.time = static_cast<double>(k * k); });
  const std::vector<Table> tables = tables_of(trajectory);
  expect_columns(tables, "displacements_all",
                 {"time", "msd", "quartic", "non_gaussian", "origins"});
  EXPECT_THROW(named(tables, "orientation_all"), std::out_of_range);
  EXPECT_THROW(named(tables, "susceptibility"), std::out_of_range);
}

TEST(DynamicsTables, SayWhichTimesTheyAreOf) {
  MemoryTrajectory2 even = free_brownian(ellipses(1), 81, 1);
  EXPECT_EQ(time_axis_text(even.times(), displacements(even)), "linear, every frame an origin");
  EXPECT_EQ(time_axis_text(even.times(), displacements(even, {.axis = {.max_origins = 10}})),
            "linear, up to 9 origins, evenly thinned");
  // Steps 0, 1, 2, 4, 8 … 64: seven lags, of two origins but for the longest.
  MemoryTrajectory2 uneven = chosen_frames<2>(even, {0, 1, 2, 4, 8, 16, 32, 64});
  EXPECT_EQ(time_axis_text(uneven.times(), displacements(uneven)),
            "unevenly sampled: 7 lags with up to 2 origins");
}

}  // namespace
}  // namespace vitrel

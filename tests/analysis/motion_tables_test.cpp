#include "analysis/observables/motion_tables.h"

#include <gtest/gtest.h>

#include "analysis/dynamics/four_point.h"
#include "analysis/dynamics/van_hove.h"
#include "tests/support/frames.h"
#include "tests/support/free_brownian.h"
#include "tests/support/tables.h"

namespace vitrel {
namespace {

/// The motion in 25 frames, with lags of one, two and three steps.
RunMotion motion_of(MemoryTrajectory2& trajectory) {
  const Configuration2 first = trajectory.read(0);
  const std::vector<Lag> lags = few_lags_of_motion(trajectory, {});
  return {.velocities = velocity_correlations(trajectory),
          .viscosity = shear_viscosity(trajectory.times(),
                                       {std::vector<double>(trajectory.frames())}, {1, 1, 1}),
          .lags = lags,
          .two_times = average_two_times<2>(
              trajectory, lags,
              {van_hove_self<2>({}), van_hove_distinct(first, lags, PairCorrelationOptions{}),
               four_point_structure(first.box, 0.3)})};
}

MemoryTrajectory2 few_frames() {
  Configuration2 start = ellipses(20);
  Stream draw(1, Purpose::tests);
  redraw_velocities(start, draw);
  return free_brownian(start, 25, 1);
}

TEST(MotionTables, HaveTheColumnsThatOthersRelyOn) {
  MemoryTrajectory2 trajectory = few_frames();
  const std::vector<Table> tables = motion_tables(motion_of(trajectory));
  expect_columns(tables, "velocity_autocorrelation", {"time", "c", "c_angular", "origins"});
  expect_columns(tables, "velocity_spectrum", {"frequency", "g", "g_angular"});
  expect_columns(tables, "viscosity", {"time", "moment", "origins"});
  EXPECT_EQ(named(tables, "viscosity").find("moment")->unit, "kT time^2/length^2");
  expect_columns(tables, "lag_times", {"index", "time", "origins"});
  expect_columns(tables, "van_hove_self", {"r", "density_1", "density_2", "density_3"});
  expect_columns(tables, "van_hove_distinct", {"r", "g_1", "g_2", "g_3"});
  expect_columns(tables, "four_point_structure", {"q", "s4_1", "s4_2", "s4_3"});
  EXPECT_EQ(named(tables, "lag_times").find("index")->value, (std::vector<double>{1, 2, 3}));
  EXPECT_NEAR(named(tables, "lag_times").find("time")->value[2], 3 * brownian_step, 1e-12);
  expect_whole_columns(tables);
}

TEST(MotionTables, WithoutVelocitiesOrEvenTimesSomeAreAbsent) {
  MemoryTrajectory2 even = few_frames();
  MemoryTrajectory2 uneven = chosen_frames<2>(even, {0, 1, 2, 4});
  RunMotion motion = motion_of(uneven);
  EXPECT_TRUE(Results({motion_tables(motion), {}}).find("velocity_autocorrelation"));
  EXPECT_FALSE(Results({motion_tables(motion), {}}).find("velocity_spectrum"));
  motion.velocities = {};
  EXPECT_FALSE(Results({motion_tables(motion), {}}).find("velocity_autocorrelation"));
  EXPECT_TRUE(Results({motion_tables(motion), {}}).find("van_hove_self"));
}

}  // namespace
}  // namespace vitrel

#include "analysis/observables/motion_tables.h"

#include <gtest/gtest.h>

#include <string>

#include "analysis/dynamics/four_point.h"
#include "analysis/dynamics/van_hove.h"
#include "tests/support/free_brownian.h"

namespace vitrel {
namespace {

using Names = std::vector<std::string>;

Names names(const std::vector<Column>& columns) {
  Names result;
  for (const Column& column : columns) result.push_back(column.name);
  return result;
}

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
  const RunMotion motion = motion_of(trajectory);
  const Results results{motion_tables(motion), {}};
  EXPECT_EQ(names(results.find("velocity_autocorrelation")->columns),
            (Names{"time", "c", "c_angular", "origins"}));
  EXPECT_EQ(names(results.find("velocity_spectrum")->columns),
            (Names{"frequency", "g", "g_angular"}));
  EXPECT_EQ(names(results.find("viscosity")->columns), (Names{"time", "moment", "origins"}));
  EXPECT_EQ(results.find("viscosity")->find("moment")->unit, "kT time^2/length^2");
  EXPECT_EQ(names(results.find("lag_times")->columns), (Names{"index", "time", "origins"}));
  EXPECT_EQ(names(results.find("van_hove_self")->columns),
            (Names{"r", "density_1", "density_2", "density_3"}));
  EXPECT_EQ(names(results.find("van_hove_distinct")->columns), (Names{"r", "g_1", "g_2", "g_3"}));
  EXPECT_EQ(names(results.find("four_point_structure")->columns),
            (Names{"q", "s4_1", "s4_2", "s4_3"}));
  EXPECT_EQ(results.find("lag_times")->find("index")->value, (std::vector<double>{1, 2, 3}));
  EXPECT_NEAR(results.find("lag_times")->find("time")->value[2], 3 * brownian_step, 1e-12);
  for (const Table& table : results.tables)
    for (const Column& column : table.columns) {
      EXPECT_EQ(column.value.size(), table.rows()) << table.name << ' ' << column.name;
      EXPECT_TRUE(column.error.empty() || column.error.size() == table.rows()) << column.name;
    }
}

TEST(MotionTables, WithoutVelocitiesOrEvenTimesSomeAreAbsent) {
  MemoryTrajectory2 even = few_frames();
  MemoryTrajectory2 uneven({even.read(0), even.read(1), even.read(2), even.read(4)});
  RunMotion motion = motion_of(uneven);
  EXPECT_TRUE(Results({motion_tables(motion), {}}).find("velocity_autocorrelation"));
  EXPECT_FALSE(Results({motion_tables(motion), {}}).find("velocity_spectrum"));
  motion.velocities = {};
  EXPECT_FALSE(Results({motion_tables(motion), {}}).find("velocity_autocorrelation"));
  EXPECT_TRUE(Results({motion_tables(motion), {}}).find("van_hove_self"));
}

}  // namespace
}  // namespace vitrel

#include "app/workflow/glass_data.h"

#include <gtest/gtest.h>

#include "tests/support/free_brownian.h"

namespace vitrel {
namespace {

// Two passes over 30 particles, together one piece of work.
TEST(GlassRunData, TellsOfBothHalvesAsOne) {
  MemoryTrajectory trajectory = free_brownian(ellipses(30), 80, 1);
  const Displacements found = displacements(trajectory);
  const Table order{"order", "", {{"nematic", "1", {0.1}, {}}, {"hexatic", "1", {0.1}, {}}}};
  const CompressibilitySeries no_pressure{};
  std::vector<Progress> told;
  const DiffusionCoefficient diffusion{1, 0.1, 2, 3, ""}, rotational_diffusion{4, 0.4, 5, 6, ""};
  const GlassSource run{
      "run", 1, 0.5, 30, found, no_pressure, order, diffusion, rotational_diffusion};
  const auto data = glass_run_data(trajectory, run, {},
                                   [&](const Progress& progress) { told.push_back(progress); });
  ASSERT_TRUE(data);
  EXPECT_EQ(data->diffusion.value, 1);
  EXPECT_EQ(data->rotational_diffusion.value, 4);
  EXPECT_EQ(data->halves.size(), 2u);
  ASSERT_FALSE(told.empty());
  for (std::size_t k = 0; k < told.size(); ++k) {
    EXPECT_NEAR(told[k].value, 60 * told[k].fraction, 1e-12);
    EXPECT_TRUE(k == 0 || told[k].fraction >= told[k - 1].fraction);
  }
  EXPECT_LT(told.front().fraction, 0.1);
  EXPECT_GT(told.back().fraction, 0.8);
  EXPECT_LE(told.back().fraction, 1);
}

}  // namespace
}  // namespace vitrel

#include "analysis/dynamics/ageing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/observables/dynamics_tables.h"
#include "analysis/structure/order.h"
#include "core/error.h"
#include "tests/support/frames.h"
#include "tests/support/free_brownian.h"
#include "tests/support/walking_solids.h"

namespace vitrel {
namespace {

constexpr std::size_t particles = 400;

/// Free until frame 40, and at rest from there to frame 80.
MemoryTrajectory2 arrested() {
  MemoryTrajectory2 free = free_brownian(ellipses(particles), 41, 3);
  return trajectory_of(81, free.read(0), [&](Configuration2& c, std::size_t k) {
    if (k <= 40) c = free.read(k);
    c.time = brownian_step * static_cast<double>(k);
  });
}

// Mean squares scatter by √2 of themselves, of one angle or, per particle, of two coordinates by 1.
TEST(Ageing, IsThatOfOneFrameAfterEveryWaitingTime) {
  MemoryTrajectory2 trajectory = arrested();
  const auto aged = ageing<2>(trajectory, {.wave_numbers = {2, 3}, .waiting_times = {0, 2, 4.05}});
  ASSERT_EQ(aged.size(), 3u);
  EXPECT_EQ(aged[0].waiting_time, 0);
  EXPECT_DOUBLE_EQ(aged[1].waiting_time, 2);
  EXPECT_DOUBLE_EQ(aged[2].waiting_time, 4.1) << "the next frame";
  const double inertia = ellipses(1).inertia(0), error = std::sqrt(2. / particles);
  for (const std::size_t k : {0, 1}) {
    const Displacements& found = aged[k].motion;
    const DisplacementGroup& all = found.groups.front();
    const double moving = k == 0 ? 4 : 2;
    for (std::size_t l = 0; l < found.lag.size(); ++l) {
      const double time = std::min(found.lag[l], moving);
      EXPECT_EQ(found.origins[l], 1u);
      EXPECT_NEAR(all.translation.value[l], free_msd(time), 4 * error * free_msd(time));
      EXPECT_NEAR(all.rotation.value[l], free_msr(time, inertia),
                  4 * error * free_msr(time, inertia));
    }
    EXPECT_NEAR(found.lag.back(), 8 - aged[k].waiting_time, 0.05 * found.lag.back());
  }
  for (const double msd : aged[2].motion.groups.front().translation.value) EXPECT_EQ(msd, 0);
  EXPECT_EQ(aged[1].motion.wave_numbers, std::vector<double>{2});
  EXPECT_EQ(aged[1].motion.orders, std::vector<double>{2});
}

TEST(Ageing, HasTheNematicLengthOfEachFrame) {
  MemoryTrajectory2 trajectory = arrested();
  const auto aged = ageing<2>(trajectory, {.waiting_times = {0, 2}});
  EXPECT_EQ(aged[1].nematic_length,
            correlation_length(nematic_correlation(trajectory.read(20), 0.5)));
  MemoryTrajectory3 solids = walkers(10, 20, {2, 1, 1}, 0.3, 1);
  EXPECT_TRUE(std::isnan(ageing<3>(solids, {.waiting_times = {0}})[0].nematic_length));
}

TEST(Ageing, NeedsALaterFrame) {
  MemoryTrajectory2 trajectory = arrested();
  EXPECT_NO_THROW(ageing<2>(trajectory, {.waiting_times = {7.9}}));
  EXPECT_THROW(ageing<2>(trajectory, {.waiting_times = {8}}), UserError);
}

TEST(Ageing, StandsInOneTableWithAColumnForEveryWaitingTime) {
  MemoryTrajectory2 trajectory = arrested();
  const std::vector<double> wave_numbers{2};
  RunDynamics dynamics{displacements(trajectory), collective_scattering(trajectory, wave_numbers)};
  dynamics.ageing = ageing<2>(trajectory, {.waiting_times = {0, 2, 4}});
  const Results results{dynamics_tables(dynamics), {}};
  const Table& table = *results.find("ageing");
  const Displacements& second = dynamics.ageing[1].motion;
  for (const char* name : {"msd_2", "msr_2", "fs_2", "l_2", "l_3"})
    EXPECT_TRUE(table.find(name)) << name;
  const std::vector<double>& times = table.find("time")->value;
  std::size_t known = 0;
  for (std::size_t row = 0; row < times.size(); ++row) {
    EXPECT_TRUE(row == 0 || times[row] > times[row - 1]);
    const double msd = table.find("msd_2")->value[row];
    if (std::isnan(msd)) continue;
    EXPECT_NEAR(times[row], second.lag[known], 1e-12);
    EXPECT_EQ(msd, second.groups.front().translation.value[known++]);
  }
  EXPECT_EQ(known, second.lag.size());
  EXPECT_EQ(results.find("waiting_times")->find("index")->value, (std::vector<double>{1, 2, 3}));
}

}  // namespace
}  // namespace vitrel

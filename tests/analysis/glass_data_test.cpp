#include "analysis/glass/glass_data.h"

#include <gtest/gtest.h>

#include "analysis/dynamics/director_frame.h"
#include "tests/support/free_brownian.h"

namespace vitrel {
namespace {

const DiffusionCoefficient diffusion{1, 0.1, 2, 3, ""}, rotational_diffusion{4, 0.4, 5, 6, ""};

/// What is known of the run of 30 particles whose nematic order is said to be S, and what is told
/// meanwhile.
struct Told {
  Told(MemoryTrajectory2& trajectory, double order, const CageRelative* cage = nullptr) {
    const Displacements found = displacements(trajectory);
    const OrderSeries orders{{order}, {0.1}};
    const GlassSource run{
        "run", 1, 0.5, 30, false, found, cage, {}, orders, diffusion, rotational_diffusion};
    data = glass_run_data(trajectory, run, {},
                          [&](const Progress& progress) { progresses.push_back(progress); });
  }

  std::optional<GlassRunData> data;
  std::vector<Progress> progresses;
};

/// So many passes over 30 particles, together one piece of work.
void expect_one_piece(const std::vector<Progress>& told, int passes) {
  ASSERT_FALSE(told.empty());
  for (std::size_t k = 0; k < told.size(); ++k) {
    EXPECT_NEAR(told[k].value, 30 * passes * told[k].fraction, 1e-12);
    EXPECT_TRUE(k == 0 || told[k].fraction >= told[k - 1].fraction);
  }
  EXPECT_LT(told.front().fraction, 0.1);
  EXPECT_GT(told.back().fraction, 0.8);
  EXPECT_LE(told.back().fraction, 1);
}

TEST(GlassRunData, NeedsNoPassOfItsOwn) {
  MemoryTrajectory2 trajectory = free_brownian(ellipses(30), 80, 1);
  const auto [data, told] = Told(trajectory, 0.1);
  ASSERT_TRUE(data);
  EXPECT_EQ(data->halves.size(), 2u);
  EXPECT_EQ(data->diffusion.value, diffusion.value);
  EXPECT_EQ(data->rotational_diffusion.value, rotational_diffusion.value);
  EXPECT_EQ(data->orientation.value,
            displacements(trajectory).groups.front().orientation.front().value);
  EXPECT_TRUE(told.empty());
}

TEST(GlassRunData, InThePlaneTranslationIsRelativeToTheCage) {
  MemoryTrajectory2 trajectory = free_brownian(ellipses(30), 80, 1);
  const auto cage = cage_relative(trajectory);
  const auto [data, told] = Told(trajectory, 0.1, &*cage);
  EXPECT_TRUE(data->relative_to_cage);
  EXPECT_EQ(data->scattering.value, cage->self_scattering.front().value);
}

TEST(GlassRunData, OfANematicThereIsOneFromTheDirector) {
  MemoryTrajectory2 trajectory = free_brownian(ellipses(30), 80, 1);
  const auto [data, told] = Told(trajectory, 0.9);
  ASSERT_TRUE(data);
  DirectorFrame<2> seen(trajectory);
  EXPECT_EQ(data->orientation.value, displacements(seen).groups.front().orientation.front().value);
  expect_one_piece(told, 1);
}

}  // namespace
}  // namespace vitrel

#include "app/workflow/prepare.h"

#include <gtest/gtest.h>

#include <numbers>

#include "analysis/order.h"
#include "core/error.h"
#include "core/state/check.h"

namespace vitrel {
namespace {

const auto say_nothing = [](const std::string&) {};

Parameters small(double packing_fraction) {
  Parameters parameters;
  parameters.system.particles = 49;
  parameters.system.packing_fraction = packing_fraction;
  return parameters;
}

PrepareStage stage(PrepareStage::Method method) {
  PrepareStage result;
  result.method = method;
  return result;
}

TEST(Prepare, StagesInARowReachThePackingFractionWithoutOverlap) {
  Parameters parameters = small(0.6);
  parameters.stages.push_back(stage(PrepareStage::Method::sample));
  parameters.stages.back().sweeps = 50;
  std::vector<std::string> announced;
  const Preparation result =
      prepare(parameters, {}, [&](const std::string& line) { announced.push_back(line); });
  EXPECT_EQ(result.report.end, StageEnd::reached);
  EXPECT_NEAR(packing_fraction(result.configuration), 0.6, 1e-12);
  EXPECT_TRUE(exact_check(result.configuration).clean());
  EXPECT_EQ(announced.size(), 3u);
  // The last stage alone makes 50 sweeps of 49 trials.
  EXPECT_GE(result.report.translations_tried + result.report.rotations_tried, 50u * 49u);
}

TEST(Prepare, TheSeedDecidesEveryBit) {
  const auto positions = [](std::uint64_t seed) {
    Parameters parameters = small(0.5);
    parameters.system.seed = seed;
    return prepare(parameters, {}, say_nothing).configuration.position;
  };
  EXPECT_EQ(positions(3), positions(3));
  EXPECT_NE(positions(3), positions(4));
}

// Enough particles for domains of several colours.
TEST(Prepare, ThreadsChangeNothing) {
  Parameters parameters = small(0.5);
  parameters.system.particles = 400;
  const Preparation one = prepare(parameters, {}, say_nothing);
  const Preparation two = prepare(parameters, {}, say_nothing, 2);
  EXPECT_EQ(one.configuration.position, two.configuration.position);
  EXPECT_EQ(one.configuration.angle, two.configuration.angle);
  EXPECT_EQ(one.report.translations_accepted, two.report.translations_accepted);
}

TEST(Prepare, ALatticeHasAllParticlesAtItsAngle) {
  Parameters parameters = small(0.5);
  parameters.stages = {stage(PrepareStage::Method::lattice)};
  parameters.stages[0].lattice.angle = std::numbers::pi / 4;
  const Preparation result = prepare(parameters, {}, say_nothing);
  EXPECT_NEAR(nematic_order(result.configuration), 1, 1e-14);
  for (const double angle : result.configuration.angle) EXPECT_EQ(angle, std::numbers::pi / 4);
}

PrepareStage growth(std::optional<double> packing_fraction, std::optional<double> pressure) {
  PrepareStage result = stage(PrepareStage::Method::grow);
  result.packing_fraction = packing_fraction;
  result.reduced_pressure = pressure;
  result.growth_rate = 0.02;
  return result;
}

TEST(Prepare, GrowsToThePackingFractionOfTheSystem) {
  Parameters parameters = small(0.7);
  parameters.stages[1] = growth({}, {});
  validate(parameters);
  const Preparation result = prepare(parameters, {}, say_nothing);
  EXPECT_NEAR(packing_fraction(result.configuration), 0.7, 1e-12);
  ASSERT_EQ(result.growth.size(), 1u);
  EXPECT_GT(result.growth[0].counters.collisions, 0u);
  EXPECT_EQ(mechanics(result.configuration).translational_energy, 0);
  EXPECT_EQ(mechanics(result.configuration).rotational_energy, 0);
}

// Beyond the packing fraction of the system, which such a preparation does not end at.
TEST(Prepare, GrowsToAPressureStageByStage) {
  Parameters parameters = small(0.5);
  parameters.stages[1] = growth({}, 1e2);
  parameters.stages.push_back(growth({}, 1e3));
  validate(parameters);
  std::vector<std::string> announced;
  const Preparation result =
      prepare(parameters, {}, [&](const std::string& line) { announced.push_back(line); });
  EXPECT_EQ(announced.back(), "grow to reduced pressure 1000");
  ASSERT_EQ(result.growth.size(), 2u);
  EXPECT_GE(result.growth[0].reduced_pressure, 1e2);
  EXPECT_GE(result.growth[1].reduced_pressure, 1e3);
  EXPECT_GT(result.growth[1].packing_fraction, result.growth[0].packing_fraction);
  EXPECT_EQ(result.growth[1].packing_fraction, packing_fraction(result.configuration));
  EXPECT_GT(packing_fraction(result.configuration), 0.75);
}

TEST(Prepare, GrowthBeyondJammingIsTheUsersToChange) {
  Parameters parameters = small(0.9);
  parameters.stages[1] = growth(0.9, {});
  parameters.stages[1].growth_rate = 0.1;
  EXPECT_THROW(prepare(parameters, {}, say_nothing), UserError);
}

TEST(Prepare, AnUnreachableGoalIsTheUsersToChange) {
  Parameters parameters = small(0.88);
  parameters.stages[1].most_sweeps = 20;
  EXPECT_THROW(prepare(parameters, {}, say_nothing), UserError);
}

TEST(Prepare, TheBudgetStopsIt) {
  Parameters parameters = small(0.7);
  Budget budget;
  budget.should_stop = [] { return true; };
  EXPECT_EQ(prepare(parameters, budget, say_nothing).report.end, StageEnd::stopped);
}

}  // namespace
}  // namespace vitrel

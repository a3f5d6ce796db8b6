#include "workflow/prepare/prepare.h"

#include <numbers>

#include "analysis/structure/order.h"
#include "core/error.h"
#include "core/io/h5md.h"
#include "core/state/check.h"
#include "tests/app/end_to_end.h"
#include "tests/support/preparations.h"

namespace vitrel {
namespace {

TEST(Prepare, StagesInARowReachThePackingFractionWithoutOverlap) {
  Parameters parameters = inserted_and_swollen(0.6);
  SampleStage sampling;
  sampling.sweeps = 50;
  parameters.stages.push_back(sampling);
  std::vector<std::string> announced;
  const Preparation result =
      prepare({parameters}, {}, [&](const std::string& line) { announced.push_back(line); });
  EXPECT_TRUE(result.complete);
  EXPECT_NEAR(packing_fraction(result.configuration), 0.6, 1e-12);
  EXPECT_TRUE(exact_check(result.configuration).clean());
  EXPECT_EQ(announced.size(), 6u);
  EXPECT_EQ(announced[5], "  all sweeps were completed; packing fraction 0.6");
  ASSERT_EQ(result.stages.size(), 3u);
  EXPECT_EQ(result.stages[0].sweeps, 0u);
  EXPECT_GT(result.stages[1].sweeps, 0u);
  EXPECT_EQ(result.stages[2].sweeps, 50u);
  EXPECT_GT(result.stages[2].chain_contacts, 1000u);
  EXPECT_EQ(result.next_sweep, result.stages[1].sweeps + 50);
  EXPECT_EQ(result.trials().tried(),
            result.stages[1].trials.tried() + result.stages[2].trials.tried());
}

TEST(Prepare, TheSeedDecidesEveryBit) {
  const auto positions = [](std::uint64_t seed) {
    Parameters parameters = inserted_and_swollen(0.5);
    parameters.system.seed = seed;
    return prepared(parameters).configuration.position;
  };
  EXPECT_EQ(positions(3), positions(3));
  EXPECT_NE(positions(3), positions(4));
}

// Enough particles for domains of several colours.
TEST(Prepare, ThreadsChangeNothing) {
  Parameters parameters = inserted_and_swollen(0.5);
  parameters.system.particles = 400;
  const Preparation one = prepared(parameters);
  const Preparation two = prepare({.parameters = parameters, .threads = 2}, {}, say_nothing);
  EXPECT_EQ(one.configuration.position, two.configuration.position);
  EXPECT_EQ(one.configuration.angle, two.configuration.angle);
  EXPECT_EQ(one.trials().translations_accepted, two.trials().translations_accepted);
}

TEST(Prepare, ALatticeHasAllParticlesAtItsAngle) {
  Parameters parameters = inserted_and_swollen(0.5);
  LatticeStage lattice;
  lattice.angle = std::numbers::pi / 4;
  parameters.stages = {lattice};
  const Preparation result = prepared(parameters);
  EXPECT_NEAR(nematic_order(result.configuration), 1, 1e-14);
  for (const double angle : result.configuration.angle) EXPECT_EQ(angle, std::numbers::pi / 4);
}

// The box of a lattice with a packing fraction of its own is that of later stages, too.
TEST(Prepare, ALatticeMayHaveAPackingFractionOfItsOwn) {
  Parameters parameters = inserted_and_swollen(0.5);
  LatticeStage lattice;
  lattice.packing_fraction = 0.2;
  parameters.stages[0] = lattice;
  const Preparation result = prepared_if_valid(parameters);
  ASSERT_EQ(result.stages.size(), 2u);
  EXPECT_NEAR(result.stages[0].packing_fraction, 0.2, 1e-12);
  EXPECT_NEAR(packing_fraction(result.configuration), 0.5, 1e-12);
  EXPECT_TRUE(exact_check(result.configuration).clean());
}

GrowStage growth(double growth_rate = 0.02, std::optional<double> pressure = {}) {
  GrowStage result;
  result.reduced_pressure = pressure;
  result.growth_rate = growth_rate;
  return result;
}

TEST(Prepare, GrowsToThePackingFractionOfTheSystem) {
  Parameters parameters = inserted_and_swollen(0.7);
  parameters.stages[1] = growth();
  const Preparation result = prepared_if_valid(parameters);
  EXPECT_NEAR(packing_fraction(result.configuration), 0.7, 1e-12);
  ASSERT_EQ(result.stages.size(), 2u);
  EXPECT_GT(result.stages[1].growth.counters.collisions, 0u);
  EXPECT_EQ(mechanics(result.configuration).translational_energy, 0);
  EXPECT_EQ(mechanics(result.configuration).rotational_energy, 0);
}

// Face-centred cubic spheres reach π/√18 = 0.7405 without leaving their sites.
TEST(Prepare, ACrystalOfSpheresGrowsToItsDensestPacking) {
  Parameters parameters;
  parameters.system.dimension = 3;
  parameters.system.particles = 108;
  parameters.system.packing_fraction = 0.74;
  parameters.species[0].aspect_ratio = Distribution{.mean = 1};
  LatticeStage lattice;
  lattice.packing_fraction = 0.6;
  lattice.arrangement = Arrangement::face_centred;
  parameters.stages = {lattice, growth()};
  const Preparation result = prepared_if_valid<3>(parameters);
  EXPECT_NEAR(packing_fraction(result.configuration), 0.74, 1e-12);
  EXPECT_TRUE(exact_check(result.configuration).clean());
}

// Beyond the packing fraction of the system, which such a preparation does not end at.
TEST(Prepare, GrowsToAPressureStageByStage) {
  Parameters parameters = inserted_and_swollen(0.5);
  parameters.stages[1] = growth(0.02, 1e2);
  parameters.stages.push_back(growth(0.02, 1e3));
  validate(parameters);
  std::vector<std::string> announced;
  const Preparation result =
      prepare({parameters}, {}, [&](const std::string& line) { announced.push_back(line); });
  EXPECT_EQ(announced[announced.size() - 2], "grow to reduced pressure 1000");
  ASSERT_EQ(result.stages.size(), 3u);
  const StageRecord &first = result.stages[1], &second = result.stages[2];
  EXPECT_GE(first.growth.reduced_pressure, 1e2);
  EXPECT_GE(second.growth.reduced_pressure, 1e3);
  EXPECT_GT(second.packing_fraction, first.packing_fraction);
  EXPECT_EQ(second.packing_fraction, packing_fraction(result.configuration));
  EXPECT_GT(packing_fraction(result.configuration), 0.75);
}

TEST(Prepare, GrowthBeyondJammingIsTheUsersToChange) {
  Parameters parameters = inserted_and_swollen(0.9);
  GrowStage fast = growth(0.1);
  fast.packing_fraction = 0.9;
  parameters.stages[1] = fast;
  EXPECT_THROW(prepared(parameters), UserError);
}

// Known long before the gaps have vanished, and with the rate halved again and again.
TEST(Prepare, AGoalBeyondJammingIsRecognisedAsSoonAsTheDensityStalls) {
  Parameters parameters = inserted_and_swollen(0.95);
  parameters.species[0].aspect_ratio = Distribution{.mean = 3};
  parameters.species[0].size = Distribution{
      .kind = Distribution::Kind::gaussian, .mean = 1, .standard_deviation = 0.1, .minimum = 0.5};
  GrowStage stage = growth();
  stage.retries = 2;
  parameters.stages[1] = stage;
  validate(parameters);
  try {
    prepared(parameters);
    ADD_FAILURE();
  } catch (const UserError& error) {
    const std::string message = error.what(), name = "reduced pressure of ";
    EXPECT_THAT(message, HasSubstr("after 2 retries"));
    const double z = std::stod(message.substr(message.find(name) + name.size()));
    EXPECT_GE(z, 1e4);
    EXPECT_LT(z, 1.5e4);
  }
}

/// The same particles, and all lengths a quarter as long.
struct TwoUnits {
  const char* name;
  int dimension;
  double aspect_ratio;
  Stage stage;
};

class UnitOfLength : public testing::TestWithParam<TwoUnits> {};

template <int Dim>
Preparation<Dim> prepared(const TwoUnits& scene, double unit) {
  Parameters parameters = inserted_and_swollen(Dim == 2 ? 0.55 : 0.3);
  parameters.system.dimension = Dim;
  Species& species = parameters.species[0];
  species.aspect_ratio = Distribution{.mean = scene.aspect_ratio};
  species.size = Distribution{
      .kind = Distribution::Kind::uniform, .low = 0.5 * unit, .high = unit, .minimum = 0.5 * unit};
  parameters.stages[1] = scene.stage;
  return prepared_if_valid<Dim>(parameters);
}

template <int Dim>
void expect_scaled(const TwoUnits& scene) {
  const Preparation<Dim> one = prepared<Dim>(scene, 1), quarter = prepared<Dim>(scene, 0.25);
  const Configuration<Dim>&a = one.configuration, &b = quarter.configuration;
  EXPECT_EQ(a.box.lengths(), 4 * b.box.lengths());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a.position[i], 4 * b.position[i]);
    if constexpr (Dim == 2)
      EXPECT_EQ(a.angle[i], b.angle[i]);
    else
      EXPECT_EQ(a.orientation[i].coeffs(), b.orientation[i].coeffs());
  }
  const StageRecord &done = one.stages.back(), &same = quarter.stages.back();
  EXPECT_EQ(done.growth.counters.predictions, same.growth.counters.predictions);
  EXPECT_EQ(done.sweeps, same.sweeps);
}

// Options are relative to the particles, so that the unit of length changes neither the cost nor the state. If two units
// differ by a power of two, the states agree bit by bit.
TEST_P(UnitOfLength, DoesNotMatter) {
  if (GetParam().dimension == 2)
    expect_scaled<2>(GetParam());
  else
    expect_scaled<3>(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Stages, UnitOfLength,
                         testing::Values(TwoUnits{"DisksGrow", 2, 1, growth()},
                                         TwoUnits{"EllipsesGrow", 2, 2, growth()},
                                         TwoUnits{"EllipsesSwell", 2, 2, SwellStage()},
                                         TwoUnits{"EllipsesByBoth", 2, 3, hybrid_stage(0.1, 3)},
                                         TwoUnits{"SpheresGrow", 3, 1, growth()},
                                         TwoUnits{"SpheroidsGrow", 3, 2, growth()},
                                         TwoUnits{"SpheroidsSwell", 3, 2, SwellStage()}),
                         [](const auto& scene) { return scene.param.name; });

// Two disks of a hundred times the size of the others: the rate is that of the many, and neighbours are searched as near
// as they are.
TEST(Prepare, AFewLargeParticlesAmongManyCostLittle) {
  Parameters parameters = inserted_and_swollen(0.6);
  parameters.system.particles = 1000;
  Species& many = parameters.species[0];
  many.aspect_ratio = Distribution{.mean = 1};
  many.fraction = 0.998;
  Species few = many;
  few.name = "few";
  few.fraction = 0.002;
  few.size = Distribution{.mean = 100};
  parameters.species.push_back(few);
  parameters.stages[1] = growth(0.1);
  const Preparation result = prepared_if_valid(parameters);
  EXPECT_TRUE(result.check.clean());
  EXPECT_LT(result.stages[1].growth.counters.collisions, 100u * 1000);
  EXPECT_LT(result.stages[1].growth.counters.predictions, 1000u * 1000);
}

TEST(Prepare, AnUnreachableGoalIsTheUsersToChange) {
  Parameters parameters = inserted_and_swollen(0.88);
  std::get<SwellStage>(parameters.stages[1]).max_sweeps = 20;
  EXPECT_THROW(prepared(parameters), UserError);
}

TEST(Prepare, CompressionAtAPressureTellsItsMeanPackingFraction) {
  Parameters parameters = inserted_and_swollen(0.5);
  CompressStage at_pressure;
  at_pressure.pressure = 1;
  at_pressure.sweeps = 2000;
  parameters.stages[1] = at_pressure;
  const Preparation result = prepared_if_valid(parameters);
  const StageRecord& compression = result.stages[1];
  EXPECT_EQ(compression.sweeps, 2000u);
  EXPECT_GT(compression.mean_packing_fraction.mean, 0.3);
  EXPECT_NEAR(compression.mean_packing_fraction.mean, compression.packing_fraction, 0.1);
}

TEST(Prepare, TheBudgetStopsIt) {
  Parameters parameters = inserted_and_swollen(0.7);
  RunControl control;
  control.should_stop = [] { return true; };
  EXPECT_FALSE(prepare({parameters}, control, say_nothing).complete);
}

TEST(Prepare, AStuckStateIsKept) {
  Parameters parameters = inserted_and_swollen(0.88);
  std::get<SwellStage>(parameters.stages[1]).max_sweeps = 50;
  parameters.output.checkpoint_interval = 0;
  const Folder folder("stuck");
  EXPECT_THROW(prepare({parameters, folder / "state.h5"}, {}, say_nothing), UserError);
  const Configuration2 kept = read_state(folder / "state.h5.stuck.h5");
  EXPECT_FALSE(fs::exists(folder / "state.h5.preparation"));
  EXPECT_GT(packing_fraction(kept), 0.3);
  EXPECT_TRUE(exact_check(kept).clean());
}

}  // namespace
}  // namespace vitrel

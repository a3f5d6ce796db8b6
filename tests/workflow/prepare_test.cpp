#include "workflow/prepare/prepare.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include "analysis/structure/order.h"
#include "core/error.h"
#include "core/io/h5md.h"
#include "core/state/check.h"
#include "tests/app/program.h"

namespace vitrel {
namespace {

using testing_program::Folder;

const auto say_nothing = [](const std::string&) {};

/// Inserted and swollen.
Parameters small(double packing_fraction) {
  Parameters parameters;
  parameters.system.particles = 49;
  parameters.system.packing_fraction = packing_fraction;
  parameters.stages[1] = SwellStage();
  return parameters;
}

TEST(Prepare, StagesInARowReachThePackingFractionWithoutOverlap) {
  Parameters parameters = small(0.6);
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
    Parameters parameters = small(0.5);
    parameters.system.seed = seed;
    return prepare({parameters}, {}, say_nothing).configuration.position;
  };
  EXPECT_EQ(positions(3), positions(3));
  EXPECT_NE(positions(3), positions(4));
}

// Enough particles for domains of several colours.
TEST(Prepare, ThreadsChangeNothing) {
  Parameters parameters = small(0.5);
  parameters.system.particles = 400;
  const Preparation one = prepare({parameters}, {}, say_nothing);
  const Preparation two = prepare({.parameters = parameters, .threads = 2}, {}, say_nothing);
  EXPECT_EQ(one.configuration.position, two.configuration.position);
  EXPECT_EQ(one.configuration.angle, two.configuration.angle);
  EXPECT_EQ(one.trials().translations_accepted, two.trials().translations_accepted);
}

TEST(Prepare, ALatticeHasAllParticlesAtItsAngle) {
  Parameters parameters = small(0.5);
  LatticeStage lattice;
  lattice.angle = std::numbers::pi / 4;
  parameters.stages = {lattice};
  const Preparation result = prepare({parameters}, {}, say_nothing);
  EXPECT_NEAR(nematic_order(result.configuration), 1, 1e-14);
  for (const double angle : result.configuration.angle) EXPECT_EQ(angle, std::numbers::pi / 4);
}

// The box of a lattice with a packing fraction of its own is that of later stages, too.
TEST(Prepare, ALatticeMayHaveAPackingFractionOfItsOwn) {
  Parameters parameters = small(0.5);
  LatticeStage lattice;
  lattice.packing_fraction = 0.2;
  parameters.stages[0] = lattice;
  validate(parameters);
  const Preparation result = prepare({parameters}, {}, say_nothing);
  ASSERT_EQ(result.stages.size(), 2u);
  EXPECT_NEAR(result.stages[0].packing_fraction, 0.2, 1e-12);
  EXPECT_NEAR(packing_fraction(result.configuration), 0.5, 1e-12);
  EXPECT_TRUE(exact_check(result.configuration).clean());
}

GrowStage growth(std::optional<double> packing_fraction, std::optional<double> pressure) {
  GrowStage result;
  result.packing_fraction = packing_fraction;
  result.reduced_pressure = pressure;
  result.growth_rate = 0.02;
  return result;
}

TEST(Prepare, GrowsToThePackingFractionOfTheSystem) {
  Parameters parameters = small(0.7);
  parameters.stages[1] = growth({}, {});
  validate(parameters);
  const Preparation result = prepare({parameters}, {}, say_nothing);
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
  parameters.stages = {lattice, growth({}, {})};
  validate(parameters);
  const Preparation<3> result = prepare<3>({parameters}, {}, say_nothing);
  EXPECT_NEAR(packing_fraction(result.configuration), 0.74, 1e-12);
  EXPECT_TRUE(exact_check(result.configuration).clean());
}

// Beyond the packing fraction of the system, which such a preparation does not end at.
TEST(Prepare, GrowsToAPressureStageByStage) {
  Parameters parameters = small(0.5);
  parameters.stages[1] = growth({}, 1e2);
  parameters.stages.push_back(growth({}, 1e3));
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
  Parameters parameters = small(0.9);
  GrowStage fast = growth(0.9, {});
  fast.growth_rate = 0.1;
  parameters.stages[1] = fast;
  EXPECT_THROW(prepare({parameters}, {}, say_nothing), UserError);
}

// Known long before the gaps have vanished, and with the rate halved again and again.
TEST(Prepare, AGoalBeyondJammingIsRecognisedAsSoonAsTheDensityStalls) {
  Parameters parameters = small(0.95);
  parameters.species[0].aspect_ratio = Distribution{.mean = 3};
  parameters.species[0].size = Distribution{
      .kind = Distribution::Kind::gaussian, .mean = 1, .standard_deviation = 0.1, .minimum = 0.5};
  GrowStage stage = growth({}, {});
  stage.retries = 2;
  parameters.stages[1] = stage;
  validate(parameters);
  try {
    prepare({parameters}, {}, say_nothing);
    ADD_FAILURE();
  } catch (const UserError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("after 2 retries"), std::string::npos) << message;
    const std::string name = "reduced pressure of ";
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
  Parameters parameters = small(Dim == 2 ? 0.55 : 0.3);
  parameters.system.dimension = Dim;
  Species& species = parameters.species[0];
  species.aspect_ratio = Distribution{.mean = scene.aspect_ratio};
  species.size = Distribution{
      .kind = Distribution::Kind::uniform, .low = 0.5 * unit, .high = unit, .minimum = 0.5 * unit};
  parameters.stages[1] = scene.stage;
  validate(parameters);
  return prepare<Dim>({parameters}, {}, say_nothing);
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

HybridStage short_hybrid() {
  HybridStage stage;
  stage.growth_rate = 0.1;
  stage.stretch_sweeps = 3;
  return stage;
}

INSTANTIATE_TEST_SUITE_P(Stages, UnitOfLength,
                         testing::Values(TwoUnits{"DisksGrow", 2, 1, growth({}, {})},
                                         TwoUnits{"EllipsesGrow", 2, 2, growth({}, {})},
                                         TwoUnits{"EllipsesSwell", 2, 2, SwellStage()},
                                         TwoUnits{"EllipsesByBoth", 2, 3, short_hybrid()},
                                         TwoUnits{"SpheresGrow", 3, 1, growth({}, {})},
                                         TwoUnits{"SpheroidsGrow", 3, 2, growth({}, {})},
                                         TwoUnits{"SpheroidsSwell", 3, 2, SwellStage()}),
                         [](const auto& scene) { return scene.param.name; });

// Two disks of a hundred times the size of the others: the rate is that of the many, and neighbours are searched as near
// as they are.
TEST(Prepare, AFewLargeParticlesAmongManyCostLittle) {
  Parameters parameters = small(0.6);
  parameters.system.particles = 1000;
  Species& many = parameters.species[0];
  many.aspect_ratio = Distribution{.mean = 1};
  many.fraction = 0.998;
  Species few = many;
  few.name = "few";
  few.fraction = 0.002;
  few.size = Distribution{.mean = 100};
  parameters.species.push_back(few);
  GrowStage stage = growth({}, {});
  stage.growth_rate = 0.1;
  parameters.stages[1] = stage;
  validate(parameters);
  const Preparation result = prepare({parameters}, {}, say_nothing);
  EXPECT_TRUE(result.check.clean());
  EXPECT_LT(result.stages[1].growth.counters.collisions, 100u * 1000);
  EXPECT_LT(result.stages[1].growth.counters.predictions, 1000u * 1000);
}

TEST(Prepare, AnUnreachableGoalIsTheUsersToChange) {
  Parameters parameters = small(0.88);
  std::get<SwellStage>(parameters.stages[1]).max_sweeps = 20;
  EXPECT_THROW(prepare({parameters}, {}, say_nothing), UserError);
}

TEST(Prepare, CompressionAtAPressureTellsItsMeanPackingFraction) {
  Parameters parameters = small(0.5);
  CompressStage at_pressure;
  at_pressure.pressure = 1;
  at_pressure.sweeps = 2000;
  parameters.stages[1] = at_pressure;
  validate(parameters);
  const Preparation result = prepare({parameters}, {}, say_nothing);
  const StageRecord& compression = result.stages[1];
  EXPECT_EQ(compression.sweeps, 2000u);
  EXPECT_GT(compression.mean_packing_fraction.mean, 0.3);
  EXPECT_NEAR(compression.mean_packing_fraction.mean, compression.packing_fraction, 0.1);
}

TEST(Prepare, TheBudgetStopsIt) {
  Parameters parameters = small(0.7);
  RunControl control;
  control.should_stop = [] { return true; };
  EXPECT_FALSE(prepare({parameters}, control, say_nothing).complete);
}

/// Insertion and this stage.
Parameters with(const Stage& stage) {
  Parameters parameters = small(0.6);
  parameters.stages[1] = stage;
  if (std::holds_alternative<SampleStage>(stage)) parameters.system.packing_fraction = 0.3;
  validate(parameters);
  return parameters;
}

CompressStage compression() {
  CompressStage stage;
  stage.packing_fraction = 0.6;
  stage.pressure = 20;
  return stage;
}

HybridStage by_both(Moves moves) {
  HybridStage stage;
  stage.growth_rate = 0.02;
  stage.stretch_sweeps = 5;
  stage.moves = moves;
  return stage;
}

SampleStage sampling(Moves moves) {
  SampleStage stage;
  stage.moves = moves;
  stage.sweeps = 200;
  return stage;
}

/// The name of a test, and its stage.
using NamedStage = std::pair<std::string, Stage>;

class StoppedPreparation : public testing::TestWithParam<NamedStage> {
 protected:
  const Folder folder_{"stopped_preparation"};
};

// Every process stops a little later than the one before, so that each gets somewhere.
TEST_P(StoppedPreparation, ContinuesBitIdenticalFromItsFile) {
  const Parameters parameters = with(GetParam().second);
  const Preparation whole = prepare({parameters}, {}, say_nothing);
  const PrepareRequest request{parameters, folder_ / "state.h5"};
  std::uint64_t asked = 0, allowed = 10, stops = 0;
  const RunControl control{[&] { return ++asked > allowed; }, {}, {}};
  Preparation parts = prepare(request, control, say_nothing);
  for (; !parts.complete; parts = prepare(request, control, say_nothing)) {
    allowed = 10 + 5 * ++stops;
    asked = 0;
    ASSERT_LT(stops, 1000u);
  }
  EXPECT_GT(stops, 2u);
  EXPECT_EQ(parts.configuration.position, whole.configuration.position);
  EXPECT_EQ(parts.configuration.angle, whole.configuration.angle);
  EXPECT_EQ(parts.configuration.box.lengths(), whole.configuration.box.lengths());
  EXPECT_EQ(parts.next_sweep, whole.next_sweep);
  ASSERT_EQ(parts.stages.size(), whole.stages.size());
  for (std::size_t k = 0; k < whole.stages.size(); ++k) {
    const StageRecord &one = parts.stages[k], &other = whole.stages[k];
    EXPECT_EQ(one.report.reason, other.report.reason);
    EXPECT_EQ(one.packing_fraction, other.packing_fraction);
    EXPECT_EQ(one.trials.tried(), other.trials.tried());
    EXPECT_EQ(one.growth.counters.collisions, other.growth.counters.collisions);
  }
  forget_preparation(request.output);
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

// A checkpoint at every moment at which there may be one, and a copy of one in the middle.
TEST_P(StoppedPreparation, ContinuesBitIdenticalFromAnyCheckpoint) {
  Parameters parameters = with(GetParam().second);
  parameters.output.checkpoint_interval = 0;
  const PrepareRequest request{parameters, folder_ / "state.h5"};
  const std::filesystem::path checkpoint = folder_ / "state.h5.preparation";
  const Preparation whole = prepare({parameters}, {}, say_nothing);
  std::uint64_t reports = 0;
  const RunControl control{{},
                           [&](const Progress&) {
                             reports += std::filesystem::exists(checkpoint);
                             if (reports == 5)
                               std::filesystem::copy_file(checkpoint, folder_ / "copy");
                           },
                           {}};
  prepare(request, control, say_nothing);
  ASSERT_GE(reports, 5u);
  forget_preparation(request.output);
  std::filesystem::rename(folder_ / "copy", checkpoint);
  const Preparation rest = prepare(request, {}, say_nothing);
  EXPECT_EQ(rest.configuration.position, whole.configuration.position);
  EXPECT_EQ(rest.configuration.angle, whole.configuration.angle);
  EXPECT_EQ(rest.trials().tried(), whole.trials().tried());
}

TEST_P(StoppedPreparation, RefusesOtherParameters) {
  Parameters parameters = with(GetParam().second);
  const PrepareRequest request{parameters, folder_ / "state.h5"};
  std::uint64_t asked = 0;
  const std::uint64_t during_insertion = 49;
  prepare(request, {[&] { return ++asked > during_insertion + 15; }, {}, {}}, say_nothing);
  parameters.dynamics.duration = 17;  // of no concern
  parameters.system.seed = 2;
  try {
    prepare({parameters, request.output}, {}, say_nothing);
    FAIL();
  } catch (const UserError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("begun with system.seed = 1, but now it is 2"), std::string::npos)
        << message;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, StoppedPreparation,
                         testing::Values(NamedStage{"swell", SwellStage()},
                                         NamedStage{"compress", compression()},
                                         NamedStage{"grow", GrowStage()},
                                         NamedStage{"hybrid", by_both(Moves::local)},
                                         NamedStage{"hybrid_chains", by_both(Moves::chains)},
                                         NamedStage{"sample", sampling(Moves::local)},
                                         NamedStage{"sample_chains", sampling(Moves::chains)}),
                         [](const auto& at) { return at.param.first; });

/// Ellipsoids of two species, grown to 30 %.
Parameters solids() {
  const auto number = [](double value) {
    return Distribution{Distribution::Kind::constant, value, 0, 0, 0, 0};
  };
  Parameters parameters;
  parameters.system.dimension = 3;
  parameters.system.particles = 40;
  parameters.system.packing_fraction = 0.3;
  parameters.species.assign(2, Species());
  parameters.species[0].aspect_ratios = {number(3), number(1)};
  parameters.species[1].name = "scalene";
  parameters.species[1].semi_axes = {number(2), number(1), number(0.5)};
  for (Species& species : parameters.species) species.fraction = 0.5;
  std::get<GrowStage>(parameters.stages[1]).growth_rate = 0.01;
  validate(parameters);
  return parameters;
}

void expect_same_state(const Preparation<3>& one, const Preparation<3>& other) {
  EXPECT_EQ(one.configuration.position, other.configuration.position);
  for (std::size_t i = 0; i < one.configuration.size(); ++i)
    EXPECT_EQ(one.configuration.orientation[i].coeffs(),
              other.configuration.orientation[i].coeffs());
  EXPECT_EQ(one.configuration.box.lengths(), other.configuration.box.lengths());
  EXPECT_EQ(one.stages.back().growth.counters.collisions,
            other.stages.back().growth.counters.collisions);
}

TEST(PrepareSolids, GrowToThePackingFractionWithoutOverlap) {
  const Preparation<3> result = prepare<3>({solids()}, {}, say_nothing);
  EXPECT_TRUE(result.complete);
  EXPECT_NEAR(packing_fraction(result.configuration), 0.3, 1e-12);
  const Vec3& box = result.configuration.box.lengths();
  EXPECT_TRUE(box.x() == box.y() && box.y() == box.z());
  EXPECT_TRUE(exact_check(result.configuration).clean());
  EXPECT_GT(result.stages[1].growth.counters.collisions, 40u);
  EXPECT_EQ(mechanics(result.configuration).translational_energy, 0);
  EXPECT_EQ(mechanics(result.configuration).rotational_energy, 0);
  expect_same_state(prepare<3>({solids()}, {}, say_nothing), result);
}

TEST(PrepareSolids, StoppedTheyGoOnBitByBit) {
  const Folder folder("stopped_solids");
  const Preparation<3> whole = prepare<3>({solids()}, {}, say_nothing);
  const PrepareRequest request{solids(), folder / "state.h5"};
  std::uint64_t asked = 0, stops = 0;
  const RunControl control{[&] { return ++asked > 50; }, {}, {}};
  Preparation<3> parts = prepare<3>(request, control, say_nothing);
  for (; !parts.complete; parts = prepare<3>(request, control, say_nothing), ++stops) asked = 0;
  EXPECT_GT(stops, 1u);
  expect_same_state(parts, whole);
  // In the other dimension the checkpoint is of no use.
  Parameters flat = small(0.3);
  try {
    prepare({flat, request.output}, {}, say_nothing);
    FAIL();
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find("begun with "), std::string::npos) << error.what();
  }
}

/// Spheres or spheroids, on a crystal or inserted, and one stage of Monte Carlo up to 40 %.
Parameters solids_by(const Stage& stage, double aspect_ratio) {
  Parameters parameters;
  parameters.system.dimension = 3;
  parameters.system.particles = 108;
  parameters.system.packing_fraction = 0.4;
  parameters.system.box_aspect = {1, 1.2};
  parameters.species[0].aspect_ratio = Distribution{.mean = aspect_ratio};
  if (std::holds_alternative<SampleStage>(stage)) {
    LatticeStage lattice;
    lattice.arrangement = Arrangement::face_centred;
    parameters.stages = {lattice, stage};
  } else {
    InsertStage insertion;
    insertion.packing_fraction = 0.2;
    parameters.stages = {insertion, stage};
  }
  validate(parameters);
  return parameters;
}

CompressStage compression_in_space() {
  CompressStage stage;
  stage.packing_fraction = 0.4;
  stage.pressure = 5;
  stage.box = BoxChange::anisotropic;
  return stage;
}

struct SolidsBy {
  std::string name;
  Stage stage;
  double aspect_ratio = 2;
};

class StoppedSolids : public testing::TestWithParam<SolidsBy> {};

// On two threads, each process a little later than the one before, against one process with one thread.
TEST_P(StoppedSolids, ContinueBitIdentical) {
  const Folder folder("stopped_solids");
  const Parameters parameters = solids_by(GetParam().stage, GetParam().aspect_ratio);
  const Preparation<3> whole = prepare<3>({parameters}, {}, say_nothing);
  EXPECT_TRUE(exact_check(whole.configuration).clean());
  EXPECT_NEAR(packing_fraction(whole.configuration), 0.4, 1e-12);
  PrepareRequest request{parameters, folder / "state.h5"};
  request.threads = 2;
  std::uint64_t asked = 0, allowed = 110, stops = 0;
  const RunControl control{[&] { return ++asked > allowed; }, {}, {}};
  Preparation<3> parts = prepare<3>(request, control, say_nothing);
  for (; !parts.complete; parts = prepare<3>(request, control, say_nothing)) {
    allowed = 12 + 5 * ++stops;
    asked = 0;
    ASSERT_LT(stops, 1000u);
  }
  EXPECT_GT(stops, 1u);
  expect_same_state(parts, whole);
  EXPECT_EQ(parts.next_sweep, whole.next_sweep);
  EXPECT_EQ(parts.trials().tried(), whole.trials().tried());
}

INSTANTIATE_TEST_SUITE_P(
    Methods, StoppedSolids,
    testing::Values(SolidsBy{"swell", SwellStage()}, SolidsBy{"swell_spheres", SwellStage(), 1},
                    SolidsBy{"compress", compression_in_space()},
                    SolidsBy{"hybrid", by_both(Moves::local)},
                    SolidsBy{"hybrid_chains", by_both(Moves::chains)},
                    SolidsBy{"sample", sampling(Moves::local)},
                    SolidsBy{"sample_chains", sampling(Moves::chains)},
                    SolidsBy{"sample_chains_spheres", sampling(Moves::chains), 1}),
    [](const auto& at) { return at.param.name; });

TEST(Prepare, AStuckStateIsKept) {
  Parameters parameters = small(0.88);
  std::get<SwellStage>(parameters.stages[1]).max_sweeps = 50;
  parameters.output.checkpoint_interval = 0;
  const Folder folder("stuck");
  EXPECT_THROW(prepare({parameters, folder / "state.h5"}, {}, say_nothing), UserError);
  const Configuration2 kept = read_state(folder / "state.h5.stuck.h5");
  EXPECT_FALSE(std::filesystem::exists(folder / "state.h5.preparation"));
  EXPECT_GT(packing_fraction(kept), 0.3);
  EXPECT_TRUE(exact_check(kept).clean());
}

}  // namespace
}  // namespace vitrel

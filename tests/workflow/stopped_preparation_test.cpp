// Preparations that are stopped and continued give the same state, bit by bit.
#include <functional>

#include "core/error.h"
#include "core/state/check.h"
#include "tests/app/end_to_end.h"
#include "tests/support/preparations.h"

namespace vitrel {
namespace {

/// Insertion and this stage.
Parameters with(const Stage& stage) {
  Parameters parameters = inserted_and_swollen(0.6);
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

SampleStage sampling(Moves moves) {
  SampleStage stage;
  stage.moves = moves;
  stage.sweeps = 200;
  return stage;
}

/// A preparation by several processes. Each stops when its control has been asked more often than
/// `allowed(stops)`, a function of the number of stops before.
template <int Dim>
struct InParts {
  Preparation<Dim> result;
  std::uint64_t stops = 0;

  template <class Allowed>
  InParts(const PrepareRequest& request, Allowed allowed) {
    std::uint64_t asked = 0;
    const RunControl control{[&] { return ++asked > allowed(stops); }, {}, {}};
    while (!(result = prepare<Dim>(request, control, say_nothing)).complete && stops < 1000) {
      ++stops;
      asked = 0;
    }
    EXPECT_LT(stops, 1000u);
  }
};

template <int Dim>
void expect_same_state(const Preparation<Dim>& one, const Preparation<Dim>& other) {
  const Configuration<Dim>&a = one.configuration, &b = other.configuration;
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.box.lengths(), b.box.lengths());
  if constexpr (Dim == 2)
    EXPECT_EQ(a.angle, b.angle);
  else
    for (std::size_t i = 0; i < a.size(); ++i)
      EXPECT_EQ(a.orientation[i].coeffs(), b.orientation[i].coeffs());
  EXPECT_EQ(one.next_sweep, other.next_sweep);
  EXPECT_EQ(one.trials().tried(), other.trials().tried());
  ASSERT_EQ(one.stages.size(), other.stages.size());
  for (std::size_t k = 0; k < one.stages.size(); ++k) {
    const StageRecord &of_one = one.stages[k], &of_other = other.stages[k];
    EXPECT_EQ(of_one.report.reason, of_other.report.reason);
    EXPECT_EQ(of_one.packing_fraction, of_other.packing_fraction);
    EXPECT_EQ(of_one.trials.tried(), of_other.trials.tried());
    EXPECT_EQ(of_one.growth.counters.collisions, of_other.growth.counters.collisions);
  }
}

/// The name of a test, and its stage.
using NamedStage = std::pair<std::string, Stage>;

class StoppedPreparation : public testing::TestWithParam<NamedStage> {
 protected:
  const Folder folder_{"stopped_preparation"};
  const Parameters parameters_ = with(GetParam().second);
  const PrepareRequest request_{parameters_, folder_ / "state.h5"};
};

// Every process stops a little later than the one before, so that each gets somewhere.
TEST_P(StoppedPreparation, ContinuesBitIdenticalFromItsFile) {
  const InParts<2> parts(request_, [](std::uint64_t stops) { return 10 + 5 * stops; });
  EXPECT_GT(parts.stops, 2u);
  expect_same_state(parts.result, prepared(parameters_));
  forget_preparation(request_.output);
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

// A checkpoint at every moment at which there may be one, and a copy of one in the middle.
TEST_P(StoppedPreparation, ContinuesBitIdenticalFromAnyCheckpoint) {
  PrepareRequest request = request_;
  request.parameters.output.checkpoint_interval = 0;
  const fs::path checkpoint = folder_ / "state.h5.preparation";
  std::uint64_t reports = 0;
  const RunControl control{{},
                           [&](const Progress&) {
                             reports += fs::exists(checkpoint);
                             if (reports == 5) fs::copy_file(checkpoint, folder_ / "copy");
                           },
                           {}};
  prepare(request, control, say_nothing);
  ASSERT_GE(reports, 5u);
  forget_preparation(request.output);
  fs::rename(folder_ / "copy", checkpoint);
  expect_same_state(prepare(request, {}, say_nothing), prepared(request.parameters));
}

TEST_P(StoppedPreparation, RefusesOtherParameters) {
  std::uint64_t asked = 0;
  const std::uint64_t during_insertion = 49;
  prepare(request_, {[&] { return ++asked > during_insertion + 15; }, {}, {}}, say_nothing);
  PrepareRequest other = request_;
  other.parameters.dynamics.duration = 17;  // of no concern
  other.parameters.system.seed = 2;
  EXPECT_THAT(
      [&] { prepare(other, {}, say_nothing); },
      testing::ThrowsMessage<UserError>(HasSubstr("begun with system.seed = 1, but now it is 2")));
}

INSTANTIATE_TEST_SUITE_P(
    Methods, StoppedPreparation,
    testing::Values(NamedStage{"swell", SwellStage()}, NamedStage{"compress", compression()},
                    NamedStage{"grow", GrowStage()},
                    NamedStage{"hybrid", hybrid_stage(0.02, 5, Moves::local)},
                    NamedStage{"hybrid_chains", hybrid_stage(0.02, 5, Moves::chains)},
                    NamedStage{"sample", sampling(Moves::local)},
                    NamedStage{"sample_chains", sampling(Moves::chains)}),
    [](const auto& at) { return at.param.first; });

/// Ellipsoids of two species, grown to 30 %.
Parameters solids() {
  const auto number = [](double value) { return Distribution{.mean = value}; };
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

TEST(PrepareSolids, GrowToThePackingFractionWithoutOverlap) {
  const Preparation<3> result = prepared<3>(solids());
  EXPECT_TRUE(result.complete);
  EXPECT_NEAR(packing_fraction(result.configuration), 0.3, 1e-12);
  const Vec3& box = result.configuration.box.lengths();
  EXPECT_TRUE(box.x() == box.y() && box.y() == box.z());
  EXPECT_TRUE(exact_check(result.configuration).clean());
  EXPECT_GT(result.stages[1].growth.counters.collisions, 40u);
  EXPECT_EQ(mechanics(result.configuration).translational_energy, 0);
  EXPECT_EQ(mechanics(result.configuration).rotational_energy, 0);
  expect_same_state(prepared<3>(solids()), result);
}

TEST(PrepareSolids, StoppedTheyGoOnBitByBit) {
  const Folder folder("stopped_solids");
  const PrepareRequest request{solids(), folder / "state.h5"};
  const InParts<3> parts(request, [](std::uint64_t) { return 50u; });
  EXPECT_GT(parts.stops, 1u);
  expect_same_state(parts.result, prepared<3>(solids()));
  // In the other dimension the checkpoint is of no use.
  EXPECT_THAT(
      [&] {
        prepare({inserted_and_swollen(0.3), request.output}, {}, say_nothing);
      },
      testing::ThrowsMessage<UserError>(HasSubstr("begun with ")));
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
  const Preparation<3> whole = prepared<3>(parameters);
  EXPECT_TRUE(exact_check(whole.configuration).clean());
  EXPECT_NEAR(packing_fraction(whole.configuration), 0.4, 1e-12);
  const PrepareRequest request{
      .parameters = parameters, .output = folder / "state.h5", .threads = 2};
  const InParts<3> parts(request,
                         [](std::uint64_t stops) { return stops == 0 ? 110 : 12 + 5 * stops; });
  EXPECT_GT(parts.stops, 1u);
  expect_same_state(parts.result, whole);
}

INSTANTIATE_TEST_SUITE_P(
    Methods, StoppedSolids,
    testing::Values(SolidsBy{"swell", SwellStage()}, SolidsBy{"swell_spheres", SwellStage(), 1},
                    SolidsBy{"compress", compression_in_space()},
                    SolidsBy{"hybrid", hybrid_stage(0.02, 5, Moves::local)},
                    SolidsBy{"hybrid_chains", hybrid_stage(0.02, 5, Moves::chains)},
                    SolidsBy{"sample", sampling(Moves::local)},
                    SolidsBy{"sample_chains", sampling(Moves::chains)},
                    SolidsBy{"sample_chains_spheres", sampling(Moves::chains), 1}),
    [](const auto& at) { return at.param.name; });

}  // namespace
}  // namespace vitrel

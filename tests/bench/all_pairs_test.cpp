// The baseline of the event loop: without calendar, lists and cells, the same collisions.

#include "bench/baselines/all_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/state/check.h"
#include "edmd/brownian.h"
#include "tests/support/equal_bodies.h"
#include "tests/support/same_motion.h"

namespace vitrel::bench {
namespace {

Configuration2 ellipses(int side) {
  return moving(square_lattice(side, 0.5, std::numbers::pi / 4, of_aspect_ratio(2)));
}

void expect_same_motion(const Configuration2& start, Asking asking, double collisions_of_each) {
  const auto fast = make_engine(start, {});
  const auto slow = make_all_pairs_engine({{}, asking, nullptr});
  const SameMotion wanted{
      .collisions_of_each = collisions_of_each,
      .interval = 0.01,
      .largest_difference = 1e-9,
      .virial = 1e-8,
  };
  vitrel::expect_same_motion(start, *fast, *slow, wanted);
}

class AllPairsProgram : public testing::TestWithParam<Asking> {};

TEST_P(AllPairsProgram, OfEllipsesMovesAlike) {
  expect_same_motion(ellipses(5), GetParam(), 10);
}

TEST_P(AllPairsProgram, OfDisksMovesAlike) {
  expect_same_motion(moving(lattice_of_disks(5, 0.5)), GetParam(), 10);
}

TEST_P(AllPairsProgram, OfAMixtureMovesAlike) {
  const auto mixed = [](std::size_t i) { return i % 2 ? Ellipse{1.3, 1.3} : of_aspect_ratio(2); };
  expect_same_motion(moving(square_lattice(5, 0.4, std::numbers::pi / 4, mixed)), GetParam(), 10);
}

// So far apart that the crossing of the box comes long before most collisions.
TEST_P(AllPairsProgram, OfADiluteGasMovesAlike) {
  expect_same_motion(moving(square_lattice(3, 0.05, 0, of_aspect_ratio(3))), GetParam(), 3);
}

TEST_P(AllPairsProgram, StaysHardWithNewVelocities) {
  Configuration2 now = ellipses(5);
  const auto engine = make_all_pairs_engine({{}, GetParam(), nullptr});
  RunCounters counters;
  engine->load(now);
  for (std::uint64_t step = 1; step <= 40; ++step) {
    advance(*engine, now, 0.05 * static_cast<double>(step), counters);
    ASSERT_TRUE(exact_check(now).clean());
    draw_velocities(now, 1, Purpose::brownian_step, step, Temperature::total);
    engine->set_velocities(now, 0.05 * static_cast<double>(step + 1), counters);
  }
  EXPECT_GT(counters.collisions, 50u);
}

// A local optimiser overlooks collisions: the run goes on with correction moves, at the same energy.
TEST_P(AllPairsProgram, WithTheOptimiserOfTheThesisGoesOnWithCorrectionMoves) {
  const std::vector<Method> methods = collision_time_methods();
  const Method& slsqp = *std::ranges::find(methods, "slsqp", &Method::name);
  Configuration2 now = ellipses(4);
  const auto energy = [&] {
    const Mechanics sums = mechanics(now);
    return sums.translational_energy + sums.rotational_energy;
  };
  const double before = energy();
  EngineOptions correcting;
  correcting.on_overlap = OnOverlap::correct;
  const auto engine = make_all_pairs_engine({correcting, GetParam(), &slsqp});
  RunCounters counters;
  engine->load(now);
  advance(*engine, now, 60, counters);
  EXPECT_NEAR(now.time, 60, 1e-12);
  EXPECT_GT(counters.correction_moves, 0u);
  EXPECT_LT(counters.correction_moves, counters.collisions);
  EXPECT_NEAR(energy(), before, 1e-11 * before);
}

TEST(AllPairsPrograms, WithATableAsksForFewer) {
  const Configuration2 start = ellipses(4);
  std::uint64_t predictions[2];
  for (const Asking asking : {Asking::every_pair, Asking::changed_pairs}) {
    Configuration2 now = start;
    const auto engine = make_all_pairs_engine({{}, asking, nullptr});
    RunCounters counters;
    engine->load(now);
    advance(*engine, now, 2, counters);
    predictions[asking == Asking::every_pair] = counters.predictions;
  }
  EXPECT_LT(3 * predictions[0], predictions[1]);
}

TEST(AllPairsPrograms, RefusesABoxWithTwoImagesOfAPair) {
  const auto engine = make_all_pairs_engine({});
  EXPECT_THROW(engine->load(ellipses(2)), UserError);
}

TEST(AllPairsPrograms, RefusesGrowth) {
  EngineOptions growing;
  growing.growth_rate = 0.1;
  const auto engine = make_all_pairs_engine({growing});
  EXPECT_THROW(engine->load(ellipses(4)), UserError);
}

TEST(AllPairsPrograms, StopsAtAnOverlap) {
  Configuration2 now = ellipses(4);
  now.position[1] = now.position[0] + Vec2(0.3, 0);
  const auto engine = make_all_pairs_engine({});
  RunCounters counters;
  engine->load(now);
  EXPECT_THROW(engine->advance(1, counters), InvariantError);
}

INSTANTIATE_TEST_SUITE_P(Asking, AllPairsProgram,
                         testing::Values(Asking::every_pair, Asking::changed_pairs),
                         [](const auto& at) {
                           return at.param == Asking::every_pair ? "every_pair" : "changed_pairs";
                         });

}  // namespace
}  // namespace vitrel::bench

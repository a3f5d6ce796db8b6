// The baseline of the event loop: without calendar, lists and cells, the same collisions.

#include "bench/baselines/all_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/state/check.h"
#include "edmd/brownian.h"
#include "tests/support/motion.h"
#include "tests/support/scenes.h"

namespace vitrel::bench {
namespace {

Configuration2 ellipses(int side) {
  return moving(square_lattice(side, 0.5, std::numbers::pi / 4,
                               [](std::size_t) { return of_aspect_ratio(2); }));
}

// The two engines round differently, and every collision multiplies what they differ by; the same
// collisions in the same order keep them together for a while, a single other one parts them at once.
void expect_same_motion(const Configuration2& start, Asking asking, double collisions_of_each) {
  const auto fast = make_engine(start, {});
  const auto slow = make_all_pairs_engine({{}, asking, nullptr});
  RunCounters of_fast, of_slow;
  Configuration2 one = start, two = start;
  fast->load(start);
  slow->load(start);
  const double wanted = 0.5 * collisions_of_each * static_cast<double>(start.size());
  for (double until = 0.01; static_cast<double>(of_fast.collisions) < wanted; until += 0.01) {
    advance(*fast, one, until, of_fast);
    advance(*slow, two, until, of_slow);
    ASSERT_EQ(of_fast.collisions, of_slow.collisions) << "up to " << until;
    ASSERT_LT(difference(one, two), 1e-9) << "at " << until;
  }
  EXPECT_NEAR(of_slow.virial, of_fast.virial, 1e-8 * std::abs(of_fast.virial));
  EXPECT_EQ(of_slow.correction_moves, 0u);
}

class AllPairsProgram : public testing::TestWithParam<Asking> {};

TEST_P(AllPairsProgram, OfEllipsesMovesAlike) {
  expect_same_motion(ellipses(5), GetParam(), 10);
}

TEST_P(AllPairsProgram, OfDisksMovesAlike) {
  const auto disk = [](std::size_t) { return Ellipse{1, 1}; };
  expect_same_motion(moving(square_lattice(5, 0.5, 0, disk)), GetParam(), 10);
}

TEST_P(AllPairsProgram, OfAMixtureMovesAlike) {
  const auto mixed = [](std::size_t i) { return i % 2 ? Ellipse{1.3, 1.3} : of_aspect_ratio(2); };
  expect_same_motion(moving(square_lattice(5, 0.4, std::numbers::pi / 4, mixed)), GetParam(), 10);
}

// So far apart that the crossing of the box comes long before most collisions.
TEST_P(AllPairsProgram, OfADiluteGasMovesAlike) {
  const auto shape = [](std::size_t) { return of_aspect_ratio(3); };
  expect_same_motion(moving(square_lattice(3, 0.05, 0, shape)), GetParam(), 3);
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

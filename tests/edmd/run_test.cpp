#include "edmd/run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/contact/ellipse_gap.h"
#include "core/error.h"
#include "tests/support/equal_bodies.h"
#include "tests/support/motion.h"
#include "tests/support/runs.h"
#include "tests/support/same_state.h"

namespace vitrel {
namespace {

Configuration2 thesis_scene() {
  return moving(square_lattice(10, 0.5, std::numbers::pi / 4, of_aspect_ratio(2)));
}

double smallest_gap(const Configuration2& c) {
  double smallest = 1e300;
  for (std::size_t i = 0; i < c.size(); ++i)
    for (std::size_t j = i; j < c.size(); ++j)
      c.box.for_each_image(
          c.position[j] - c.position[i], c.shape[i].a + c.shape[j].a + 1,
          [&](const Shift<2>& shift, const Vec2& d) {
            if (i == j && shift.isZero()) return;
            smallest = std::min(smallest,
                                support_gap(c.shape[i], c.angle[i], c.shape[j], c.angle[j], d).gap);
          });
  return smallest;
}

RunPlan2 plan_until(double end, Observer<2>* observer = nullptr) {
  return {linear_times(0.5, end), end, observer, {}};
}

void expect_hard_and_conserving(const Configuration2& start, double end) {
  RunState2 state = begin_run(start, 0);
  Recorder recorder;
  const StageReport report = run(state, {}, plan_until(end, &recorder), {});
  EXPECT_EQ(report.end, StageEnd::reached);
  EXPECT_EQ(state.configuration.time, end);
  EXPECT_GT(state.counters.collisions, 10 * start.size());
  EXPECT_EQ(state.counters.correction_moves, 0u);
  EXPECT_LE(state.energy_drift, 1e-12);
  EXPECT_LE(state.largest_momentum, 1e-11);
  EXPECT_EQ(recorder.frames.size(), static_cast<std::size_t>(end / 0.5) + 1);
  for (const Configuration2& frame : recorder.frames) EXPECT_GT(smallest_gap(frame), 0);
}

TEST(Run, ThesisSceneStaysHardAndConserves) {
  expect_hard_and_conserving(thesis_scene(), 10);
}

TEST(Run, MixtureOfSizesAndShapesStaysHardAndConserves) {
  const Configuration2 mixture = square_lattice(8, 0.4, std::numbers::pi / 4, [](std::size_t i) {
    const double size = i % 2 ? 1.4 : 1;
    return i % 4 < 2 ? Ellipse{size * std::sqrt(3.0), size / std::sqrt(3.0)} : Ellipse{size, size};
  });
  expect_hard_and_conserving(moving(mixture, 2), 20);
}

TEST(Run, DisksStayHardAndConserve) {
  expect_hard_and_conserving(moving(lattice_of_disks(10, 0.6), 3), 10);
}

// Two long particles in a box little longer than one of them: pairs meet through several images and
// every particle meets its own.
TEST(Run, BoxOfOneParticleLengthStaysHard) {
  Configuration2 c = equal_bodies(2, {3, 0.2}, Vec2(6.05, 2.5));
  c.position = {Vec2(0, -0.6), Vec2(1, 0.6)};
  expect_hard_and_conserving(moving(c, 4), 40);
}

TEST(Run, ALoneParticleMeetsItsOwnImages) {
  Configuration2 c = equal_bodies(1, {2, 0.5}, Vec2(5, 2));
  c.velocity = {Vec2(0.1, 0.2)};
  c.angular_velocity = {1.0};
  RunState2 state = begin_run(c, 0);
  run(state, {}, plan_until(50), {});
  // Swings to and fro between the two angles at which it touches its image above.
  EXPECT_GT(state.counters.collisions, 5u);
  EXPECT_EQ(std::abs(state.configuration.angular_velocity[0]), 1);
  EXPECT_LT(std::abs(state.configuration.angle[0]), 1);
  EXPECT_EQ(state.configuration.velocity[0], Vec2(0.1, 0.2));
  EXPECT_GT(smallest_gap(state.configuration), 0);
}

/// Keeps the numbers and times of what it is shown.
class Clock : public Observer<2> {
 public:
  void observe(const Frame<2>& frame) override {
    ticks.emplace_back(frame.index, frame.configuration.time);
  }
  std::vector<std::pair<std::int64_t, double>> ticks;
};

struct Interruption {
  RunState2 state;
  std::size_t frames, ticks;
};

// The state handed out at every block end continues to the same bits.
void expect_continues_exactly(const DynamicsOptions& options) {
  const double end = 200;
  RunState2 state = begin_run(thesis_scene(), -2);
  Recorder whole;
  Clock clock;
  std::vector<Interruption> interruptions;
  RunPlan2 plan = plan_until(end, &whole);
  plan.ticks = {0.15, &clock};
  plan.at_block_end = [&](const RunState2& s) {
    interruptions.push_back({s, whole.frames.size(), clock.ticks.size()});
  };
  run(state, options, plan, {});
  ASSERT_GT(interruptions.size(), 3u);
  for (const Interruption& at : interruptions) {
    RunState2 resumed = at.state;
    Recorder rest;
    Clock rest_clock;
    RunPlan2 rest_plan = plan_until(end, &rest);
    rest_plan.ticks = {0.15, &rest_clock};
    if (at.state.configuration.time < end) run(resumed, options, rest_plan, {});
    ASSERT_EQ(at.frames + rest.frames.size(), whole.frames.size());
    ASSERT_EQ(at.ticks + rest_clock.ticks.size(), clock.ticks.size());
    EXPECT_TRUE(std::equal(rest_clock.ticks.begin(), rest_clock.ticks.end(),
                           clock.ticks.begin() + static_cast<std::ptrdiff_t>(at.ticks)));
    expect_same_state(resumed.configuration, state.configuration);
    EXPECT_EQ(resumed.counters.collisions, state.counters.collisions);
    EXPECT_EQ(resumed.counters.predictions, state.counters.predictions);
    EXPECT_EQ(resumed.counters.virial, state.counters.virial);
    EXPECT_EQ(resumed.energy_drift, state.energy_drift);
    for (std::size_t k = 0; k < rest.frames.size(); ++k)
      EXPECT_EQ(rest.frames[k].position, whole.frames[at.frames + k].position);
  }
}

TEST(Run, NewtonianContinuesBitByBit) {
  expect_continues_exactly({});
}

TEST(Run, BrownianContinuesBitByBit) {
  expect_continues_exactly(brownian(0.1));
}

// Ticks<2> come at their times, those at 0, at the end and with a sample among them. Neither the samples nor
// the last state notice, to the last bit, as long as no block ends (after 4096 events, or about 3 units
// of time).
TEST(Run, TicksComeInTimeAndChangeNothing) {
  DynamicsOptions options;
  options.brownian = true;
  const double end = 2;
  const auto run_with = [&](Recorder& frames, Clock* clock) {
    RunState2 state = begin_run(thesis_scene(), -0.5);
    RunPlan2 plan = plan_until(end, &frames);
    plan.ticks = {0.05, clock};
    run(state, options, plan, {});
    return state;
  };
  Recorder frames_alone, frames;
  Clock clock;
  const RunState2 alone = run_with(frames_alone, nullptr);
  const RunState2 ticking = run_with(frames, &clock);
  ASSERT_EQ(clock.ticks.size(), 41u);
  for (std::size_t k = 0; k < clock.ticks.size(); ++k) {
    EXPECT_EQ(clock.ticks[k].first, static_cast<std::int64_t>(k));
    EXPECT_DOUBLE_EQ(clock.ticks[k].second, 0.05 * static_cast<double>(k));
  }
  EXPECT_EQ(clock.ticks.back().second, end);
  ASSERT_EQ(frames.frames.size(), frames_alone.frames.size());
  for (std::size_t k = 0; k < frames.frames.size(); ++k)
    EXPECT_EQ(difference(frames.frames[k], frames_alone.frames[k]), 0);
  EXPECT_EQ(difference(ticking.configuration, alone.configuration), 0);
  EXPECT_GT(alone.counters.collisions, 100u);
  EXPECT_EQ(ticking.counters.events, alone.counters.events);
  EXPECT_EQ(ticking.energy_drift, alone.energy_drift);
}

// An interval that does not divide the run: the last tick is the last within it.
TEST(Run, TicksEndWithTheRun) {
  RunState2 state = begin_run(thesis_scene(), 0);
  Clock clock;
  RunPlan2 plan{{}, 2, nullptr, {}, {0.3, &clock}};
  run(state, {}, plan, {});
  ASSERT_EQ(clock.ticks.size(), 7u);
  EXPECT_DOUBLE_EQ(clock.ticks.back().second, 1.8);
  EXPECT_EQ(state.configuration.time, 2);
}

TEST(Run, BudgetStopsAtABlockEndAndTheRunGoesOn) {
  RunState2 state = begin_run(thesis_scene(), 0);
  RunControl control;
  control.should_stop = [] { return true; };
  const StageReport report = run(state, {}, plan_until(50), control);
  EXPECT_EQ(report.end, StageEnd::stopped);
  EXPECT_LT(state.configuration.time, 50);
  EXPECT_EQ(run(state, {}, plan_until(50), {}).end, StageEnd::reached);
}

// However dense they are, blocks end, so that the run can be stopped; and it continues to the same bits.
TEST(Run, ManySamplesTicksAndStepsEndABlock) {
  const DynamicsOptions options = brownian(1e-5);
  const double end = 0.01;
  RunControl stop_at_once;
  stop_at_once.should_stop = [] { return true; };
  RunState2 whole = begin_run(thesis_scene(), 0), parts = whole;
  run(whole, options, plan_until(end), {});
  int blocks = 1;
  while (run(parts, options, plan_until(end), stop_at_once).end == StageEnd::stopped) ++blocks;
  EXPECT_EQ(blocks, 4);  // of 256 in all 1000 steps and 2 samples
  EXPECT_EQ(parts.velocity_steps, whole.velocity_steps);
  expect_same_state(parts.configuration, whole.configuration);
}

Configuration2 scene_with_an_overlap() {
  Configuration2 c = thesis_scene();
  c.position[1] = c.position[0] + Vec2(0.9, 0.3);
  return c;
}

TEST(Run, AnOverlapStopsAHardRun) {
  RunState2 state = begin_run(scene_with_an_overlap(), 0);
  EXPECT_THROW(run(state, {}, plan_until(1), {}), InvariantError);
}

TEST(Run, CorrectionMovesAreCountedAndResolveTheOverlap) {
  RunState2 state = begin_run(scene_with_an_overlap(), 0);
  DynamicsOptions options;
  options.engine.on_overlap = OnOverlap::correct;
  run(state, options, plan_until(20), {});
  EXPECT_GE(state.counters.correction_moves, 1u);
  EXPECT_LE(state.energy_drift, 1e-12);
  EXPECT_GT(smallest_gap(state.configuration), 0);
}

TEST(Run, InelasticCollisionsDissipateWhatTheyCount) {
  RunState2 state = begin_run(thesis_scene(), 0);
  run(state, with_laws(0.9), plan_until(5), {});
  EXPECT_GT(state.counters.dissipated, 1);
  EXPECT_LE(state.energy_drift, 1e-12);
}

TEST(Sampling, LinearTimesIncludeBothEnds) {
  const SampleTimes times = linear_times(0.1, 100);
  ASSERT_EQ(times.size(), 1001u);
  EXPECT_EQ(times[0], 0);
  EXPECT_NEAR(times[1000], 100, 1e-12);
}

TEST(Sampling, LogarithmicTimesStepByEqualFactors) {
  const SampleTimes times = logarithmic_times(0.01, 10, 100);
  ASSERT_EQ(times.size(), 42u);
  EXPECT_EQ(times[0], 0);
  for (std::size_t k = 2; k < times.size(); ++k)
    EXPECT_NEAR(times[k] / times[k - 1], std::pow(10, 0.1), 1e-12);
  EXPECT_NEAR(times[41], 100, 1e-12);
}

// The number of logarithmic times is computed, not counted.
TEST(Sampling, LogarithmicTimesEndWithTheLastThatIsNotLaterThanTheRun) {
  Stream draw(5, Purpose::tests);
  for (int k = 0; k < 1000; ++k) {
    const int per_decade = 1 + static_cast<int>(draw.below(50));
    const double first = std::pow(10, draw.uniform(-6, 3));
    const double duration = first * std::pow(10, draw.uniform(-1, 6));
    const SampleTimes times = logarithmic_times(first, per_decade, duration);
    const SampleTimes longer = logarithmic_times(first, per_decade, 100 * duration);
    ASSERT_LE(times[times.size() - 1], duration);
    ASSERT_GT(longer[times.size()], duration);
  }
}

// As many as a file may ask for, without a list of them.
TEST(Sampling, TimesAreNotStored) {
  constexpr int all = 100'000'000;
  const SampleTimes even = linear_times(1e-3, 1e-3 * all);
  const SampleTimes logarithmic = logarithmic_times(1, all, 10);
  EXPECT_EQ(even.size(), all + 1u);
  EXPECT_EQ(logarithmic.size(), all + 2u);
  EXPECT_NEAR(even[all / 2], 5e4, 1e-7);
  EXPECT_NEAR(logarithmic[all / 2 + 1], std::sqrt(10.), 1e-12);
  EXPECT_LE(sizeof even, 64u);
}

}  // namespace
}  // namespace vitrel

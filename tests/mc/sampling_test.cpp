#include "mc/sampling.h"

#include <gtest/gtest.h>

#include "core/state/check.h"
#include "tests/support/fluids.h"

namespace vitrel {
namespace {

TEST(Sampling, MakesTheSweepsAskedForAndFindsFittingSteps) {
  Configuration2 c = inserted_fluid(100, 2, 0.4);
  SamplingState state;
  state.local.next_sweep = 7;
  const StageReport report = sample(c, {400, Moves::local}, 1, state, {});
  EXPECT_EQ(report.end, StageEnd::reached);
  EXPECT_EQ(report.reason, "all sweeps were completed");
  EXPECT_EQ(state.sweeps(), 400u);
  EXPECT_EQ(state.local.next_sweep, 407u);
  EXPECT_EQ(state.local.counts.tried(), 400u * 100u);
  EXPECT_GT(state.local.translation.size, 0.2);
  EXPECT_TRUE(exact_check(c).clean());
}

TEST(Sampling, MakesChainsUnlessToldOtherwise) {
  Configuration2 c = inserted_fluid(100, 2, 0.4);
  SamplingState state;
  EXPECT_EQ(sample(c, {400}, 1, state, {}).end, StageEnd::reached);
  EXPECT_EQ(state.chains.sweeps, 400u);
  EXPECT_EQ(state.local.sweeps, 0u);
  // About one contact and one rotation per particle and sweep, once it is tuned.
  EXPECT_GT(state.chains.counts.contacts, 200u * 100u);
  EXPECT_GT(state.chains.counts.rotations_accepted, 50u * 100u);
  EXPECT_TRUE(exact_check(c).clean());
}

// In a box as long as two disks and hardly more room, rows are jammed.
TEST(Sampling, TellsOfChainsThatWereCutShort) {
  Configuration2 c;
  c.resize(2);
  c.box = PeriodicBox<2>(Vec2(4 * (1 + 1e-12), 20));
  c.position[0].x() = -c.box.lengths().x() / 4;
  c.position[1].x() = c.box.lengths().x() / 4;
  SamplingState state;
  const StageReport report = sample(c, {200}, 1, state, {});
  EXPECT_NE(report.reason.find("cut short in jammed rows"), std::string::npos) << report.reason;
  EXPECT_TRUE(exact_check(c).clean());
}

TEST(Sampling, GoesOnBitByBitAfterStops) {
  for (const Moves moves : {Moves::chains, Moves::local}) {
    Configuration2 whole = inserted_fluid(60, 3, 0.4), parts = whole;
    const SamplingOptions options{150, moves, {.trials = 0.2, .partners = 0.5, .collective = 1}};
    SamplingState undisturbed, state;
    sample(whole, options, 3, undisturbed, {});
    int asked = 0, stops = 0;
    const RunControl control{[&] { return ++asked % 13 == 0; }, {}, {}};
    for (; sample(parts, options, 3, state, control).end == StageEnd::stopped; ++stops) {
    }
    EXPECT_GT(stops, 5);
    EXPECT_EQ(parts.position, whole.position);
    EXPECT_EQ(parts.angle, whole.angle);
    EXPECT_EQ(state.chains.length, undisturbed.chains.length);
    EXPECT_EQ(state.chains.counts.contacts, undisturbed.chains.counts.contacts);
    EXPECT_EQ(state.local.translation.size, undisturbed.local.translation.size);
  }
}

}  // namespace
}  // namespace vitrel

#include "mc/sampling.h"

#include <gtest/gtest.h>

#include "core/state/check.h"
#include "tests/support/fluids.h"

namespace vitrel {
namespace {

TEST(Sampling, MakesTheSweepsAskedForAndFindsFittingSteps) {
  Configuration2 c = inserted_fluid(100, 2, 0.4);
  SweepState state{.next_sweep = 7};
  EXPECT_EQ(sample(c, {400}, 1, state, {}).end, StageEnd::reached);
  EXPECT_EQ(state.sweeps, 400u);
  EXPECT_EQ(state.next_sweep, 407u);
  EXPECT_EQ(state.counts.tried(), 400u * 100u);
  EXPECT_GT(state.translation.size, 0.2);
  EXPECT_TRUE(exact_check(c).clean());
}

TEST(Sampling, GoesOnBitByBitAfterStops) {
  Configuration2 whole = inserted_fluid(60, 3, 0.4), parts = whole;
  SweepState undisturbed, state;
  sample(whole, {150}, 3, undisturbed, {});
  int asked = 0, stops = 0;
  const Budget budget{[&] { return ++asked % 13 == 0; }, {}, {}};
  for (; sample(parts, {150}, 3, state, budget).end == StageEnd::stopped; ++stops) {
  }
  EXPECT_GT(stops, 5);
  EXPECT_EQ(parts.position, whole.position);
  EXPECT_EQ(parts.angle, whole.angle);
  EXPECT_EQ(state.translation.size, undisturbed.translation.size);
  EXPECT_EQ(state.counts.translations_accepted, undisturbed.counts.translations_accepted);
}

}  // namespace
}  // namespace vitrel

// The engine with a device taken out, or changed, has the same collisions.

#include "bench/baselines/engine_variants.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>

#include "bench/surveys/engine_speed.h"
#include "core/state/check.h"
#include "edmd/instances/instances.h"
#include "tests/support/motion.h"

namespace vitrel::bench {
namespace {

struct Variant {
  std::string name;
  std::function<std::unique_ptr<Engine2>()> make;
};
const std::vector<Variant> variants = {
    {"without_contact_screen", make_engine_without_lower_bound},
    {"without_horizon", make_engine_without_horizon},
    {"with_round_lists", make_engine_with_round_lists},
};

Configuration2 scene() {
  return fluid({60, 4, 0.6});
}

/// An engine and where it is.
struct Moving {
  Moving(std::unique_ptr<Engine2> made, const Configuration2& start)
      : engine(std::move(made)), now(start) {
    engine->load(now);
  }
  void advance(double until) { vitrel::advance(*engine, now, until, counters); }

  std::unique_ptr<Engine2> engine;
  Configuration2 now;
  RunCounters counters;
};

class EngineTwin : public testing::TestWithParam<Variant> {};

// They round alike but for the order in which pairs are asked, and every collision multiplies what
// they differ by; another collision parts them at once.
TEST_P(EngineTwin, HasTheSameCollisions) {
  const Configuration2 start = scene();
  Moving plain(make_ellipse_engine({}), start), other(GetParam().make(), start);
  const std::uint64_t wanted = 3 * start.size();  // six of each particle
  for (double until = 0.01; plain.counters.collisions < wanted; until += 0.01) {
    plain.advance(until);
    other.advance(until);
    ASSERT_EQ(other.counters.collisions, plain.counters.collisions) << "up to " << until;
    for (std::size_t i = 0; i < start.size(); ++i)
      ASSERT_LT((other.now.unwrapped(i) - plain.now.unwrapped(i)).norm(), 1e-6) << "at " << until;
  }
}

TEST_P(EngineTwin, StaysHard) {
  Moving run(GetParam().make(), scene());
  run.advance(10);
  EXPECT_GT(run.counters.collisions, 1000u);
  EXPECT_TRUE(exact_check(run.now).clean());
}

INSTANTIATE_TEST_SUITE_P(Variants, EngineTwin, testing::ValuesIn(variants),
                         [](const auto& at) { return at.param.name; });

TEST(EngineVariants, DifferInWhatTheyAsk) {
  const auto counts = [](std::unique_ptr<Engine2> engine) {
    Moving run(std::move(engine), scene());
    run.advance(2);
    return run.counters;
  };
  const RunCounters plain = counts(make_ellipse_engine({}));
  const RunCounters unseen = counts(make_engine_without_lower_bound());
  EXPECT_EQ(unseen.searches, unseen.predictions);
  EXPECT_GT(counts(make_engine_without_horizon()).searches, plain.searches);
  EXPECT_GT(counts(make_engine_with_round_lists()).predictions, 3 * plain.predictions / 2);
}

TEST(TiledFluid, IsHardAndAsDense) {
  const Configuration2 tile = scene(), whole = tiled(tile, 3, 2);
  EXPECT_EQ(whole.size(), 6 * tile.size());
  EXPECT_NEAR(packing_fraction(whole), 0.6, 1e-12);
  EXPECT_TRUE(exact_check(whole).clean());
}

}  // namespace
}  // namespace vitrel::bench

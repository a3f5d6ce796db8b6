#include "mc/sampling.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/state/check.h"
#include "mc/place_correlation.h"
#include "mc/sampler.h"
#include "tests/support/equal_bodies.h"
#include "tests/support/fluids.h"
#include "tests/support/mixtures_in_space.h"
#include "tests/support/same_state.h"
#include "tests/support/stops.h"

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
  Configuration2 c = equal_bodies(2, {1, 1}, Vec2(4 * (1 + 1e-12), 20));
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
    const auto stage = [&](const auto& control) {
      return sample(parts, options, 3, state, control);
    };
    EXPECT_GT(stops_of(13, stage), 5);
    expect_same_state(parts, whole);
    EXPECT_EQ(state.chains.length, undisturbed.chains.length);
    EXPECT_EQ(state.chains.counts.contacts, undisturbed.chains.counts.contacts);
    EXPECT_EQ(state.local.translation.size, undisturbed.local.translation.size);
  }
}

// The count is that of a comparison after every sweep at which one is due, made by hand.
TEST(Sampling, GoesOnUntilDecorrelated) {
  Configuration2 c = inserted_fluid(60, 2, 0.4);
  Configuration2 copy = c;
  const SamplingOptions options{.sweeps = 100000, .moves = Moves::local, .decorrelations = 4};
  SamplingState state;
  const StageReport report = sample(c, options, 3, state, {});
  EXPECT_EQ(report.end, StageEnd::reached);
  EXPECT_EQ(state.decorrelation.count, 4u);
  EXPECT_LT(state.sweeps(), 10000u);
  EXPECT_NE(report.reason.find("decorrelated 4 times in "), std::string::npos) << report.reason;

  Sampler sampler(copy, 3);
  std::uint64_t sweeps = 0, begin = 0, next = 1, count = 0;
  std::array<bool, 2> decayed{};
  PlaceCorrelation<2> first(copy);
  while (count < 4) {
    sampler.sweep();
    if (++sweeps % sweeps_per_tuning == 0) sampler.tune();
    if (sweeps < next) continue;
    const PlaceCorrelations now = first.with(copy);
    decayed[0] = decayed[0] || now.places < std::exp(-1);
    decayed[1] = decayed[1] || now.orientations < std::exp(-1);
    EXPECT_EQ(now.sizes, 0);
    next = sweeps + 1 + (sweeps - begin) / 10;
    if (!decayed[0] || !decayed[1]) continue;
    ++count, begin = sweeps, next = sweeps + 1, decayed = {};
    first = PlaceCorrelation<2>(copy);
  }
  EXPECT_EQ(state.sweeps(), sweeps);
}

TEST(Sampling, CountsDecorrelationsAcrossStops) {
  Configuration3 whole = inserted_mixture(
      MixtureInSpace{"spheroids", 60, 0.1, {species_of(1, always(2), between(0.5, 1.5))}});
  Configuration3 parts = whole;
  const SamplingOptions options{
      .sweeps = 100000, .exchanges = {.collective = 2}, .decorrelations = 3};
  SamplingState undisturbed, state;
  EXPECT_EQ(sample(whole, options, 3, undisturbed, {}).end, StageEnd::reached);
  const auto stage = [&](const auto& control) { return sample(parts, options, 3, state, control); };
  EXPECT_GT(stops_of(5, stage), 2);
  expect_same_state(parts, whole);
  EXPECT_EQ(state.sweeps(), undisturbed.sweeps());
  EXPECT_EQ(state.decorrelation.count, 3u);
}

TEST(Sampling, TellsOfStatesThatDoNotDecorrelate) {
  Configuration2 c = inserted_fluid(60, 2, 0.4);
  SamplingState state;
  const StageReport report = sample(c, {.sweeps = 3, .decorrelations = 2}, 1, state, {});
  EXPECT_EQ(report.end, StageEnd::stalled);
  EXPECT_EQ(report.reason,
            "only 0 of 2 decorrelations within max_sweeps = 3; raise it, or exchange places");
}

}  // namespace
}  // namespace vitrel

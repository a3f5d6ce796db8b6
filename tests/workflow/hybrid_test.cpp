#include "workflow/stages/hybrid.h"

#include <gtest/gtest.h>

#include "core/state/check.h"
#include "core/state/species.h"
#include "tests/support/fluids.h"

namespace vitrel {
namespace {

TEST(Hybrid, ReachesThePackingFractionExactlyByBothEnginesInTurn) {
  Configuration2 c = inserted_fluid(100, 2, 0.3);
  HybridOptions options;
  options.packing_fraction = 0.7;
  options.stretch.sweeps = 10;
  HybridState state;
  EXPECT_EQ(hybrid(c, options, state, {}).end, StageEnd::reached);
  EXPECT_NEAR(packing_fraction(c), 0.7, 1e-12);
  EXPECT_TRUE(exact_check(c).clean());
  // Lengths grow by 1 % or less in each of the stretches of growth but the last.
  EXPECT_GE(state.stretches, 2 * 42u);
  EXPECT_EQ(state.sampling.sweeps(), state.stretches / 2 * 10);
  EXPECT_EQ(state.growth.draws, state.stretches / 2 + 1);
  EXPECT_GT(state.growth.counters.collisions, 1000u);
}

TEST(Hybrid, EndsAtThePressure) {
  Configuration2 c = inserted_fluid(64, 1.4, 0.3);
  HybridOptions options;
  options.reduced_pressure = 1e4;
  options.stretch.sweeps = 10;
  HybridState state;
  const StageReport report = hybrid(c, options, state, {});
  EXPECT_EQ(report.end, StageEnd::reached);
  EXPECT_EQ(report.reason, "the reduced pressure was reached");
  EXPECT_GE(state.growth.reduced_pressure, 1e4);
  EXPECT_GT(packing_fraction(c), 0.8);
  EXPECT_TRUE(exact_check(c).clean());
}

TEST(Hybrid, KnowsWhenTheParticlesAreJammed) {
  Configuration2 c = inserted_fluid(64, 1.4, 0.3);
  HybridOptions options;
  options.packing_fraction = 0.905;
  options.stretch.sweeps = 2;
  HybridState state;
  const StageReport report = hybrid(c, options, state, {});
  EXPECT_EQ(report.end, StageEnd::stalled);
  EXPECT_NE(report.reason.find("jammed"), std::string::npos);
  EXPECT_TRUE(exact_check(c).clean());
}

// The more Monte Carlo relaxes the liquid after every stretch of fast growth, the later it jams: at 0.880
// instead of 0.828.
TEST(Hybrid, JamsTheLaterTheMoreMonteCarloRelaxes) {
  const auto jammed_at = [](std::uint64_t sweeps) {
    Configuration2 c = inserted_fluid(400, 2, 0.3);
    HybridOptions options;
    options.growth_rate = 0.2;
    options.reduced_pressure = 1e4;
    options.stretch.sweeps = sweeps;
    HybridState state;
    hybrid(c, options, state, {});
    return packing_fraction(c);
  };
  const double little = jammed_at(1), much = jammed_at(200);
  EXPECT_GT(much, little + 0.04);
}

// Where sizes are spread, exchanges of places let the mixture relax at packing fractions at which nobody
// moves far any more: it jams at 0.854, or 0.898 with collective exchanges, instead of 0.841.
TEST(Hybrid, ExchangesLetSpreadSizesJamLater) {
  const auto jammed_at = [](Moves moves, const ExchangeOptions& exchanges) {
    Species species;
    species.aspect_ratio = Distribution{.mean = 1};
    species.size = Distribution{.kind = Distribution::Kind::uniform, .low = 0.6, .high = 1.4};
    Configuration2 c = draw_particles<2>({species}, 400, 0.3, Vec2::Ones(), 1);
    insert_particles(c, {}, 1, {});
    HybridOptions options;
    options.reduced_pressure = 1e4;
    options.stretch = {.sweeps = 50, .moves = moves, .exchanges = exchanges};
    HybridState state;
    EXPECT_EQ(hybrid(c, options, state, {}).reason, "the reduced pressure was reached");
    EXPECT_TRUE(exact_check(c).clean());
    return packing_fraction(c);
  };
  const double without = jammed_at(Moves::local, {});
  EXPECT_GT(jammed_at(Moves::local, {.trials = 0.2}), without + 0.01);
  EXPECT_GT(jammed_at(Moves::chains, {.collective = 4}), without + 0.03);
}

}  // namespace
}  // namespace vitrel

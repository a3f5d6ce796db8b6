#include "mc/compression.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "core/state/check.h"
#include "mc/pressure_sampler.h"
#include "tests/support/fluids.h"
#include "tests/support/same_state.h"
#include "tests/support/stops.h"
#include "tests/support/visited_states.h"

namespace vitrel {
namespace {

// One small disk meets nobody, and its volume follows V^N exp(−βPV) with N = 1: ⟨βPV⟩ = 2. Of the
// aspect of the box the volume is independent. Blocks of 2000 long steps count as independent.
TEST(PressureSampler, VolumeOfOneParticleFollowsTheGammaDistribution) {
  for (const BoxChange change : {BoxChange::isotropic, BoxChange::anisotropic}) {
    Configuration2 one = inserted_fluid(1, 1, 0.001);
    const double pressure = 0.0005;  // V ≈ 4000
    PressureSampler sampler(one, pressure, change, 1);
    sampler.set_box_step(1.5);
    const auto measure = [&] { return std::array{pressure * one.box.volume()}; };
    const Series<1> means = block_means(
        100, 2000, [&] { sampler.sweep(); }, measure);
    const Estimate volume = estimate(means[0]);
    EXPECT_NEAR(volume.mean, 2, 3 * volume.error);
    EXPECT_LT(volume.error, 0.02);
  }
}

TEST(PressureSampler, KeepsTheStateHardInBoxesOfAnyShape) {
  for (const std::size_t n : {1, 2, 5, 100})
    for (const BoxChange change : {BoxChange::isotropic, BoxChange::anisotropic}) {
      Configuration2 c = inserted_fluid(n, 4, 0.2);
      const double aspect = c.box.lengths().y() / c.box.lengths().x();
      PressureSampler sampler(c, 5, change, 7);
      double densest = 0;
      constexpr int sweeps = 4000;
      for (int sweep = 0; sweep < sweeps; ++sweep) {
        sampler.sweep();
        densest = std::max(densest, packing_fraction(c));
        if (sweep % 20 == 19) sampler.tune();
        if (sweep % (sweeps / 10) == 0) {
          ASSERT_TRUE(exact_check(c).clean());
        }
      }
      EXPECT_GT(densest, 0.4);
      EXPECT_GT(sampler.box().accepted, 20u);
      const double change_of_aspect = c.box.lengths().y() / c.box.lengths().x() / aspect;
      EXPECT_LT(change_of_aspect, PressureSampler<Ellipse>::max_aspect_change);
      EXPECT_GT(change_of_aspect, 1 / PressureSampler<Ellipse>::max_aspect_change);
      if (change == BoxChange::isotropic) {
        EXPECT_NEAR(change_of_aspect, 1, 1e-12);
      }
    }
}

TEST(PressureSampler, SameStateForAnyNumberOfThreadsAndWhenContinued) {
  const Configuration2 start = inserted_fluid(300, 3, 0.3);
  Configuration2 one = start, two = start, three = start;
  PressureSampler alone(one, 8, BoxChange::anisotropic, 5, {}, {}, 1);
  PressureSampler shared(two, 8, BoxChange::anisotropic, 5, {}, {}, 2);
  for (int sweep = 0; sweep < 60; ++sweep) alone.sweep(), shared.sweep();
  PressureSampler first(three, 8, BoxChange::anisotropic, 5);
  for (int sweep = 0; sweep < 25; ++sweep) first.sweep();
  PressureSampler second(three, 8, BoxChange::anisotropic, 5, first.moves(), first.box());
  for (int sweep = 25; sweep < 60; ++sweep) second.sweep();
  expect_same_state(one, two);
  expect_same_state(one, three);
}

/// The end of a compression that is not stopped.
struct Compressed : StageReport, CompressionState {};
Compressed compressed(Configuration2& c, const CompressionOptions& options) {
  Compressed result;
  static_cast<StageReport&>(result) = compress(c, options, 1, result, {});
  EXPECT_TRUE(exact_check(c).clean());
  return result;
}

TEST(Compression, EndsExactlyAtThePackingFraction) {
  Configuration2 c = inserted_fluid(100, 2, 0.3);
  const Compressed end =
      compressed(c, {.pressure = 30, .packing_fraction = 0.6, .sweeps = 100'000});
  EXPECT_EQ(end.end, StageEnd::reached);
  EXPECT_NEAR(packing_fraction(c), 0.6, 1e-12);
  EXPECT_EQ(end.moves.next_sweep, end.CompressionState::packing_fraction.size());
}

TEST(Compression, SaysWhenThePressureDoesNotSuffice) {
  Configuration2 c = inserted_fluid(100, 2, 0.3);
  const Compressed end = compressed(c, {.pressure = 2, .packing_fraction = 0.8, .sweeps = 100'000});
  EXPECT_EQ(end.end, StageEnd::stalled);
  EXPECT_THAT(end.reason, testing::HasSubstr("no longer rises"));
  EXPECT_LT(end.moves.sweeps, 20'000u);
}

TEST(Compression, SaysWhenTheSweepsDoNotSuffice) {
  Configuration2 c = inserted_fluid(100, 2, 0.3);
  const Compressed end = compressed(c, {.pressure = 30, .packing_fraction = 0.6, .sweeps = 10});
  EXPECT_EQ(end.end, StageEnd::stalled);
  EXPECT_THAT(end.reason, testing::HasSubstr("did not reach its target"));
  EXPECT_EQ(end.moves.sweeps, 10u);
}

TEST(Compression, GoesOnBitByBitAfterStops) {
  Configuration2 whole = inserted_fluid(50, 2, 0.3), parts = whole;
  const CompressionOptions options{.pressure = 5, .change = BoxChange::anisotropic, .sweeps = 200};
  CompressionState undisturbed, state;
  EXPECT_EQ(compress(whole, options, 1, undisturbed, {}).end, StageEnd::reached);
  const auto stage = [&](const RunControl& control) {
    const StageReport report = compress(parts, options, 1, state, control);
    EXPECT_TRUE(exact_check(parts).clean());
    return report;
  };
  EXPECT_GT(stops_of(37, stage), 3);
  expect_same_state(parts, whole);
  EXPECT_EQ(state.packing_fraction, undisturbed.packing_fraction);
}

}  // namespace
}  // namespace vitrel

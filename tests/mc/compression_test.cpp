#include "mc/compression.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/state/check.h"
#include "mc/pressure_sampler.h"
#include "tests/support/fluids.h"
#include "tests/support/statistics.h"

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
    std::vector<double> means;
    for (int block = 0; block < 100; ++block) {
      double sum = 0;
      for (int sweep = 0; sweep < 2000; ++sweep) {
        sampler.sweep();
        sum += pressure * one.box.volume();
      }
      means.push_back(sum / 2000);
    }
    const Estimate volume = estimate(means);
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
  EXPECT_EQ(one.position, two.position);
  EXPECT_EQ(one.angle, two.angle);
  EXPECT_EQ(one.box.lengths(), two.box.lengths());
  EXPECT_EQ(one.position, three.position);
  EXPECT_EQ(one.box.lengths(), three.box.lengths());
}

TEST(Compression, EndsExactlyAtThePackingFraction) {
  Configuration2 c = inserted_fluid(100, 2, 0.3);
  CompressionState state;
  const StageReport report =
      compress(c, {.pressure = 30, .packing_fraction = 0.6, .sweeps = 100'000}, 1, state, {});
  EXPECT_EQ(report.end, StageEnd::reached);
  EXPECT_NEAR(packing_fraction(c), 0.6, 1e-12);
  EXPECT_TRUE(exact_check(c).clean());
  EXPECT_EQ(state.moves.next_sweep, state.packing_fraction.size());
}

TEST(Compression, SaysWhenThePressureDoesNotSuffice) {
  Configuration2 c = inserted_fluid(100, 2, 0.3);
  CompressionState state;
  const StageReport report =
      compress(c, {.pressure = 2, .packing_fraction = 0.8, .sweeps = 100'000}, 1, state, {});
  EXPECT_EQ(report.end, StageEnd::stalled);
  EXPECT_NE(report.reason.find("no longer rises"), std::string::npos);
  EXPECT_LT(state.moves.sweeps, 20'000u);
  EXPECT_TRUE(exact_check(c).clean());
}

TEST(Compression, SaysWhenTheSweepsDoNotSuffice) {
  Configuration2 c = inserted_fluid(100, 2, 0.3);
  CompressionState state;
  const StageReport report =
      compress(c, {.pressure = 30, .packing_fraction = 0.6, .sweeps = 10}, 1, state, {});
  EXPECT_EQ(report.end, StageEnd::stalled);
  EXPECT_NE(report.reason.find("did not reach its target"), std::string::npos);
  EXPECT_EQ(state.moves.sweeps, 10u);
}

TEST(Compression, GoesOnBitByBitAfterStops) {
  Configuration2 whole = inserted_fluid(50, 2, 0.3), parts = whole;
  const CompressionOptions options{.pressure = 5, .change = BoxChange::anisotropic, .sweeps = 200};
  CompressionState undisturbed, state;
  EXPECT_EQ(compress(whole, options, 1, undisturbed, {}).end, StageEnd::reached);
  int asked = 0, stops = 0;
  const RunControl control{[&] { return ++asked % 37 == 0; }, {}, {}};
  for (; compress(parts, options, 1, state, control).end == StageEnd::stopped; ++stops)
    EXPECT_TRUE(exact_check(parts).clean());
  EXPECT_GT(stops, 3);
  EXPECT_EQ(parts.position, whole.position);
  EXPECT_EQ(parts.box.lengths(), whole.box.lengths());
  EXPECT_EQ(state.packing_fraction, undisturbed.packing_fraction);
}

}  // namespace
}  // namespace vitrel

#include "analysis/dynamics/energy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random/stream.h"
#include "tests/support/particles_of.h"

namespace vitrel {
namespace {

Configuration2 an_ellipse_and_a_disk(double time) {
  auto configuration = particles_of<2>({{2, 1}, {1, 1}});
  configuration.time = time;
  configuration.mass = {2, 3};
  configuration.velocity = {Vec2(1, 1 + time), Vec2(0, 2)};
  configuration.angular_velocity = {3, 50};
  return configuration;
}

// ½·2·(1 + (1 + t)²) + ½·3·4 and ½·2·(5/4)·9 + ½·3·(1/2)·2500, each over two particles.
TEST(Energy, PerParticleByHand) {
  MemoryTrajectory2 trajectory({an_ellipse_and_a_disk(0), an_ellipse_and_a_disk(1)});
  const EnergySeries series = energies(trajectory);
  EXPECT_EQ(series.time, (std::vector<double>{0, 1}));
  EXPECT_DOUBLE_EQ(series.translational[0], 4);
  EXPECT_DOUBLE_EQ(series.translational[1], 5.5);
  EXPECT_DOUBLE_EQ(series.rotational[1], 943.125);
  EXPECT_DOUBLE_EQ(series.total[0], 947.125);
}

TEST(TimeAverage, HasNoErrorForUnevenTimes) {
  std::vector<double> even, uneven, series;
  Stream draw(1, Purpose::tests);
  for (int k = 0; k < 100; ++k) {
    even.push_back(0.1 * k);
    uneven.push_back(std::pow(1.1, k));
    series.push_back(draw.normal());
  }
  EXPECT_GT(time_average(even, series).error, 0);
  EXPECT_TRUE(std::isnan(time_average(uneven, series).error));
  EXPECT_EQ(time_average(even, series).mean, time_average(uneven, series).mean);
}

// N = 10 rotors at kT = 2: E = kT (2N − 2 + N)/2 = 28. A virial that grows by 2 N kT (Z − 1) per
// unit of time with Z = 3.5 gives that Z back, over even and uneven intervals.
TEST(Compressibility, OfASteadyVirialIsExact) {
  EnergySeries energy;
  std::vector<double> virial;
  for (int k = 0; k < 50; ++k) {
    energy.time.push_back(k + (k > 30 ? 0.5 : 0));
    energy.total.push_back(2.8);
    virial.push_back(7 + 2 * 10 * 2 * 2.5 * energy.time.back());
  }
  const CompressibilitySeries z = compressibility(energy, virial, 10, 10);
  ASSERT_EQ(z.value.size(), 49u);
  for (const double value : z.value) EXPECT_NEAR(value, 3.5, 1e-12);
  EXPECT_DOUBLE_EQ(z.time[1], 1.5);
  EXPECT_NEAR(z.mean.mean, 3.5, 1e-12);
}

// Virial increments with mean 40 and standard deviation 10: Z = 1 + 40/(2·10) = 3 at kT = 1 (no
// rotors, E = N − 1), each ± 0.5; the mean of 1024 intervals is known to 0.5/32.
TEST(Compressibility, ErrorIsThatOfTheIntervals) {
  Stream draw(2, Purpose::tests);
  EnergySeries energy{{0}, {}, {}, {0.9}};
  std::vector<double> virial{0};
  for (int k = 1; k <= 1024; ++k) {
    energy.time.push_back(k);
    energy.total.push_back(0.9);
    virial.push_back(virial.back() + 40 + 10 * draw.normal());
  }
  const CompressibilitySeries z = compressibility(energy, virial, 10, 0);
  EXPECT_NEAR(z.mean.mean, 3, 3 * 0.5 / 32);
  // The error of an error from 16 blocks: 1/√30 = 18 %, taken three times.
  EXPECT_NEAR(z.mean.error, 0.5 / 32, 0.55 * 0.5 / 32);
}

TEST(Compressibility, OfARunWithoutCollisionsIsUnknown) {
  const EnergySeries energy{{0, 1, 2}, {}, {}, {1, 1, 1}};
  const CompressibilitySeries z = compressibility(energy, {7, 7, 7}, 10, 0);
  EXPECT_TRUE(std::isnan(z.mean.mean));
  EXPECT_TRUE(std::isnan(z.mean.error));
}

TEST(Compressibility, NeedsTwoFrames) {
  EXPECT_TRUE(std::isnan(compressibility({{0}, {}, {}, {1}}, {5}, 10, 0).mean.mean));
}

}  // namespace
}  // namespace vitrel

#include "mc/sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/state/check.h"
#include "mc/insertion.h"
#include "tests/support/scenes.h"

namespace vitrel {
namespace {

Configuration2 fluid(std::size_t n, double aspect_ratio, double packing_fraction) {
  Configuration2 c;
  c.resize(n);
  for (Ellipse& shape : c.shape) shape = of_aspect_ratio(aspect_ratio);
  c.box = PeriodicBox<2>(Vec2(10, 10));
  insert_particles(c, {packing_fraction, 100000, false}, 1, {});
  return c;
}

TEST(Sampler, KeepsTheStateHard) {
  Configuration2 c = fluid(200, 3, 0.4);
  Sampler sampler(c, 5);
  for (int sweep = 0; sweep < 200; ++sweep) sampler.sweep();
  EXPECT_TRUE(exact_check(c).clean());
  EXPECT_GT(sampler.counts().translations_accepted, 1000u);
  EXPECT_GT(sampler.counts().rotations_accepted, 1000u);
}

TEST(Sampler, SameSeedSameStateAndSweepsAreNumbered) {
  Configuration2 one = fluid(50, 2, 0.3), two = one;
  Sampler whole(one, 9);
  for (int sweep = 0; sweep < 20; ++sweep) whole.sweep();
  Sampler first(two, 9);
  for (int sweep = 0; sweep < 7; ++sweep) first.sweep();
  Sampler second(two, 9, first.next_sweep());
  for (int sweep = 7; sweep < 20; ++sweep) second.sweep();
  EXPECT_EQ(one.position, two.position);
  EXPECT_EQ(one.angle, two.angle);
}

TEST(Sampler, StepsChangeOnlyWhenTuned) {
  Configuration2 c = fluid(100, 2, 0.3);
  Sampler sampler(c, 2);
  sampler.set_steps(0.05, 0.05);
  for (int sweep = 0; sweep < 20; ++sweep) sampler.sweep();
  EXPECT_EQ(sampler.translation_step(), 0.05);
  for (int round = 0; round < 20; ++round) {
    for (int sweep = 0; sweep < 10; ++sweep) sampler.sweep();
    sampler.tune();
  }
  EXPECT_GT(sampler.translation_step(), 0.2);
  const StageReport before = sampler.counts();
  for (int sweep = 0; sweep < 50; ++sweep) sampler.sweep();
  const StageReport after = sampler.counts();
  const double acceptance =
      static_cast<double>(after.translations_accepted - before.translations_accepted) /
      static_cast<double>(after.translations_tried - before.translations_tried);
  EXPECT_NEAR(acceptance, 0.35, 0.05);
}

TEST(Sampler, RoundParticlesAreNotTurned) {
  Configuration2 c = fluid(50, 1, 0.3);
  Sampler sampler(c, 2);
  for (int sweep = 0; sweep < 20; ++sweep) sampler.sweep();
  EXPECT_EQ(sampler.counts().rotations_tried, 0u);
  EXPECT_EQ(sampler.counts().translations_tried, 1000u);
}

// Two ellipses in a box: every hard state must be as likely as any other. The share of time that
// the centres spend in an annulus, against random insertion of the pair into the same box.
TEST(Sampler, TwoParticlesVisitHardStatesEqually) {
  const Ellipse shape = of_aspect_ratio(3);
  const auto in_annulus = [](const Configuration2& c) {
    Vec2 d = c.position[1] - c.position[0];
    d += c.box.translation(c.box.nearest_shift(d));
    return d.norm() < 2.4;
  };
  Configuration2 pair;
  pair.resize(2);
  pair.shape = {shape, shape};
  pair.box = PeriodicBox<2>(Vec2(6.5, 6.5));
  const double phi = packing_fraction(pair);

  const int insertions = 40'000;
  double expected = 0;
  for (int k = 0; k < insertions; ++k) {
    Configuration2 c = pair;
    insert_particles(c, {phi, 100000, false}, k, {});
    expected += in_annulus(c);
  }
  expected /= insertions;

  insert_particles(pair, {phi, 100000, false}, 1, {});
  Sampler sampler(pair, 3);
  sampler.set_steps(2, 1.5);
  const int samples = 40'000;
  double found = 0;
  for (int k = 0; k < samples; ++k) {
    for (int sweep = 0; sweep < 10; ++sweep) sampler.sweep();
    found += in_annulus(pair);
  }
  found /= samples;
  // Both are binomial; samples ten long sweeps apart count as independent. 4 standard errors.
  const double error = std::sqrt(2 * expected * (1 - expected) / samples);
  EXPECT_NEAR(found, expected, 4 * error);
}

}  // namespace
}  // namespace vitrel

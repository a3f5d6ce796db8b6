#include "mc/sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/state/check.h"
#include "mc/insertion.h"
#include "tests/support/fluids.h"
#include "tests/support/mixtures.h"
#include "tests/support/statistics.h"
#include "tests/support/thin_gas.h"

namespace vitrel {
namespace {

class SamplerOf : public testing::TestWithParam<Mixture> {
 protected:
  static Configuration2 inserted() { return inserted_mixture(GetParam()); }
};

// Judged in extended precision with tolerance zero, after steps of all sizes.
TEST_P(SamplerOf, KeepsTheStateHard) {
  Configuration2 c = inserted();
  Sampler sampler(c, 5);
  for (const double step : {3., 0.3, 0.03}) {
    sampler.set_steps(step, step);
    for (int sweep = 0; sweep < 100; ++sweep) sampler.sweep();
    ASSERT_TRUE(exact_check(c).clean());
  }
  const TrialCounts& counts = sampler.counts();
  EXPECT_GT(counts.translations_accepted, 20 * c.size());
  if (rotor_count(c) > 0) {
    EXPECT_GT(counts.rotations_accepted, 10 * rotor_count(c));
  }
  EXPECT_EQ(counts.translations_tried + counts.rotations_tried, 300 * c.size());
}

TEST_P(SamplerOf, ExchangesKeepTheStateHard) {
  Configuration2 c = inserted();
  const Configuration2 start = c;
  Sampler sampler(c, 5);
  sampler.set_steps(0.3, 0.3);
  sampler.set_exchanges({.trials = 0.5});
  for (int sweep = 0; sweep < 200; ++sweep) sampler.sweep();
  ASSERT_TRUE(exact_check(c).clean());
  const auto same_axes = [](const Ellipse& x, const Ellipse& y) {
    return x.a == y.a && x.b == y.b;
  };
  EXPECT_TRUE(std::ranges::equal(c.shape, start.shape, same_axes));
  const bool one_shape = std::ranges::all_of(
      c.shape, [&](const Ellipse& shape) { return same_axes(shape, c.shape[0]); });
  const TrialCounts& counts = sampler.counts();
  EXPECT_EQ(counts.exchanges.tried == 0, one_shape);
  if (std::string(GetParam().name) == "many shapes and sizes") {
    EXPECT_GT(counts.exchanges.accepted, c.size());
  }
}

TEST_P(SamplerOf, AnyNumberOfThreadsGivesTheSameState) {
  const Configuration2 start = inserted();
  const auto moved = [&](int threads) {
    Configuration2 c = start;
    Sampler sampler(c, 7, {.next_sweep = 3}, threads);
    sampler.set_exchanges({.trials = 0.2});
    for (int round = 0; round < 5; ++round) {
      for (int sweep = 0; sweep < 10; ++sweep) sampler.sweep();
      sampler.tune();
    }
    return c;
  };
  const Configuration2 one = moved(1);
  EXPECT_NE(one.position, start.position);
  for (const int threads : {2, 3}) {
    const Configuration2 more = moved(threads);
    EXPECT_EQ(more.position, one.position);
    EXPECT_EQ(more.image, one.image);
    EXPECT_EQ(more.angle, one.angle);
  }
}

INSTANTIATE_TEST_SUITE_P(Mixtures, SamplerOf, testing::ValuesIn(mixtures()));

// All particles grow and shrink, and the longest outgrow the reach that the cells began with.
TEST(Sampler, ReshapesOnlyWhereThereIsRoom) {
  Configuration2 c = inserted_fluid(200, 3, 0.3);
  Sampler sampler(c, 5);
  Stream draw(1, Purpose::tests);
  int given = 0, refused = 0;
  for (int round = 0; round < 40; ++round) {
    sampler.sweep();
    for (std::size_t i = 0; i < c.size(); ++i) {
      const double b = draw.uniform(0.3, 0.8);
      const Ellipse wanted{b * draw.uniform(1, 8), b};
      (sampler.reshape(i, wanted) ? given : refused) += 1;
    }
    ASSERT_TRUE(exact_check(c).clean());
  }
  EXPECT_GT(given, 200);
  EXPECT_GT(refused, 200);
  EXPECT_GT(largest_circumradius(c), 3);
}

TEST(Sampler, SameSeedSameStateAndSweepsAreNumbered) {
  Configuration2 one = inserted_fluid(50, 2, 0.3), two = one;
  Sampler whole(one, 9);
  for (int sweep = 0; sweep < 20; ++sweep) whole.sweep();
  Sampler first(two, 9);
  for (int sweep = 0; sweep < 7; ++sweep) first.sweep();
  Sampler second(two, 9, first.state());
  for (int sweep = 7; sweep < 20; ++sweep) second.sweep();
  EXPECT_EQ(one.position, two.position);
  EXPECT_EQ(one.angle, two.angle);
}

TEST(Sampler, StepsChangeOnlyWhenTuned) {
  Configuration2 c = inserted_fluid(100, 2, 0.3);
  Sampler sampler(c, 2);
  sampler.set_steps(0.05, 0.05);
  for (int sweep = 0; sweep < 20; ++sweep) sampler.sweep();
  EXPECT_EQ(sampler.state().translation.size, 0.05);
  for (int round = 0; round < 20; ++round) {
    for (int sweep = 0; sweep < 10; ++sweep) sampler.sweep();
    sampler.tune();
  }
  EXPECT_GT(sampler.state().translation.size, 0.2);
  const TrialCounts before = sampler.counts();
  for (int sweep = 0; sweep < 50; ++sweep) sampler.sweep();
  const TrialCounts after = sampler.counts();
  const double acceptance =
      static_cast<double>(after.translations_accepted - before.translations_accepted) /
      static_cast<double>(after.translations_tried - before.translations_tried);
  EXPECT_NEAR(acceptance, 0.35, 0.05);
}

TEST(Sampler, RoundParticlesAreNotTurned) {
  Configuration2 c = inserted_fluid(50, 1, 0.3);
  Sampler sampler(c, 2);
  for (int sweep = 0; sweep < 20; ++sweep) sampler.sweep();
  EXPECT_EQ(sampler.counts().rotations_tried, 0u);
  EXPECT_EQ(sampler.counts().translations_tried, 1000u);
}

/// The same statistics of hard states drawn one after the other as of states drawn independently: all
/// particles at once at random, again until the state is hard. 4 standard errors of the difference, a false
/// alarm of 6e-5 each.
void expect_hard_states_equally(Configuration2& c, Sampler<Ellipse>& sampler,
                                const std::array<std::vector<double>, 3>& expected) {
  std::array<std::vector<double>, 3> found;
  sampler.set_steps(4, 1);
  const Vec2 start = c.unwrapped(0);
  double farthest = 0;
  for (int block = 0; block < 400; ++block) {
    std::array<double, 3> sums{};
    constexpr int samples = 100;
    for (int k = 0; k < samples; ++k) {
      sampler.sweep();
      sampler.sweep();
      const auto values = measured(c);
      for (std::size_t m = 0; m < 3; ++m) sums[m] += values[m] / samples;
    }
    for (std::size_t m = 0; m < 3; ++m) found[m].push_back(sums[m]);
    farthest = std::max(farthest, (c.unwrapped(0) - start).norm());
  }
  for (std::size_t m = 0; m < 3; ++m) {
    const Estimate here = estimate(found[m]), there = estimate(expected[m]);
    EXPECT_LT(there.error, 0.03 * std::abs(there.mean));
    EXPECT_LT(here.error, 0.03 * std::abs(there.mean));
    EXPECT_NEAR(here.mean, there.mean, 4 * std::hypot(here.error, there.error)) << m;
  }
  EXPECT_NEAR(estimate(found[2]).mean, 0.2 * 16, 4 * estimate(found[2]).error);
  EXPECT_GT(farthest, 5 * 28);  // no border shuts it in
}

// With borders between domains too, at which long steps end.
TEST(Sampler, SeveralDomainsVisitHardStatesEqually) {
  Configuration2 c = thin_gas();
  const std::array<std::vector<double>, 3> expected = independent_states(c, 20'000);
  Sampler sampler(c, 3);
  expect_hard_states_equally(c, sampler, expected);
}

TEST(Sampler, ExchangesVisitHardStatesEqually) {
  Configuration2 c = thin_gas();
  for (std::size_t i = 0; i < c.size(); i += 2) c.shape[i] = {1.5, 0.35};
  const std::array<std::vector<double>, 3> expected = independent_states(c, 20'000);
  Sampler sampler(c, 3);
  sampler.set_exchanges({.trials = 0.5});
  expect_hard_states_equally(c, sampler, expected);
  EXPECT_GT(sampler.counts().exchanges.accepted, 16 * 10'000u);
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

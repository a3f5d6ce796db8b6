#include "mc/sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/state/check.h"
#include "mc/insertion.h"
#include "tests/support/all_mixtures.h"
#include "tests/support/equal_bodies.h"
#include "tests/support/fluids.h"
#include "tests/support/same_state.h"
#include "tests/support/thin_gas.h"
#include "tests/support/visited_states.h"

namespace vitrel {
namespace {

class SamplerOf : public MixtureTest {};

// Judged in extended precision with tolerance zero, after steps of all sizes.
TEST_P(SamplerOf, KeepsTheStateHard) {
  with_inserted([]<int Dim>(Configuration<Dim> c) {
    constexpr std::size_t sweeps = Dim == 2 ? 100 : 60, accepted = Dim == 2 ? 20 : 10;
    Sampler sampler(c, 5);
    for (const double step : {3., 0.3, 0.03}) {
      sampler.set_steps(step, step);
      for (std::size_t sweep = 0; sweep < sweeps; ++sweep) sampler.sweep();
      ASSERT_TRUE(exact_check(c).clean());
    }
    const TrialCounts& counts = sampler.counts();
    EXPECT_GT(counts.translations_accepted, accepted * c.size());
    if (rotor_count(c) > 0) {
      EXPECT_GT(counts.rotations_accepted, accepted / 2 * rotor_count(c));
    } else {
      EXPECT_EQ(counts.rotations_tried, 0u);
    }
    EXPECT_EQ(counts.translations_tried + counts.rotations_tried, 3 * sweeps * c.size());
  });
}

TEST_P(SamplerOf, ExchangesKeepTheStateHard) {
  with_inserted([]<int Dim>(const Configuration<Dim>& start) {
    Configuration<Dim> c = start;
    Sampler sampler(c, 5);
    sampler.set_steps(0.3, 0.3);
    sampler.set_exchanges({.trials = 0.5});
    constexpr int sweeps = Dim == 2 ? 200 : 100;
    for (int sweep = 0; sweep < sweeps; ++sweep) sampler.sweep();
    ASSERT_TRUE(exact_check(c).clean());
    EXPECT_EQ(c.shape, start.shape);
    const bool one_shape = std::ranges::count(c.shape, c.shape[0]) == std::ssize(c.shape);
    const auto& exchanges = sampler.counts().exchanges;
    EXPECT_EQ(exchanges.tried == 0, one_shape);
    // In the plane the large disks among long ellipses hardly find another place.
    if (Dim == 2 && std::ranges::count(c.shape, c.shape[0]) == 1 && c.size() > 1) {
      EXPECT_GT(exchanges.accepted, c.size());
    } else if (Dim == 3 && !one_shape) {
      EXPECT_GT(exchanges.accepted, c.size() / 10);
    }
  });
}

TEST_P(SamplerOf, AnyNumberOfThreadsGivesTheSameState) {
  with_inserted([]<int Dim>(const Configuration<Dim>& start) {
    const auto moved = [&](int threads) {
      Configuration<Dim> c = start;
      Sampler sampler(c, 7, {.next_sweep = 3}, threads);
      sampler.set_exchanges({.trials = 0.2});
      sweep_and_tune(sampler, Dim == 2 ? 50 : 30, 10);
      return c;
    };
    const Configuration<Dim> one = moved(1);
    EXPECT_NE(one.position, start.position);
    for (const int threads : {2, 3}) expect_same_state(moved(threads), one);
  });
}

INSTANTIATE_TEST_SUITE_P(Mixtures, SamplerOf, testing::ValuesIn(all_mixtures()));

/// All particles grow and shrink; `draw_shape` draws what each is asked to become.
template <int Dim, class DrawShape>
void expect_reshaped_where_there_is_room(Configuration<Dim>& c, int rounds,
                                         const DrawShape& draw_shape) {
  Sampler sampler(c, 5);
  Stream draw(1, Purpose::tests);
  int given = 0, refused = 0;
  for (int round = 0; round < rounds; ++round) {
    sampler.sweep();
    for (std::size_t i = 0; i < c.size(); ++i)
      (sampler.reshape(i, draw_shape(draw)) ? given : refused) += 1;
    ASSERT_TRUE(exact_check(c).clean());
  }
  EXPECT_GT(given, 200);
  EXPECT_GT(refused, 200);
}

// The longest particles outgrow the reach that the cells began with.
TEST(Sampler, ReshapesOnlyWhereThereIsRoom) {
  Configuration2 plane = inserted_fluid(200, 3, 0.3);
  expect_reshaped_where_there_is_room(plane, 40, [](Stream& draw) {
    const double b = draw.uniform(0.3, 0.8);
    return Ellipse{b * draw.uniform(1, 8), b};
  });
  EXPECT_GT(largest_circumradius(plane), 3);
  Configuration3 space = inserted_mixture(mixtures_in_space()[2]);
  expect_reshaped_where_there_is_room(space, 20, [](Stream& draw) {
    const double size = draw.uniform(0.5, 2);
    return scaled(random_ellipsoid(draw, 6), size);
  });
}

TEST(Sampler, SameSeedSameStateAndSweepsAreNumbered) {
  Configuration2 one = inserted_fluid(50, 2, 0.3), two = one;
  Sampler whole(one, 9);
  for (int sweep = 0; sweep < 20; ++sweep) whole.sweep();
  Sampler first(two, 9);
  for (int sweep = 0; sweep < 7; ++sweep) first.sweep();
  Sampler second(two, 9, first.state());
  for (int sweep = 7; sweep < 20; ++sweep) second.sweep();
  expect_same_state(one, two);
}

TEST(Sampler, StepsChangeOnlyWhenTuned) {
  Configuration2 c = inserted_fluid(100, 2, 0.3);
  Sampler sampler(c, 2);
  sampler.set_steps(0.05, 0.05);
  for (int sweep = 0; sweep < 20; ++sweep) sampler.sweep();
  EXPECT_EQ(sampler.state().translation.size, 0.05);
  sweep_and_tune(sampler, 200, 10);
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

/// The same statistics of hard states drawn one after the other as of states drawn independently: all particles at once
/// at random, again until the state is hard.
void expect_hard_states_equally(Configuration2& c, Sampler<Ellipse>& sampler,
                                const Series<3>& expected) {
  sampler.set_steps(4, 1);
  const Vec2 start = c.unwrapped(0);
  double farthest = 0;
  int steps = 0;
  constexpr int samples = 100;
  const auto step = [&] {
    sampler.sweep();
    sampler.sweep();
    if (++steps % samples == 0) farthest = std::max(farthest, (c.unwrapped(0) - start).norm());
  };
  const Series<3> found = block_means(400, samples, step, [&] { return measured(c); });
  expect_same_means(found, expected, 0.03);
  EXPECT_NEAR(estimate(found[2]).mean, 0.2 * 16, 4 * estimate(found[2]).error);
  EXPECT_GT(farthest, 5 * 28);  // no border shuts it in
}

// With borders between domains too, at which long steps end.
TEST(Sampler, SeveralDomainsVisitHardStatesEqually) {
  Configuration2 c = thin_gas();
  const Series<3> expected = independent_states(c, 20'000);
  Sampler sampler(c, 3);
  expect_hard_states_equally(c, sampler, expected);
}

TEST(Sampler, ExchangesVisitHardStatesEqually) {
  Configuration2 c = thin_gas();
  for (std::size_t i = 0; i < c.size(); i += 2) c.shape[i] = {1.5, 0.35};
  const Series<3> expected = independent_states(c, 20'000);
  Sampler sampler(c, 3);
  sampler.set_exchanges({.trials = 0.5});
  expect_hard_states_equally(c, sampler, expected);
  EXPECT_GT(sampler.counts().exchanges.accepted, 16 * 10'000u);
}

// Two ellipses in a box: every hard state must be as likely as any other. The share of time that
// the centres spend in an annulus, against random insertion of the pair into the same box.
TEST(Sampler, TwoParticlesVisitHardStatesEqually) {
  const auto in_annulus = [](const Configuration2& c) { return are_closer(c, 2.4); };
  Configuration2 pair = equal_bodies(2, of_aspect_ratio(3), Vec2(6.5, 6.5));
  const int samples = 40'000;
  const double expected = share_of_insertions(pair, samples, in_annulus);

  insert_particles(pair, {packing_fraction(pair), 100000, false}, 1, {});
  Sampler sampler(pair, 3);
  sampler.set_steps(2, 1.5);
  const auto step = [&] {
    for (int sweep = 0; sweep < 10; ++sweep) sampler.sweep();
  };
  const double found = share_of_states(samples, step, [&] { return in_annulus(pair); });
  // Both are binomial; samples ten long sweeps apart count as independent. 4 standard errors.
  const double error = std::sqrt(2 * expected * (1 - expected) / samples);
  EXPECT_NEAR(found, expected, 4 * error);
}

}  // namespace
}  // namespace vitrel

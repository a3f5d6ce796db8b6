#include "mc/exchanges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "core/state/check.h"
#include "mc/event_chain.h"
#include "mc/sampler.h"
#include "tests/support/mixtures.h"
#include "tests/support/polydisperse.h"
#include "tests/support/same_state.h"

namespace vitrel {
namespace {

// Five places and five bodies: which body is in which place makes 120 states, some of them hard.

using Arrangement = std::vector<std::size_t>;  // the place of every particle

struct Scene {
  const char* name;
  double spread;                // of the places
  std::vector<Ellipse> shapes;  // in the order of their volumes
};

std::vector<Scene> scenes() {
  const auto disk = [](double radius) { return Ellipse{radius, radius}; };
  const auto similar = [](double size) { return Ellipse{2 * size, size}; };
  return {
      {"disks", 1.12, {disk(0.5), disk(0.62), disk(0.7), disk(0.84), disk(0.9)}},
      {"disks_two_of_them_equal", 1.12, {disk(0.5), disk(0.7), disk(0.7), disk(0.84), disk(0.9)}},
      {"similar_ellipses",
       1,
       {similar(0.31), similar(0.4), similar(0.44), similar(0.5), similar(0.56)}},
      {"shapes_of_which_none_fits_into_the_next",
       1.3,
       {{0.9, 0.4}, {0.7, 0.65}, {1.2, 0.5}, {0.95, 0.7}, {1.3, 0.55}}}};
}

Configuration2 five_places(const Scene& scene) {
  Configuration2 c;
  c.resize(5);
  c.box = PeriodicBox<2>(Vec2(8, 8));
  c.position = {Vec2(-2, -1), Vec2(-0.7, -1.6), Vec2(-0.5, 0.2), Vec2(0.9, 0.6), Vec2(-1.8, 0.7)};
  for (Vec2& position : c.position) position *= scene.spread;
  c.angle = {0.3, 1.2, 2.5, 0.8, 1.9};
  c.shape = scene.shapes;
  return c;
}

/// The scene with every particle in the place given.
Configuration2 arranged(const Scene& scene, const Arrangement& places) {
  const Configuration2 all = five_places(scene);
  Configuration2 c = all;
  for (std::size_t i = 0; i < places.size(); ++i) {
    c.position[i] = all.position[places[i]];
    c.angle[i] = all.angle[places[i]];
  }
  return c;
}

Arrangement arrangement_of(const Configuration2& c, const Scene& scene) {
  const Configuration2 all = five_places(scene);
  Arrangement places;
  for (const Vec2& position : c.position)
    places.push_back(
        static_cast<std::size_t>(std::ranges::find(all.position, position) - all.position.begin()));
  return places;
}

std::vector<Arrangement> hard_arrangements(const Scene& scene) {
  std::vector<Arrangement> hard;
  Arrangement places(5);
  std::iota(places.begin(), places.end(), std::size_t{0});
  do {
    if (exact_check(arranged(scene, places)).clean()) hard.push_back(places);
  } while (std::ranges::next_permutation(places).found);
  return hard;
}

class ExchangesOf : public testing::TestWithParam<Scene> {};
INSTANTIATE_TEST_SUITE_P(Scenes, ExchangesOf, testing::ValuesIn(scenes()),
                         [](const auto& scene) { return scene.param.name; });

/// The definition of a chain, step by step, with the exact criterion.
Arrangement by_definition(const Scene& scene, Arrangement places, std::size_t rank, int steps) {
  for (; steps > 0; --steps, rank = (rank + 1) % 5) {
    if (rank == 4) continue;
    Arrangement exchanged = places;
    std::swap(exchanged[rank], exchanged[rank + 1]);
    if (exact_check(arranged(scene, exchanged)).clean()) places = exchanged;
  }
  return places;
}

// Inflow into every hard state exactly 1, for chains of all lengths from all ranks.
TEST_P(ExchangesOf, ChainsMapHardStatesOneToOneAsTheyAreDefined) {
  const Scene& scene = GetParam();
  const std::vector<Arrangement> hard = hard_arrangements(scene);
  ASSERT_GT(hard.size(), 10u);
  ASSERT_LT(hard.size(), 120u);
  for (std::size_t rank = 0; rank < 5; ++rank)
    for (const int steps : {1, 2, 3, 4, 5, 9}) {
      std::map<Arrangement, int> inflow;
      for (const Arrangement& places : hard) {
        Configuration2 c = arranged(scene, places);
        HardParticles particles(c);
        Exchanges exchanges(particles, {});
        ExchangeCounts counts;
        OverlapTestCounts tests;
        exchanges.run_chain(rank, static_cast<std::uint64_t>(steps), counts, tests);
        const Arrangement reached = arrangement_of(c, scene);
        EXPECT_EQ(reached, by_definition(scene, places, rank, steps));
        ++inflow[reached];
      }
      for (const Arrangement& places : hard) EXPECT_EQ(inflow[places], 1);
      EXPECT_EQ(inflow.size(), hard.size());
    }
}

/// Moves of step(exchanges, draw, counts, tests) visit all hard states that they reach equally often; false alarms at about
/// 5 standard errors of independent visits, of which there are fewer than steps.
template <class Step>
void expect_equal_visits(const Scene& scene, double partners, const Step& step) {
  constexpr int steps = 200'000, independent = steps / 20;
  Configuration2 c = arranged(scene, hard_arrangements(scene)[0]);
  HardParticles particles(c);
  Exchanges exchanges(particles, {.trials = 1, .partners = partners, .collective = 1});
  exchanges.rank_domains();
  Stream draw(3, Purpose::tests);
  ExchangeCounts counts;
  OverlapTestCounts tests;
  std::map<Arrangement, double> shares;
  for (int k = 0; k < steps; ++k) {
    step(exchanges, draw, counts, tests);
    shares[arrangement_of(c, scene)] += 1.0 / steps;
  }
  EXPECT_GT(shares.size(), 5u);
  const double expected = 1 / static_cast<double>(shares.size());
  for (const auto& [places, share] : shares)
    EXPECT_NEAR(share, expected, 5 * std::sqrt(expected / independent));
}

TEST_P(ExchangesOf, ExchangesOfAnyTwoVisitAllHardStatesThatTheyReachEqually) {
  for (const double partners : {1., 0.4})
    expect_equal_visits(GetParam(), partners,
                        [](auto& exchanges, auto&... rest) { exchanges.try_all(rest...); });
}

TEST_P(ExchangesOf, ChainsVisitAllHardStatesThatTheyReachEqually) {
  expect_equal_visits(GetParam(), 1,
                      [](auto& exchanges, auto&... rest) { exchanges.run_chain(rest...); });
}

class ExchangesIn : public testing::TestWithParam<Mixture> {};
INSTANTIATE_TEST_SUITE_P(Mixtures, ExchangesIn, testing::ValuesIn(mixtures()));

// With both kinds of moves, on several domains and across them.
TEST_P(ExchangesIn, MixturesOfAllKindsKeepThemHard) {
  const ExchangeOptions all{.trials = 0.5, .partners = 0.2, .collective = 2};
  const Configuration2 start = inserted_mixture(GetParam());
  Configuration2 local = start, chained = start;
  Sampler sampler(local, 5);
  sampler.set_exchanges(all);
  EventChain chains(chained, {.exchanges = all}, 5);
  for (int sweep = 0; sweep < 50; ++sweep) {
    sampler.sweep();
    chains.sweep();
    chains.tune();
  }
  for (const Configuration2* c : {&local, &chained}) {
    EXPECT_TRUE(exact_check(*c).clean());
    EXPECT_EQ(c->shape, start.shape);
  }
  const std::uint64_t steps = 50 * 2 * start.size();
  EXPECT_EQ(sampler.counts().exchanges.steps, steps);
  EXPECT_EQ(chains.counts().exchanges.steps, steps);
  EXPECT_EQ(sampler.counts().exchanges.accepted_steps > 0, start.size() > 1);
}

/// The same chain in single steps, which each test the two that exchange.
template <class Shape>
void run_in_single_steps(HardParticles<Shape>& particles, std::size_t rank, std::size_t steps) {
  const auto& c = particles.configuration();
  std::vector<std::size_t> by_rank(c.size());
  std::iota(by_rank.begin(), by_rank.end(), std::size_t{0});
  std::ranges::stable_sort(by_rank, {}, [&](std::size_t i) { return c.shape[i].volume(); });
  OverlapTestCounts tests;
  for (; steps > 0; --steps, rank = (rank + 1) % c.size())
    if (rank + 1 < c.size()) particles.try_exchange(by_rank[rank], by_rank[rank + 1], tests);
}

template <int Dim>
void expect_the_same_as_in_single_steps(double aspect_ratio, double fraction) {
  Configuration<Dim> searched = polydisperse<Dim>(aspect_ratio, 300, fraction), stepped = searched;
  HardParticles one(searched), other(stepped);
  Exchanges exchanges(one, {});
  ExchangeCounts counts;
  OverlapTestCounts tests;
  exchanges.run_chain(17, 1000, counts, tests);
  run_in_single_steps(other, 17, 1000);
  expect_same_state(searched, stepped);
  EXPECT_GT(counts.accepted_steps, 500u);
  EXPECT_LT(counts.accepted_steps, 997u);
  EXPECT_TRUE(exact_check(searched).clean());
}

TEST(Exchanges, SearchForTheFirstStepThatFailsChangesNothing) {
  expect_the_same_as_in_single_steps<2>(1, 0.35);
  expect_the_same_as_in_single_steps<2>(2, 0.35);
  expect_the_same_as_in_single_steps<3>(1, 0.25);
  expect_the_same_as_in_single_steps<3>(1.5, 0.25);
}

/// How far apart in rank partners are, of those that exchange in a dilute gas.
TEST(Exchanges, PartnersAreAsCloseInSizeAsAskedFor) {
  Configuration2 c = polydisperse<2>(1, 100, 0.01);
  HardParticles particles(c);
  std::vector<std::size_t> by_rank(c.size());
  std::iota(by_rank.begin(), by_rank.end(), std::size_t{0});
  std::ranges::sort(by_rank, {}, [&](std::size_t i) { return c.shape[i].volume(); });
  for (const std::size_t farthest : {1u, 5u, 50u}) {
    Exchanges exchanges(particles, {.trials = 0.01, .partners = 0.02 * farthest});
    Stream draw(1, Purpose::tests);
    ExchangeCounts counts;
    OverlapTestCounts tests;
    std::set<std::size_t> found;
    for (int k = 0; k < 3000; ++k) {
      const std::vector<Vec2> before = c.position;
      exchanges.try_all(draw, counts, tests);
      std::vector<std::size_t> moved;
      for (std::size_t rank = 0; rank < c.size(); ++rank)
        if (c.position[by_rank[rank]] != before[by_rank[rank]]) moved.push_back(rank);
      if (moved.empty()) continue;
      const std::size_t apart = moved[1] - moved[0];
      found.insert(std::min(apart, c.size() - apart));
    }
    EXPECT_EQ(found.size(), farthest);
    EXPECT_EQ(*found.rbegin(), farthest);
  }
}

}  // namespace
}  // namespace vitrel

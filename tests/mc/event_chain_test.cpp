#include "mc/event_chain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/reference/literature.h"
#include "core/state/check.h"
#include "mc/hard_core.h"
#include "tests/support/chain_pressures.h"
#include "tests/support/equal_bodies.h"
#include "tests/support/fluids.h"
#include "tests/support/mixtures.h"
#include "tests/support/same_state.h"
#include "tests/support/thin_gas.h"
#include "tests/support/visited_states.h"

namespace vitrel {
namespace {

class EventChainOf : public testing::TestWithParam<Mixture> {};

// Judged in extended precision with tolerance zero, after chains that end before the first contact and
// chains much longer than the box, which push whole rows along.
TEST_P(EventChainOf, KeepsTheStateHard) {
  Configuration2 c = inserted_mixture(GetParam());
  const double spacing = std::sqrt(c.box.volume() / static_cast<double>(c.size()));
  for (const double length : {0.1, 3., 300.}) {
    EventChain chains(c, {}, 5);
    chains.set_plan({20, length * spacing, 2 * c.size(), 0.5});
    for (int sweep = 0; sweep < 20; ++sweep) chains.sweep();
    ASSERT_TRUE(exact_check(c).clean());
    ASSERT_FALSE(find_overlap(c).has_value());
    EXPECT_EQ(chains.counts().chains, 400u);
    EXPECT_EQ(chains.counts().cut_short, 0u);
    if (rotor_count(c) > 0) {
      EXPECT_EQ(chains.counts().rotations_tried, 40 * c.size());
      EXPECT_GT(chains.counts().rotations_accepted, 4 * c.size());
    }
    if (c.size() > 1 && length > 1) {
      EXPECT_GT(chains.counts().contacts, 400u);
    }
  }
}

// Chains only go forwards: all displacements together are the lengths of all chains.
TEST_P(EventChainOf, PathsAddUpToTheLength) {
  Configuration2 c = inserted_mixture(GetParam());
  const auto sum = [&c] {
    double all = 0;
    for (std::size_t i = 0; i < c.size(); ++i) all += c.unwrapped(i).sum();
    return all;
  };
  EventChain chains(c, {}, 6);
  chains.set_plan({50, 30, 0, 0.5});
  const double before = sum(), length = 50 * 30;
  chains.sweep();
  EXPECT_EQ(chains.counts().length, length);
  EXPECT_NEAR(sum() - before, length, 1e-9 * length);
}

INSTANTIATE_TEST_SUITE_P(Mixtures, EventChainOf, testing::ValuesIn(mixtures()));

TEST(EventChain, SameSeedSameStateAndSweepsAreNumbered) {
  Configuration2 one = inserted_fluid(50, 2, 0.3), two = one;
  const EventChain<Ellipse>::Plan plan{7, 12, 40, 0.4};
  EventChain whole(one, {}, 9);
  whole.set_plan(plan);
  for (int sweep = 0; sweep < 20; ++sweep) whole.sweep();
  EventChain first(two, {}, 9);
  first.set_plan(plan);
  for (int sweep = 0; sweep < 7; ++sweep) first.sweep();
  EventChain second(two, {}, 9, first.state());
  for (int sweep = 7; sweep < 20; ++sweep) second.sweep();
  expect_same_state(one, two);
}

// Counts over 1000 chains, whose numbers of contacts scatter by about half of themselves, against a plan
// that was made after 100: the two differ by 5 % as a rule.
TEST(EventChain, TuningGivesTheContactsAndRotationsAskedFor) {
  for (const EventChainOptions& asked :
       {EventChainOptions{100, 1}, EventChainOptions{10, 0.5}, EventChainOptions{300, 2}}) {
    Configuration2 c = swollen_fluid(200, 3, 0.5);
    EventChain chains(c, asked, 2);
    sweep_and_tune(chains, 3000, 1);
    const ChainCounts before = chains.counts();
    double sweeps = 0;
    for (; chains.counts().chains < before.chains + 1000; ++sweeps) chains.sweep();
    const ChainCounts& after = chains.counts();
    const double contacts = static_cast<double>(after.contacts - before.contacts);
    const double tried = static_cast<double>(after.rotations_tried - before.rotations_tried);
    const double accepted =
        static_cast<double>(after.rotations_accepted - before.rotations_accepted);
    EXPECT_NEAR(contacts / static_cast<double>(after.chains - before.chains), asked.contacts,
                0.2 * asked.contacts);
    EXPECT_NEAR(contacts / sweeps, std::max(200., asked.contacts), 0.3 * 200);
    EXPECT_NEAR(tried / contacts, asked.rotations, 0.2 * asked.rotations);
    EXPECT_NEAR(accepted / tried, 0.35, 0.07);
  }
}

TEST(EventChain, RoundParticlesAreNotTurned) {
  Configuration2 c = inserted_fluid(50, 1, 0.3);
  EventChain chains(c, {}, 2);
  chains.set_plan({5, 10, 100, 0.1});
  chains.sweep();
  EXPECT_EQ(chains.counts().rotations_tried, 0u);
}

// A row of disks that spans the box, with a hard margin between them and hardly more room: chains along it
// would have contacts without end, those across it go their way.
TEST(EventChain, IsCutShortInAJammedRow) {
  Configuration2 c = equal_bodies(4, {1, 1}, Vec2(8 * (1 + 1e-13), 20));
  for (std::size_t i = 0; i < 4; ++i)
    c.position[i] = {(static_cast<double>(i) - 1.5) * c.box.lengths().x() / 4, 0};
  ASSERT_FALSE(find_overlap(c).has_value());
  EventChain chains(c, {1, 0}, 4);
  chains.set_plan({1, 1e-3, 0, 0.1});
  for (int sweep = 0; sweep < 100; ++sweep) {
    chains.sweep();
    ASSERT_TRUE(exact_check(c).clean());
  }
  EXPECT_GT(chains.counts().cut_short, 0u);
  EXPECT_LT(chains.counts().cut_short, 100u);
  EXPECT_LE(chains.counts().contacts, 100 * 1000u);
}

// The limits are 3.5 standard errors, a false alarm of 5e-4 each; ellipses are allowed another 0.1 %.
TEST(EventChain, HasTheEquationOfState) {
  for (const FluidPressure& at :
       {fluid_pressure(1, 0.3), fluid_pressure(1, 0.5), fluid_pressure(2, 0.5),
        fluid_pressure(4, 0.3), fluid_pressure(6, 0.3)}) {
    Configuration2 c = swollen_fluid(400, at.aspect_ratio, at.packing_fraction);
    const ChainPressures z = chain_pressures(c, {500, 25, 60, 5});
    const double allowed = at.error > 0 ? 0.001 * at.z : 0;
    std::printf(
        "Z at aspect ratio %g, φ = %g: chains %.4f(%.4f), contacts %.4f(%.4f), table %.4f\n",
        at.aspect_ratio, at.packing_fraction, z.of_chains.mean, z.of_chains.error,
        z.of_contacts.mean, z.of_contacts.error, at.z);
    EXPECT_LT(z.of_chains.error, 0.003 * at.z);
    EXPECT_LT(z.of_contacts.error, 0.006 * at.z);
    EXPECT_NEAR(z.of_chains.mean, at.z, 3.5 * std::hypot(z.of_chains.error, at.error) + allowed);
    EXPECT_NEAR(z.of_contacts.mean, at.z,
                3.5 * std::hypot(z.of_contacts.error, at.error) + allowed);
    EXPECT_TRUE(exact_check(c).clean());
  }
}

// Every hard state must be as likely as any other: against states drawn independently.
TEST(EventChain, VisitsHardStatesEqually) {
  Configuration2 c = thin_gas();
  const Series<3> expected = independent_states(c, 20'000);
  EventChain chains(c, {}, 3);
  chains.set_plan({8, 14, 16, 1});
  const auto step = [&] { chains.sweep(); };
  expect_same_means(block_means(400, 100, step, [&] { return measured(c); }), expected, 0.03);
}

// Two ellipses in a box shorter than two of them, in which they meet through several images and
// would meet their own: how often their nearest images are close, against random insertion.
TEST(EventChain, TwoParticlesAmongTheirImagesVisitHardStatesEqually) {
  Configuration2 pair = equal_bodies(2, of_aspect_ratio(3), Vec2(4.2, 5));
  ASSERT_LT(pair.box.lengths().x(), 4 * pair.shape[0].a);
  const auto is_close = [](const Configuration2& c) { return are_closer(c, 2); };
  const int samples = 40'000;
  const double expected = share_of_insertions(pair, samples, is_close);

  insert_particles(pair, {packing_fraction(pair), 100000, false}, 1, {});
  EventChain chains(pair, {}, 3);
  chains.set_plan({10, 3, 10, 1.5});
  const auto step = [&] {
    for (int sweep = 0; sweep < 4; ++sweep) chains.sweep();
  };
  const double found = share_of_states(samples, step, [&] { return is_close(pair); });
  EXPECT_GT(expected, 0.1);
  EXPECT_LT(expected, 0.9);
  // Both are binomial; samples four sweeps of ten chains apart count as independent. 4 standard errors.
  EXPECT_NEAR(found, expected, 4 * std::sqrt(2 * expected * (1 - expected) / samples));
}

}  // namespace
}  // namespace vitrel

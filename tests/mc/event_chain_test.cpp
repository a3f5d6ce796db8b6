#include "mc/event_chain.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "bench/reference/literature.h"
#include "core/state/check.h"
#include "mc/hard_core.h"
#include "tests/support/chain_pressures.h"
#include "tests/support/fluids.h"
#include "tests/support/mixtures.h"
#include "tests/support/statistics.h"
#include "tests/support/thin_gas.h"

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
  EXPECT_EQ(one.position, two.position);
  EXPECT_EQ(one.image, two.image);
  EXPECT_EQ(one.angle, two.angle);
}

// Counts over 1000 chains, whose numbers of contacts scatter by about half of themselves, against a plan
// that was made after 100: the two differ by 5 % as a rule.
TEST(EventChain, TuningGivesTheContactsAndRotationsAskedFor) {
  for (const EventChainOptions& asked :
       {EventChainOptions{100, 1}, EventChainOptions{10, 0.5}, EventChainOptions{300, 2}}) {
    Configuration2 c = swollen_fluid(200, 3, 0.5);
    EventChain chains(c, asked, 2);
    for (int round = 0; round < 3000; ++round) {
      chains.sweep();
      chains.tune();
    }
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
  Configuration2 c;
  c.resize(4);
  c.box = PeriodicBox<2>(Vec2(8 * (1 + 1e-13), 20));
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

// Every hard state must be as likely as any other: against states drawn independently. 4 standard errors of
// the difference, a false alarm of 6e-5 each.
TEST(EventChain, VisitsHardStatesEqually) {
  Configuration2 c = thin_gas();
  const std::array<std::vector<double>, 3> expected = independent_states(c, 20'000);
  EventChain chains(c, {}, 3);
  chains.set_plan({8, 14, 16, 1});
  std::array<std::vector<double>, 3> found;
  for (int block = 0; block < 400; ++block) {
    std::array<double, 3> sums{};
    constexpr int samples = 100;
    for (int k = 0; k < samples; ++k) {
      chains.sweep();
      const auto values = measured(c);
      for (std::size_t m = 0; m < 3; ++m) sums[m] += values[m] / samples;
    }
    for (std::size_t m = 0; m < 3; ++m) found[m].push_back(sums[m]);
  }
  for (std::size_t m = 0; m < 3; ++m) {
    const Estimate here = estimate(found[m]), there = estimate(expected[m]);
    EXPECT_LT(there.error, 0.03 * std::abs(there.mean));
    EXPECT_LT(here.error, 0.03 * std::abs(there.mean));
    EXPECT_NEAR(here.mean, there.mean, 4 * std::hypot(here.error, there.error)) << m;
  }
}

// Two ellipses in a box shorter than two of them, in which they meet through several images and would
// meet their own: how often their nearest images are close, against random insertion.
TEST(EventChain, TwoParticlesAmongTheirImagesVisitHardStatesEqually) {
  const Ellipse shape = of_aspect_ratio(3);
  Configuration2 pair;
  pair.resize(2);
  pair.shape = {shape, shape};
  pair.box = PeriodicBox<2>(Vec2(4.2, 5));
  ASSERT_LT(pair.box.lengths().x(), 4 * shape.a);
  const auto is_close = [](const Configuration2& c) {
    Vec2 d = c.position[1] - c.position[0];
    d += c.box.translation(c.box.nearest_shift(d));
    return d.norm() < 2;
  };
  const double phi = packing_fraction(pair);
  const int samples = 40'000;
  double expected = 0;
  for (int k = 0; k < samples; ++k) {
    Configuration2 c = pair;
    insert_particles(c, {phi, 100000, false}, static_cast<std::uint64_t>(k), {});
    expected += is_close(c);
  }
  expected /= samples;

  insert_particles(pair, {phi, 100000, false}, 1, {});
  EventChain chains(pair, {}, 3);
  chains.set_plan({10, 3, 10, 1.5});
  double found = 0;
  for (int k = 0; k < samples; ++k) {
    for (int sweep = 0; sweep < 4; ++sweep) chains.sweep();
    found += is_close(pair);
  }
  found /= samples;
  EXPECT_GT(expected, 0.1);
  EXPECT_LT(expected, 0.9);
  // Both are binomial; samples four sweeps of ten chains apart count as independent. 4 standard errors.
  EXPECT_NEAR(found, expected, 4 * std::sqrt(2 * expected * (1 - expected) / samples));
}

}  // namespace
}  // namespace vitrel

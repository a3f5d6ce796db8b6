#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/contact/contact_queries.h"
#include "core/state/check.h"
#include "mc/event_chain.h"
#include "mc/hard_core.h"
#include "mc/sampler.h"
#include "tests/support/equal_bodies.h"
#include "tests/support/mixtures_in_space.h"
#include "tests/support/visited_states.h"

namespace vitrel {
namespace {

/// Three prolate spheroids and three spheres in a box of two domains along x.
Configuration3 thin_gas_in_space() {
  Configuration3 c;
  c.resize(6);
  for (std::size_t i = 0; i < 6; ++i) c.shape[i] = {i % 2 ? Vec3(1.5, 0.5, 0.5) : Vec3::Ones()};
  c.box = PeriodicBox<3>(Vec3(25, 4, 3.5));
  return c;
}

/// What is measured of a state: pairs of centres closer than 2, pairs of close spheroids weighted by how parallel they
/// are, spheroids weighted by their direction against z, and particles near a line between cells.
std::array<double, 4> measured(const Configuration3& c) {
  std::array<double, 4> sums{};
  const auto axis = [&](std::size_t i) -> Vec3 { return c.orientation[i] * Vec3::UnitX(); };
  for (std::size_t i = 0; i < c.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      Vec3 d = c.position[j] - c.position[i];
      d += c.box.translation(c.box.nearest_shift(d));
      sums[0] += d.norm() < 2;
      if (i % 2 && j % 2 && d.norm() < 2.5) sums[1] += std::pow(axis(i).dot(axis(j)), 2);
    }
    if (i % 2) sums[2] += std::pow(axis(i).z(), 2);
    const double cells = 8 * (c.position[i].x() / c.box.lengths().x() + 0.5);
    sums[3] += std::abs(cells - std::round(cells)) < 0.1;
  }
  return sums;
}

bool is_hard(const Configuration3& c) {
  bool hard = true;
  for (std::size_t i = 0; i < c.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const double reach = c.shape[i].circumradius() + c.shape[j].circumradius();
      c.box.for_each_image(
          c.position[j] - c.position[i], reach, [&](const Shift<3>& shift, const Vec3& d) {
            if (i == j && shift.isZero()) return;
            hard = hard && separated(c.shape[i], c.pose(i), c.shape[j], c.pose(j), d, 0);
          });
      if (!hard) return false;
    }
  return true;
}

/// Draws all particles at once at random, until the state is hard.
void draw_hard_state(Configuration3& c, Stream& draw) {
  do {
    for (std::size_t i = 0; i < c.size(); ++i) {
      for (int k = 0; k < 3; ++k) c.position[i][k] = draw.uniform(-0.5, 0.5) * c.box.lengths()[k];
      c.orientation[i] = random_orientation(draw);
    }
  } while (!is_hard(c));
}

/// What measure() returns of so many states drawn independently.
template <class Measure>
auto independent_states(Configuration3& c, int count, std::uint64_t seed, const Measure& measure) {
  Stream draw(seed, Purpose::tests);
  return block_means(
      count, 1, [&] { draw_hard_state(c, draw); }, measure);
}

// The same statistics of hard states drawn one after the other as of states drawn independently. In a box so narrow the
// spheroids meet their own images.
TEST(SamplerInSpace, VisitsHardStatesEqually) {
  for (const double exchanges : {0., 0.4}) {
    Configuration3 c = thin_gas_in_space();
    const auto measure = [&] { return measured(c); };
    const Series<4> expected = independent_states(c, 20'000, 17, measure);
    Sampler sampler(c, 3);
    sampler.set_steps(2, 1);
    sampler.set_exchanges({.trials = exchanges});
    const auto step = [&] {
      for (int sweep = 0; sweep < 4; ++sweep) sampler.sweep();
    };
    expect_same_means(block_means(300, 100, step, measure), expected, 0.03);
    EXPECT_EQ(sampler.counts().exchanges.accepted > 0, exchanges > 0);
  }
}

/// Spheres or spheroids in a box in which each meets several images of the others, and the spheroids their own.
struct FewSolids {
  const char* name;
  Vec3 semi_axes[4];
  Vec3 box;
  EventChain<Ellipsoid>::Plan plan;
};
void PrintTo(const FewSolids& solids, std::ostream* out) {
  *out << solids.name;
}

class EventChainOfFew : public testing::TestWithParam<FewSolids> {};

// How many pairs are close, and how the axes x of the bodies lie to that of the box: against states drawn independently.
TEST_P(EventChainOfFew, VisitsHardStatesEqually) {
  Configuration3 c = equal_bodies(4, {}, GetParam().box);
  for (std::size_t i = 0; i < 4; ++i) c.shape[i] = {GetParam().semi_axes[i]};
  const auto measure = [&c] {
    std::array<double, 2> sums{};
    for (std::size_t i = 0; i < 4; ++i) {
      if (!c.shape[i].is_round()) sums[1] += std::pow((c.orientation[i] * Vec3::UnitX()).x(), 2);
      for (std::size_t j = 0; j < i; ++j)
        c.box.for_each_image(c.position[j] - c.position[i], 2.8,
                             [&](const Shift<3>&, const Vec3&) { sums[0] += 1; });
    }
    return sums;
  };
  const Series<2> expected = independent_states(c, 10'000, 18, measure);
  EventChain chains(c, {}, 3);
  chains.set_plan(GetParam().plan);
  const Series<2> found = block_means(
      300, 50, [&] { chains.sweep(); }, measure);
  ASSERT_TRUE(exact_check(c).clean());
  EXPECT_EQ(chains.counts().cut_short, 0u);
  // The axes of spheres mean nothing.
  if (rotor_count(c) > 0)
    expect_same_means(found, expected, 0.02);
  else
    expect_same_means<1>({found[0]}, {expected[0]}, 0.02);
}

INSTANTIATE_TEST_SUITE_P(
    Solids, EventChainOfFew,
    testing::Values(FewSolids{"spheres",
                              {Vec3::Constant(1.5), Vec3::Ones(), Vec3::Ones(), Vec3::Ones()},
                              {6, 5, 4},
                              {6, 7.3, 0, 0.1}},
                    FewSolids{"spheroids, scalene ellipsoids and a sphere",
                              {{1.8, 0.8, 0.8}, {0.5, 1.4, 1.4}, {1.9, 1, 0.6}, Vec3::Ones()},
                              {6, 4.5, 3.5},
                              {6, 7.3, 6, 1}}));

class EventChainInSpace : public testing::TestWithParam<MixtureInSpace> {};

// Chains only go forwards: all displacements together are the lengths of all chains. Hardness is judged in extended
// precision with tolerance zero.
TEST_P(EventChainInSpace, PathsAddUpToTheLengthAndKeepTheStateHard) {
  Configuration3 c = inserted_mixture(GetParam());
  const auto sum = [&c] {
    double all = 0;
    for (std::size_t i = 0; i < c.size(); ++i) all += c.unwrapped(i).sum();
    return all;
  };
  for (const double length : {0.1, 3., 300.}) {
    EventChain chains(c, {}, 6);
    chains.set_plan({200, length, 2 * c.size(), 0.5});
    const double before = sum();
    chains.sweep();
    EXPECT_NEAR(sum() - before, 200 * length, 1e-9 * 200 * length);
    ASSERT_TRUE(exact_check(c).clean());
    ASSERT_FALSE(find_overlap(c).has_value());
    EXPECT_EQ(chains.counts().cut_short, 0u);
    if (length > 1 && c.size() > 1) {
      EXPECT_GT(chains.counts().contacts, 200u);
    }
    if (rotor_count(c) > 0) {
      EXPECT_GT(chains.counts().rotations_accepted, c.size() / 10);
    } else {
      EXPECT_EQ(chains.counts().rotations_tried, 0u);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Mixtures, EventChainInSpace, testing::ValuesIn(mixtures_in_space()));

}  // namespace
}  // namespace vitrel

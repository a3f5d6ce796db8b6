#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/contact/contact_queries.h"
#include "core/state/check.h"
#include "mc/event_chain.h"
#include "mc/hard_core.h"
#include "mc/sampler.h"
#include "tests/support/mixtures_in_space.h"
#include "tests/support/solids.h"
#include "tests/support/statistics.h"

namespace vitrel {
namespace {

class SamplerInSpaceOf : public testing::TestWithParam<MixtureInSpace> {
 protected:
  static Configuration3 inserted() { return inserted_mixture(GetParam()); }
};

// Judged in extended precision with tolerance zero, after steps of all sizes.
TEST_P(SamplerInSpaceOf, KeepsTheStateHard) {
  Configuration3 c = inserted();
  Sampler sampler(c, 5);
  for (const double step : {3., 0.3, 0.03}) {
    sampler.set_steps(step, step);
    for (int sweep = 0; sweep < 60; ++sweep) sampler.sweep();
    ASSERT_TRUE(exact_check(c).clean());
  }
  const TrialCounts& counts = sampler.counts();
  EXPECT_GT(counts.translations_accepted, 10 * c.size());
  if (rotor_count(c) > 0) {
    EXPECT_GT(counts.rotations_accepted, 5 * rotor_count(c));
  } else {
    EXPECT_EQ(counts.rotations_tried, 0u);
  }
  EXPECT_EQ(counts.translations_tried + counts.rotations_tried, 180 * c.size());
}

TEST_P(SamplerInSpaceOf, ExchangesKeepTheStateHard) {
  Configuration3 c = inserted();
  Sampler sampler(c, 5);
  sampler.set_steps(0.3, 0.3);
  sampler.set_exchanges({.trials = 0.5});
  for (int sweep = 0; sweep < 100; ++sweep) sampler.sweep();
  ASSERT_TRUE(exact_check(c).clean());
  const bool one_shape = std::ranges::all_of(
      c.shape, [&](const Ellipsoid& s) { return s.semi_axes == c.shape[0].semi_axes; });
  EXPECT_EQ(sampler.counts().exchanges.tried == 0, one_shape);
  if (!one_shape) {
    EXPECT_GT(sampler.counts().exchanges.accepted, c.size() / 10);
  }
}

TEST_P(SamplerInSpaceOf, AnyNumberOfThreadsGivesTheSameState) {
  const Configuration3 start = inserted();
  const auto moved = [&](int threads) {
    Configuration3 c = start;
    Sampler sampler(c, 7, {.next_sweep = 3}, threads);
    sampler.set_exchanges({.trials = 0.2});
    for (int round = 0; round < 3; ++round) {
      for (int sweep = 0; sweep < 10; ++sweep) sampler.sweep();
      sampler.tune();
    }
    return c;
  };
  const Configuration3 one = moved(1);
  EXPECT_NE(one.position, start.position);
  for (const int threads : {2, 3}) {
    const Configuration3 more = moved(threads);
    EXPECT_EQ(more.position, one.position);
    EXPECT_EQ(more.image, one.image);
    for (std::size_t i = 0; i < one.size(); ++i)
      EXPECT_EQ(more.orientation[i].coeffs(), one.orientation[i].coeffs());
  }
}

INSTANTIATE_TEST_SUITE_P(Mixtures, SamplerInSpaceOf, testing::ValuesIn(mixtures_in_space()));

// All particles grow and shrink, and the longest outgrow the reach that the cells began with.
TEST(SamplerInSpace, ReshapesOnlyWhereThereIsRoom) {
  Configuration3 c = inserted_mixture(mixtures_in_space()[2]);
  Sampler sampler(c, 5);
  Stream draw(1, Purpose::tests);
  int given = 0, refused = 0;
  for (int round = 0; round < 20; ++round) {
    sampler.sweep();
    for (std::size_t i = 0; i < c.size(); ++i) {
      const double size = draw.uniform(0.5, 2);
      (sampler.reshape(i, scaled(random_ellipsoid(draw, 6), size)) ? given : refused) += 1;
    }
    ASSERT_TRUE(exact_check(c).clean());
  }
  EXPECT_GT(given, 200);
  EXPECT_GT(refused, 200);
}

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

// The same statistics of hard states drawn one after the other as of states drawn independently. 4 standard errors of
// the difference, a false alarm of 6e-5 each. In a box so narrow the spheroids meet their own images.
TEST(SamplerInSpace, VisitsHardStatesEqually) {
  for (const double exchanges : {0., 0.4}) {
    Configuration3 c = thin_gas_in_space();
    Stream draw(17, Purpose::tests);
    std::array<std::vector<double>, 4> expected, found;
    for (int k = 0; k < 20'000; ++k) {
      draw_hard_state(c, draw);
      const auto values = measured(c);
      for (std::size_t m = 0; m < 4; ++m) expected[m].push_back(values[m]);
    }
    Sampler sampler(c, 3);
    sampler.set_steps(2, 1);
    sampler.set_exchanges({.trials = exchanges});
    for (int block = 0; block < 300; ++block) {
      std::array<double, 4> sums{};
      constexpr int samples = 100;
      for (int k = 0; k < samples; ++k) {
        for (int sweep = 0; sweep < 4; ++sweep) sampler.sweep();
        const auto values = measured(c);
        for (std::size_t m = 0; m < 4; ++m) sums[m] += values[m] / samples;
      }
      for (std::size_t m = 0; m < 4; ++m) found[m].push_back(sums[m]);
    }
    for (std::size_t m = 0; m < 4; ++m) {
      const Estimate here = estimate(found[m]), there = estimate(expected[m]);
      EXPECT_LT(there.error, 0.03 * there.mean);
      EXPECT_LT(here.error, 0.03 * there.mean);
      EXPECT_NEAR(here.mean, there.mean, 4 * std::hypot(here.error, there.error)) << m;
    }
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

// How many pairs are close, and how the axes x of the bodies lie to that of the box, which of spheres means nothing: against
// states drawn independently. 4 standard errors of the difference, a false alarm of 6e-5 each.
TEST_P(EventChainOfFew, VisitsHardStatesEqually) {
  Configuration3 c;
  c.resize(4);
  for (std::size_t i = 0; i < 4; ++i) c.shape[i] = {GetParam().semi_axes[i]};
  c.box = PeriodicBox<3>(GetParam().box);
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
  Stream draw(18, Purpose::tests);
  std::array<std::vector<double>, 2> expected, found;
  for (int k = 0; k < 10'000; ++k) {
    draw_hard_state(c, draw);
    for (std::size_t m = 0; m < 2; ++m) expected[m].push_back(measure()[m]);
  }
  EventChain chains(c, {}, 3);
  chains.set_plan(GetParam().plan);
  for (int block = 0; block < 300; ++block) {
    std::array<double, 2> sums{};
    for (int k = 0; k < 50; ++k) {
      chains.sweep();
      for (std::size_t m = 0; m < 2; ++m) sums[m] += measure()[m] / 50;
    }
    for (std::size_t m = 0; m < 2; ++m) found[m].push_back(sums[m]);
  }
  ASSERT_TRUE(exact_check(c).clean());
  EXPECT_EQ(chains.counts().cut_short, 0u);
  for (std::size_t m = 0; m < (rotor_count(c) > 0 ? 2 : 1); ++m) {
    const Estimate here = estimate(found[m]), there = estimate(expected[m]);
    EXPECT_LT(there.error, 0.02 * there.mean);
    EXPECT_LT(here.error, 0.02 * there.mean);
    EXPECT_NEAR(here.mean, there.mean, 4 * std::hypot(here.error, there.error)) << m;
  }
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

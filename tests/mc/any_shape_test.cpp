// Shapes of which Monte Carlo knows no more than separation and support gap, against its fast tests of the same bodies.

#include <gtest/gtest.h>

#include <vector>

#include "core/state/check.h"
#include "mc/event_chain.h"
#include "mc/pressure_sampler.h"
#include "mc/sampler.h"
#include "tests/support/mixtures.h"
#include "tests/support/mixtures_in_space.h"
#include "tests/support/resting_bodies.h"

namespace vitrel {
namespace {

constexpr ExchangeOptions exchanges{.trials = 0.2, .collective = 2};

template <class Moves>
void sweep(Moves& moves, int sweeps) {
  for (int k = 0; k < sweeps; ++k) {
    moves.sweep();
    moves.tune();
  }
}

template <class Shape, int Dim>
Configuration<Dim> after_local_moves(Configuration<Dim> c) {
  Sampler<Shape> sampler(c, 5);
  sampler.set_exchanges(exchanges);
  sweep(sampler, 30);
  return c;
}

template <class Shape, int Dim>
Configuration<Dim> after_compression(Configuration<Dim> c) {
  constexpr double pressure = 5;
  PressureSampler<Shape> sampler(c, pressure, BoxChange::anisotropic, 5);
  sweep(sampler, 30);
  return c;
}

template <int Dim>
void expect_equal(Configuration<Dim> one, Configuration<Dim> two) {
  EXPECT_EQ(one.position, two.position);
  EXPECT_EQ(one.image, two.image);
  EXPECT_EQ(orientations(one), orientations(two));
  EXPECT_EQ(one.box.lengths(), two.box.lengths());
}

/// Overlaps are the same, so that all moves are.
template <class Shape, class Plain, int Dim>
void expect_the_same_moves(const Configuration<Dim>& start) {
  expect_equal(after_local_moves<Plain>(start), after_local_moves<Shape>(start));
  expect_equal(after_compression<Plain>(start), after_compression<Shape>(start));
}

/// Chains stop at a slightly different distance from the next particle.
template <class Plain, int Dim>
void expect_hard_chains(Configuration<Dim> c) {
  constexpr std::uint64_t number = 200, rotations = 1000;
  EventChain<Plain> chains(c, {.exchanges = exchanges}, 6);
  chains.set_plan({number, c.box.lengths().maxCoeff(), rotations, 0.2});
  chains.sweep();
  EXPECT_TRUE(exact_check(c).clean());
  if (c.size() > 1) {
    EXPECT_GT(chains.counts().contacts, number / 2);
  }
}

class AnyShapeInThePlane : public testing::TestWithParam<Mixture> {};

TEST_P(AnyShapeInThePlane, MovesLikeTheEllipsesThatItIs) {
  const Configuration2 start = inserted_mixture(GetParam());
  expect_the_same_moves<Ellipse, PlainEllipse>(start);
  expect_hard_chains<PlainEllipse>(start);
}

INSTANTIATE_TEST_SUITE_P(Mixtures, AnyShapeInThePlane, testing::ValuesIn(mixtures()));

class AnyShapeInSpace : public testing::TestWithParam<MixtureInSpace> {};

TEST_P(AnyShapeInSpace, MovesLikeTheEllipsoidsThatItIs) {
  const Configuration3 start = inserted_mixture(GetParam());
  expect_the_same_moves<Ellipsoid, PlainEllipsoid>(start);
  expect_hard_chains<PlainEllipsoid>(start);
}

INSTANTIATE_TEST_SUITE_P(Mixtures, AnyShapeInSpace, testing::ValuesIn(mixtures_in_space()));

}  // namespace
}  // namespace vitrel

// Shapes of which Monte Carlo knows no more than separation and support gap, against its fast tests of the same bodies.

#include <gtest/gtest.h>

#include <type_traits>

#include "core/state/check.h"
#include "mc/event_chain.h"
#include "mc/pressure_sampler.h"
#include "mc/sampler.h"
#include "tests/support/all_mixtures.h"
#include "tests/support/resting_bodies.h"
#include "tests/support/same_state.h"
#include "tests/support/visited_states.h"

namespace vitrel {
namespace {

constexpr ExchangeOptions exchanges{.trials = 0.2, .collective = 2};

template <class Shape, int Dim>
Configuration<Dim> after_local_moves(Configuration<Dim> c) {
  Sampler<Shape> sampler(c, 5);
  sampler.set_exchanges(exchanges);
  sweep_and_tune(sampler, 30, 1);
  return c;
}

template <class Shape, int Dim>
Configuration<Dim> after_compression(Configuration<Dim> c) {
  constexpr double pressure = 5;
  PressureSampler<Shape> sampler(c, pressure, BoxChange::anisotropic, 5);
  sweep_and_tune(sampler, 30, 1);
  return c;
}

/// Overlaps are the same, so that all moves are.
template <class Shape, class Plain, int Dim>
void expect_the_same_moves(const Configuration<Dim>& start) {
  expect_same_state(after_local_moves<Plain>(start), after_local_moves<Shape>(start));
  expect_same_state(after_compression<Plain>(start), after_compression<Shape>(start));
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

class AnyShape : public MixtureTest {};

TEST_P(AnyShape, MovesLikeTheEllipsesOrEllipsoidsThatItIs) {
  with_inserted([]<int Dim>(const Configuration<Dim>& start) {
    using Plain = std::conditional_t<Dim == 2, PlainEllipse, PlainEllipsoid>;
    expect_the_same_moves<ParticleShape<Dim>, Plain>(start);
    expect_hard_chains<Plain>(start);
  });
}

INSTANTIATE_TEST_SUITE_P(Mixtures, AnyShape, testing::ValuesIn(all_mixtures()));

}  // namespace
}  // namespace vitrel

#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "mc/insertion.h"
#include "tests/support/statistics.h"

/// Statistics of the states that a Monte Carlo method visits, against those of states drawn independently.
namespace vitrel {

/// So many sweeps, with a tuning at the end of every interval of so many.
template <class Moves>
void sweep_and_tune(Moves& moves, int sweeps, int interval) {
  for (int sweep = 1; sweep <= sweeps; ++sweep) {
    moves.sweep();
    if (sweep % interval == 0) moves.tune();
  }
}

/// Series of some numbers.
template <std::size_t M>
using Series = std::array<std::vector<double>, M>;

template <std::size_t M>
void append(Series<M>& series, const std::array<double, M>& values) {
  for (std::size_t m = 0; m < M; ++m) series[m].push_back(values[m]);
}

/// The means over blocks of samples of the numbers that measure() returns after each step().
template <class Step, class Measure>
auto block_means(int blocks, int samples, const Step& step, const Measure& measure) {
  using Values = decltype(measure());
  Series<std::tuple_size_v<Values>> means;
  for (int block = 0; block < blocks; ++block) {
    Values sums{};
    for (int k = 0; k < samples; ++k) {
      step();
      const Values values = measure();
      for (std::size_t m = 0; m < sums.size(); ++m) sums[m] += values[m] / samples;
    }
    append(means, sums);
  }
  return means;
}

/// Both means are as precise as `largest_error` says, relative to the expected one, and agree within 4 standard errors
/// of the difference: a false alarm of 6e-5 each.
template <std::size_t M>
void expect_same_means(const Series<M>& found, const Series<M>& expected, double largest_error) {
  for (std::size_t m = 0; m < M; ++m) {
    const Estimate here = estimate(found[m]), there = estimate(expected[m]);
    EXPECT_LT(there.error, largest_error * std::abs(there.mean));
    EXPECT_LT(here.error, largest_error * std::abs(there.mean));
    EXPECT_NEAR(here.mean, there.mean, 4 * std::hypot(here.error, there.error)) << m;
  }
}

/// The share of so many states, each reached by step(), for which holds() is true.
template <class Step, class Predicate>
double share_of_states(int states, const Step& step, const Predicate& holds) {
  int found = 0;
  for (int k = 0; k < states; ++k) {
    step();
    found += holds();
  }
  return static_cast<double>(found) / states;
}

/// The same of states each inserted at random into the same box.
template <class Predicate>
double share_of_insertions(const Configuration2& particles, int states, const Predicate& holds) {
  const double fraction = packing_fraction(particles);
  Configuration2 c;
  std::uint64_t seed = 0;
  const auto step = [&] {
    c = particles;
    insert_particles(c, {fraction, 100'000, false}, seed++, {});
  };
  return share_of_states(states, step, [&] { return holds(c); });
}

/// Whether the nearest images of the first two particles are closer than `distance`.
inline bool are_closer(const Configuration2& c, double distance) {
  Vec2 d = c.position[1] - c.position[0];
  d += c.box.translation(c.box.nearest_shift(d));
  return d.norm() < distance;
}

}  // namespace vitrel

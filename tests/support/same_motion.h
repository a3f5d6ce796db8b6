#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/motion.h"

namespace vitrel {

/// How long two engines are compared, and by how much they may differ.
struct SameMotion {
  double collisions_of_each = 10;  ///< of a particle
  double interval = 0.02;
  double largest_difference = 1e-5;
  double virial = 1e-6;  ///< relative
};

/// Two engines make the same collisions, in the same order. They round differently, and every collision multiplies what
/// they differ by, 1e-15, several times; the same collisions keep them together for a while, a single other one parts
/// them by far more than what is allowed. The second one starts, and is compared with the first, in a frame that
/// in_frame_of_first(state, time) goes to and returns from.
template <int Dim, class Frame>
void expect_same_motion(const Configuration<Dim>& start, Engine<Dim>& simple, Engine<Dim>& general,
                        const SameMotion& wanted, const Frame& in_frame_of_first) {
  RunCounters of_simple, of_general;
  Configuration<Dim> one = start, two = start;
  simple.load(one);
  in_frame_of_first(two, 0);
  general.load(two);
  const double collisions = 0.5 * wanted.collisions_of_each * static_cast<double>(start.size());
  for (double until = wanted.interval; static_cast<double>(of_simple.collisions) < collisions;
       until += wanted.interval) {
    advance(simple, one, until, of_simple);
    advance(general, two, until, of_general);
    ASSERT_EQ(of_simple.collisions, of_general.collisions) << "up to " << until;
    Configuration<Dim> seen = two;
    in_frame_of_first(seen, until);
    ASSERT_LT(difference(one, seen), wanted.largest_difference) << "at " << until;
  }
  EXPECT_NEAR(of_general.virial, of_simple.virial, wanted.virial * std::abs(of_simple.virial));
  EXPECT_EQ(of_general.correction_moves, 0u);
}

template <int Dim>
void expect_same_motion(const Configuration<Dim>& start, Engine<Dim>& simple, Engine<Dim>& general,
                        const SameMotion& wanted = {}) {
  expect_same_motion(start, simple, general, wanted, [](Configuration<Dim>&, double) {});
}

}  // namespace vitrel

#pragma once

#include <gtest/gtest.h>

#include <cmath>

/// Whether errors say how far values are from the truth.
namespace vitrel {

/// A binomial count within so many standard deviations of its mean.
inline void expect_binomial(int count, int trials, double p, double deviations) {
  EXPECT_NEAR(count, trials * p, deviations * std::sqrt(trials * p * (1 - p)));
}

/// How many of the known errors of some values cover the truth, once and twice.
struct Coverage {
  int known = 0, unknown = 0, one = 0, two = 0;

  void count(double deviation, double error) {
    ++(std::isnan(error) ? unknown : known);
    one += std::abs(deviation) < error;
    two += std::abs(deviation) < 2 * error;
  }
};

}  // namespace vitrel

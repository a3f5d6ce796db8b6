#include "bench/lab/reference/interval_jet.h"

#include <gtest/gtest.h>

#include "core/random/stream.h"

namespace vitrel::lab {
namespace {

bool holds(const Interval& interval, Real value) {
  return interval.low <= value && value <= interval.high;
}

// Random intervals and points inside them: the image of every point lies in the interval's image.
TEST(Interval, HoldsEveryPointOfItsImage) {
  Stream draw(1, Purpose::tests);
  for (int trial = 0; trial < 20'000; ++trial) {
    const Real x0 = draw.uniform(-9, 9), y0 = draw.uniform(-9, 9);
    const Interval x(x0, x0 + draw.uniform(0, 4)), y(y0, y0 + draw.uniform(0, 4));
    const Real px = x.low + draw.uniform() * x.width(), py = y.low + draw.uniform() * y.width();
    EXPECT_TRUE(holds(x + y, px + py));
    EXPECT_TRUE(holds(x - y, px - py));
    EXPECT_TRUE(holds(x * y, px * py));
    EXPECT_TRUE(holds(cos(x), std::cos(px)));
    EXPECT_TRUE(holds(sin(x), std::sin(px)));
  }
}

TEST(Interval, CosineReachesItsExtremes) {
  EXPECT_EQ(cos(Interval(-0.1L, 0.2L)).high, 1);
  EXPECT_EQ(cos(Interval(3, 3.5L)).low, -1);
  EXPECT_EQ(sin(Interval(1, 2)).high, 1);
  EXPECT_LT(sin(Interval(2, 3)).high, 0.92L);
}

// f(t) = (2 − 3t) cos(0.4 + 5t): derivatives by hand.
TEST(Jet, DerivativesOfAProduct) {
  Stream draw(2, Purpose::tests);
  for (int trial = 0; trial < 1000; ++trial) {
    const Real t = draw.uniform(-2, 2);
    const Interval around(t - 0.01L, t + 0.01L);
    const Jet f = linear(2, -3, around) * cosine(0.4L, 5, around);
    const Real c = std::cos(0.4L + 5 * t), s = std::sin(0.4L + 5 * t), l = 2 - 3 * t;
    EXPECT_TRUE(holds(f.value, l * c));
    EXPECT_TRUE(holds(f.first, -3 * c - 5 * l * s));
    EXPECT_TRUE(holds(f.second, 30 * s - 25 * l * c));
  }
}

}  // namespace
}  // namespace vitrel::lab

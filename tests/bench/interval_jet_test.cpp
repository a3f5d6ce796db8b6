#include "bench/reference/interval_jet.h"

#include <gtest/gtest.h>

#include "core/random/stream.h"

namespace vitrel::bench {
namespace {

// Intervals of doubles, points and their images in long double: an image that lies in the interval
// lies there by more than its own rounding.
using Wide = long double;
using Range = Interval<double>;

bool holds(const Range& interval, Wide value) {
  return interval.low <= value && value <= interval.high;
}

Range random_range(Stream& draw, double widest) {
  const double low = draw.uniform(-9, 9);
  // Half of them points: only the rounding outwards can save these.
  return {low, draw.uniform() < 0.5 ? low : low + draw.uniform(0, widest)};
}

Wide point_of(Stream& draw, const Range& x) {
  return std::min<Wide>(x.low + draw.uniform() * Wide(x.width()), x.high);
}

TEST(Interval, HoldsEveryPointOfItsImage) {
  Stream draw(1, Purpose::tests);
  for (int trial = 0; trial < 20'000; ++trial) {
    const Range x = random_range(draw, 4), y = random_range(draw, 4);
    const Wide px = point_of(draw, x), py = point_of(draw, y);
    EXPECT_TRUE(holds(x + y, px + py));
    EXPECT_TRUE(holds(x - y, px - py));
    EXPECT_TRUE(holds(x * y, px * py));
    EXPECT_TRUE(holds(x.low * y, x.low * py));
    EXPECT_TRUE(holds(square(x), px * px));
    EXPECT_GE(square(x).low, 0);
    if (y.low > 0 || y.high < 0) {
      EXPECT_TRUE(holds(x / y, px / py));
    }
    if (px >= 0) {
      EXPECT_TRUE(holds(root(x), std::sqrt(px)));
    }
    const Direction<double> u = direction(x);
    EXPECT_TRUE(holds(u.cosine, std::cos(px)));
    EXPECT_TRUE(holds(u.sine, std::sin(px)));
  }
}

// A turn by at most δ moves neither coordinate by more than δ.
TEST(Interval, DirectionsAreTight) {
  for (const double delta : {0.0, 1e-6, 0.1}) {
    const Direction<double> u = turned(direction(Range(0.7)), delta);
    EXPECT_LE(u.cosine.width(), 2.2 * delta + 1e-14);
    EXPECT_LE(u.sine.width(), 2.2 * delta + 1e-14);
  }
}

// f(t) = (2 − 3t) cos(0.4 + 5t) and its square: derivatives by hand.
TEST(Jet, DerivativesOfAProduct) {
  Stream draw(2, Purpose::tests);
  for (int trial = 0; trial < 1000; ++trial) {
    const double t = draw.uniform(-2, 2);
    const Range around(t - 0.01, t + 0.01);
    const auto over = direction(Range(0.4) + Range(5) * around);
    const Jet<double> f = linear(Range(2), Range(-3), around) * cosine(over, Range(5));
    const Wide angle = Wide(0.4) + 5 * Wide(t);
    const Wide c = std::cos(angle), s = std::sin(angle), l = 2 - 3 * Wide(t);
    const Wide f0 = l * c, f1 = -3 * c - 5 * l * s, f2 = 30 * s - 25 * l * c;
    EXPECT_TRUE(holds(f.value, f0));
    EXPECT_TRUE(holds(f.first, f1));
    EXPECT_TRUE(holds(f.second, f2));
    const Jet<double> ff = square(f);
    EXPECT_TRUE(holds(ff.value, f0 * f0));
    EXPECT_TRUE(holds(ff.first, 2 * f0 * f1));
    EXPECT_TRUE(holds(ff.second, 2 * (f1 * f1 + f0 * f2)));
  }
}

}  // namespace
}  // namespace vitrel::bench

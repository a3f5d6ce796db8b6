#include "workflow/pair/pair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <random>

namespace vitrel {
namespace {

class RandomPairs {
 public:
  Pair<2> in_plane(std::optional<PeriodicBox<2>> box) {
    return {ellipse(), ellipse(), std::move(box), 1};
  }
  Pair<3> in_space(std::optional<PeriodicBox<3>> box) {
    return {ellipsoid(), ellipsoid(), std::move(box), 1};
  }

 private:
  double number(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Flight<Ellipse> ellipse() {
    const double a = number(0.5, 2);
    return {{a, a * number(0.1, 1)},
            {{number(-3, 3), number(-3, 3)}, number(0, std::numbers::pi)},
            {Vec2::Zero(), 0}};
  }
  Flight<Ellipsoid> ellipsoid() {
    const Quaternion turn{number(-1, 1), number(-1, 1), number(-1, 1), number(-1, 1)};
    return {{{number(0.3, 2), number(0.3, 2), number(0.3, 2)}},
            {{number(-2, 2), number(-2, 2), number(-2, 2)}, turn.normalized()},
            {Vec3::Zero(), Vec3::Zero()}};
  }

  std::mt19937_64 random_{1};
};

/// The fewest of both answers that make the comparison one.
constexpr int enough = 30;

template <int Dim, class Next>
void expect_the_sign_of_the_gap(Next&& next) {
  int overlapping = 0, apart = 0;
  for (int k = 0; k < 300; ++k) {
    const Pair<Dim> pair = next();
    const PairGap<Dim> gap = gap_at(pair, 0);
    EXPECT_EQ(overlaps(pair), gap.gap < 0) << k;
    ++(gap.gap < 0 ? overlapping : apart);
  }
  EXPECT_GT(overlapping, enough);
  EXPECT_GT(apart, enough);
}

TEST(PairOverlap, IsANegativeGap) {
  RandomPairs random;
  expect_the_sign_of_the_gap<2>([&] { return random.in_plane({}); });
  expect_the_sign_of_the_gap<3>([&] { return random.in_space({}); });
}

TEST(PairOverlap, IsThatOfAnyImage) {
  RandomPairs random;
  expect_the_sign_of_the_gap<2>([&] { return random.in_plane(PeriodicBox<2>({5, 7})); });
  expect_the_sign_of_the_gap<3>([&] { return random.in_space(PeriodicBox<3>({5, 6, 7})); });
}

}  // namespace
}  // namespace vitrel

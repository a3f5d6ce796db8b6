#include "edmd/soft/chebyshev_panels.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/random/stream.h"

namespace vitrel {
namespace {

using Plane = ChebyshevPanels<2, 5, 2>;
using Space = ChebyshevPanels<3, 6, 1>;

template <int Dim>
std::array<double, Dim> random_point(const Box<Dim>& box, Stream& draw) {
  std::array<double, Dim> x;
  for (int axis = 0; axis < Dim; ++axis) x[axis] = draw.uniform(box.low[axis], box.high[axis]);
  return x;
}

TEST(ChebyshevPanels, PolynomialsNeedOnePanel) {
  const Box<2> box{{-3, 1}, {2, 1.5}};
  const auto function = [](const Plane::Point& x) {
    return Plane::Value{1 + x[0] * x[0] * x[0] * x[1], std::pow(x[1], 4) - x[0]};
  };
  const Plane panels(box, function, {1e-10, 1e-3}, 1);
  EXPECT_EQ(panels.size(), 1);
  Stream draw(1, Purpose::tests);
  for (int k = 0; k < 100; ++k) {
    const Plane::Point x = random_point(box, draw);
    const auto found = panels(x);
    ASSERT_TRUE(found);
    for (int v = 0; v < 2; ++v) EXPECT_NEAR((*found)[v], function(x)[v], 1e-12);
  }
}

TEST(ChebyshevPanels, HalvesWhereItMust) {
  const Box<3> box{{0, 0, 0}, {1, 4, 1}};
  const auto function = [](const Space::Point& x) {
    return Space::Value{std::exp(-x[0]) * std::tanh(5 * (x[1] - 1)) + x[2]};
  };
  const Space panels(box, function, {1e-6, 1e-3}, 2);
  EXPECT_GT(panels.size(), 4);
  Stream draw(2, Purpose::tests);
  for (int k = 0; k < 3000; ++k) {
    const Space::Point x = random_point(box, draw);
    const auto found = panels(x);
    ASSERT_TRUE(found);
    EXPECT_NEAR((*found)[0], function(x)[0], 2e-6);
  }
  EXPECT_GT(Space(box, function, {1e-7, 1e-3}, 2).size(), panels.size());
}

// |x − y|^(1/2): no polynomial near x = y, so nothing is said there; but elsewhere.
TEST(ChebyshevPanels, SaysNothingWhereTheToleranceIsNotMet) {
  const Box<2> box{{0, 0}, {1, 1}};
  const auto function = [](const Plane::Point& x) {
    return Plane::Value{std::sqrt(std::abs(x[0] - x[1])), 0};
  };
  const Plane panels(box, function, {1e-3, 0.05}, 1);
  Stream draw(3, Purpose::tests);
  int without = 0;
  for (int k = 0; k < 2000; ++k) {
    const Plane::Point x = random_point(box, draw);
    const auto found = panels(x);
    if (found) {
      EXPECT_NEAR((*found)[0], function(x)[0], 2e-3);
    } else {
      EXPECT_LT(std::abs(x[0] - x[1]), 0.2);
      ++without;
    }
  }
  EXPECT_GT(without, 20);
  EXPECT_LT(without, 400);
  EXPECT_FALSE(panels({0.5, 0.5}));
}

TEST(ChebyshevPanels, NoValueOutsideTheBoxAndOfWhatIsNoNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Box<2> box{{0, 0}, {1, 1}};
  const auto constant = [](double second) {
    return [second](const Plane::Point&) { return Plane::Value{1, second}; };
  };
  const Plane one(box, constant(1), {}, 1);
  EXPECT_TRUE(one({1, 0}));
  EXPECT_FALSE(one({1.0000001, 0.5}));
  EXPECT_FALSE(one({0.5, -1e-9}));
  EXPECT_FALSE(one({nan, 0.5}));
  const Plane none(box, constant(nan), {1, 0.3}, 1);
  EXPECT_EQ(none.size(), 0);
  EXPECT_FALSE(none({0.5, 0.5}));
}

TEST(ChebyshevPanels, KnowsATreeFromAnythingElse) {
  const Plane panels(
      {{0, 0}, {1, 1}},
      [](const Plane::Point& x) {
        return Plane::Value{std::exp(5 * x[0]), x[1]};
      },
      {1e-8, 1e-3}, 1);
  ASSERT_GT(panels.size(), 1);
  const Plane::Content& content = panels.content();
  EXPECT_TRUE(Plane::is_valid(content));
  const auto spoilt = [&](auto change) {
    Plane::Content other = content;
    change(other);
    return Plane::is_valid(other);
  };
  EXPECT_FALSE(spoilt([](auto& c) { c.nodes.clear(); }));
  EXPECT_FALSE(spoilt([](auto& c) { c.nodes[0].next = 0; }));
  EXPECT_FALSE(spoilt([](auto& c) { c.nodes[0].axis = 2; }));
  EXPECT_FALSE(spoilt([](auto& c) { c.nodes.pop_back(); }));
  EXPECT_FALSE(spoilt([](auto& c) { c.nodes.back().next = 1 << 20; }));
  EXPECT_FALSE(spoilt([](auto& c) { c.panels.pop_back(); }));
}

}  // namespace
}  // namespace vitrel

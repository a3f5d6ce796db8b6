#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/geometry/ellipse.h"
#include "core/geometry/periodic_box.h"
#include "core/random/stream.h"

namespace vitrel {
namespace {

TEST(Ellipse, PerimeterOfACircleAndOfALine) {
  EXPECT_DOUBLE_EQ(perimeter({2, 2}), 4 * std::numbers::pi);
  EXPECT_NEAR(perimeter({1, 1e-9}), 4, 1e-7);
  // 4 a E for κ = 2, with E(m = 3/4) = 1.2110560275684595; the library integral is good to 1e-14.
  EXPECT_NEAR(perimeter({2, 1}), 8 * 1.2110560275684595, 1e-13);
}

TEST(PeriodicBox, WrappingKeepsTheUnwrappedPosition) {
  const PeriodicBox<2> box(Vec2(3, 7));
  Stream draw(1, Purpose::tests);
  for (int trial = 0; trial < 1000; ++trial) {
    const Vec2 far{draw.uniform(-50, 50), draw.uniform(-50, 50)};
    Vec2 position = far;
    Shift<2> image = Shift<2>::Zero();
    box.wrap(position, image);
    for (int k = 0; k < 2; ++k) {
      EXPECT_GE(position[k], -0.5 * box.lengths()[k]);
      EXPECT_LT(position[k], 0.5 * box.lengths()[k]);
    }
    EXPECT_LT((position + box.translation(image) - far).norm(), 1e-13);
  }
}

TEST(PeriodicBox, JustBelowTheLowerFaceStaysInside) {
  const PeriodicBox<2> box(Vec2(2, 2));
  Vec2 position(std::nextafter(-1.0, -2.0), 0);
  Shift<2> image = Shift<2>::Zero();
  box.wrap(position, image);
  EXPECT_LT(position.x(), 1.0);
  EXPECT_GE(position.x(), -1.0);
}

// Every image within reach, and no other, against a plain scan of all shifts.
TEST(PeriodicBox, ImagesWithinReachEqualAScan) {
  Stream draw(2, Purpose::tests);
  for (int trial = 0; trial < 300; ++trial) {
    const PeriodicBox<2> box(Vec2{draw.uniform(0.5, 3), draw.uniform(0.5, 3)});
    const Vec2 d{draw.uniform(-4, 4), draw.uniform(-4, 4)};
    const double reach = draw.uniform(0, 4);
    std::vector<Shift<2>> found;
    box.for_each_image(d, reach, [&](const Shift<2>& shift, const Vec2& separation) {
      EXPECT_LT((d + box.translation(shift) - separation).norm(), 1e-14);
      found.push_back(shift);
    });
    std::vector<Shift<2>> expected;
    for (int x = -20; x <= 20; ++x)
      for (int y = -20; y <= 20; ++y)
        if ((d + box.translation({x, y})).norm() <= reach) expected.push_back({x, y});
    EXPECT_EQ(found, expected);
  }
}

TEST(PeriodicBox, NearestShiftIsTheNearestOfAllImages) {
  Stream draw(3, Purpose::tests);
  const PeriodicBox<2> box(Vec2(2, 5));
  for (int trial = 0; trial < 300; ++trial) {
    const Vec2 d{draw.uniform(-9, 9), draw.uniform(-9, 9)};
    const double nearest = (d + box.translation(box.nearest_shift(d))).norm();
    for (int x = -6; x <= 6; ++x)
      for (int y = -3; y <= 3; ++y)
        EXPECT_LE(nearest, (d + box.translation({x, y})).norm() + 1e-14);
  }
}

}  // namespace
}  // namespace vitrel

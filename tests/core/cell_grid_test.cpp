#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "core/neighbors/cell_grid.h"
#include "core/random/stream.h"

namespace vitrel {
namespace {

using Found = std::tuple<std::size_t, int, int>;

std::vector<Found> near(const CellGrid<2>& grid, const Vec2& position, double reach) {
  std::vector<Found> found;
  grid.for_each_near(position, reach, [&](std::size_t j, const Shift<2>& shift, const Vec2&) {
    found.push_back({j, shift.x(), shift.y()});
  });
  std::sort(found.begin(), found.end());
  return found;
}

// Boxes from a fraction of the reach to many cells, against all images of all points; points are
// moved on the way.
TEST(CellGrid, FindsEveryImageOnceInBoxesOfAnySize) {
  Stream draw(6, Purpose::tests);
  for (double side : {0.4, 1.1, 2.5, 6.0, 40.0}) {
    const PeriodicBox<2> box(Vec2(side, 1.7 * side));
    const double reach = 1;
    const std::size_t n = 60;
    CellGrid<2> grid(box, reach, n);
    std::vector<Vec2> points(n);
    const auto place = [&] {
      return Vec2{draw.uniform(-0.5, 0.5) * side, draw.uniform(-0.5, 0.5) * 1.7 * side};
    };
    for (std::size_t i = 0; i < n; ++i) grid.insert(i, points[i] = place());
    for (std::size_t i = 0; i < 3 * n; i += 2) grid.move(i % n, points[i % n] = place());
    for (int query = 0; query < 200; ++query) {
      const Vec2 at = 1.5 * place();
      const double within = draw.uniform(0.1, 1.5) * reach;
      std::vector<Found> expected;
      for (std::size_t j = 0; j < n; ++j)
        box.for_each_image(points[j] - at, within, [&](const Shift<2>& shift, const Vec2&) {
          expected.push_back({j, shift.x(), shift.y()});
        });
      std::sort(expected.begin(), expected.end());
      ASSERT_EQ(near(grid, at, within), expected);
    }
  }
}

TEST(CellGrid, SeparationsBelongToTheImages) {
  const PeriodicBox<2> box(Vec2(3, 3));
  CellGrid<2> grid(box, 1, 1);
  grid.insert(0, Vec2(1.4, 0));
  int visits = 0;
  grid.for_each_near(Vec2(-1.4, 0), 1, [&](std::size_t, const Shift<2>& shift, const Vec2& d) {
    ++visits;
    EXPECT_EQ(shift, Shift<2>(-1, 0));
    EXPECT_LT((d - Vec2(-0.2, 0)).norm(), 1e-15);
  });
  EXPECT_EQ(visits, 1);
}

// Rounding must lose no point on the faces of cells and box: a lattice whose sites lie on them, and
// reaches of whole numbers of spacings and a little more.
TEST(CellGrid, PointsOnCellFacesAreNotLost) {
  const PeriodicBox<2> box(Vec2(8, 8));
  CellGrid<2> grid(box, 2, 64);
  std::vector<Vec2> points;
  for (int x = -4; x < 4; ++x)
    for (int y = -4; y < 4; ++y) points.push_back(Vec2(x, y));
  for (std::size_t i = 0; i < points.size(); ++i) grid.insert(i, points[i]);
  // Sites of the square lattice within 1, 2 and 3 spacings.
  const std::size_t sites[] = {5, 13, 29};
  for (const Vec2& point : points)
    for (int spacings = 1; spacings <= 3; ++spacings)
      EXPECT_EQ(near(grid, point, spacings * (1 + 1e-15)).size(), sites[spacings - 1]);
}

TEST(CellGrid, AVisitThatReturnsFalseEndsTheQuery) {
  const PeriodicBox<2> box(Vec2(5, 5));
  CellGrid<2> grid(box, 1, 10);
  for (std::size_t i = 0; i < 10; ++i) grid.insert(i, Vec2(0.1 * static_cast<double>(i), 0));
  int visits = 0;
  const auto stop_at_third = [&](std::size_t, const Shift<2>&, const Vec2&) {
    return ++visits < 3;
  };
  EXPECT_FALSE(grid.for_each_near(Vec2::Zero(), 2, stop_at_third));
  EXPECT_EQ(visits, 3);
  const auto never_stop = [](std::size_t, const Shift<2>&, const Vec2&) { return true; };
  EXPECT_TRUE(grid.for_each_near(Vec2::Zero(), 2, never_stop));
}

}  // namespace
}  // namespace vitrel

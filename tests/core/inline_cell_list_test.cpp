// The cell list of the neighbour lists: against all images of all points, in boxes of any size.

#include "core/neighbors/inline_cell_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "core/random/stream.h"

namespace vitrel {
namespace {

template <class D>
class InlineCells : public testing::Test {
 protected:
  static constexpr int dimension = D::value;

  static Vec<dimension> random_position(Stream& draw, const Vec<dimension>& lengths) {
    Vec<dimension> position;
    for (int k = 0; k < dimension; ++k) position[k] = draw.uniform(-0.5, 0.5) * lengths[k];
    return position;
  }
  static Vec<dimension> lengths_of(double side) {
    Vec<dimension> lengths;
    for (int k = 0; k < dimension; ++k) lengths[k] = side * (1 + 0.4 * k);
    return lengths;
  }
};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(InlineCells, Dimensions);

template <int Dim>
std::vector<int> key(std::size_t j, const Shift<Dim>& shift) {
  std::vector<int> numbers{static_cast<int>(j)};
  for (int k = 0; k < Dim; ++k) numbers.push_back(shift[k]);
  return numbers;
}

// Every image in the shell exactly once, others only close to it. Points are inserted where others are, so that cells
// overflow, and moved on the way.
TYPED_TEST(InlineCells, FindEveryImageInTheShellOnce) {
  constexpr int dim = TypeParam::value;
  using Vector = Vec<dim>;
  Stream draw(71, Purpose::tests);
  int found_in_all = 0, outside = 0;
  for (const double side : {0.4, 1.1, 2.5, 6.0, 40.0})
    for (const double min_width : {0.3, 1.0, 5.0}) {
      const Vector lengths = this->lengths_of(side);
      const PeriodicBox<dim> box(lengths);
      constexpr std::size_t n = 60;
      InlineCellList<dim> cells(box, min_width, n);
      std::vector<Vector> points(n);
      for (std::size_t i = 0; i < n; ++i) {
        points[i] = i % 3 == 0 ? Vector(Vector::Constant(0.1 * side))
                               : this->random_position(draw, lengths);
        cells.insert(i, points[i]);
      }
      for (std::size_t k = 0; k < 3 * n; k += 2) {
        const Vector from = points[k % n];
        points[k % n] = this->random_position(draw, lengths);
        cells.move(k % n, from, points[k % n]);
      }
      for (int query = 0; query < 60; ++query) {
        const Vector centre = 1.4 * this->random_position(draw, lengths);
        const double outer = draw.uniform(0.1, 1.5), inner = draw.uniform(-0.3, 1.2) * outer;
        const Vector offset = 0.5 * outer * this->random_position(draw, Vector::Ones());
        const double rounding = 1e-6 * (outer + side + min_width);
        std::set<std::vector<int>> required;
        for (std::size_t j = 0; j < n; ++j)
          box.for_each_image(points[j] - centre, outer,
                             [&](const Shift<dim>& shift, const Vector& d) {
                               if ((d - offset).norm() >= inner)
                                 required.insert(key<dim>(j, shift));
                             });
        std::set<std::vector<int>> found;
        cells.for_each_in_shell(centre, outer, offset, inner,
                                [&](std::size_t j, const Shift<dim>& shift) {
                                  EXPECT_TRUE(found.insert(key<dim>(j, shift)).second) << "twice";
                                  const Vector d = points[j] + box.translation(shift) - centre;
                                  EXPECT_LT(d.norm(), outer + 2 * rounding);
                                  EXPECT_GT((d - offset).norm(), inner - 3 * rounding);
                                  outside += d.norm() > outer;
                                });
        EXPECT_TRUE(std::ranges::includes(found, required));
        found_in_all += static_cast<int>(found.size());
      }
    }
  EXPECT_GT(found_in_all, 10'000);
  EXPECT_LT(outside, found_in_all / 100);
}

// Rounding must lose no point on the faces of cells and box: a lattice whose sites lie on them.
TEST(InlineCellsOnFaces, LoseNoPoint) {
  const PeriodicBox<2> box(Vec2(8, 8));
  InlineCellList<2> cells(box, 1, 64);
  std::vector<Vec2> points;
  for (int x = -4; x < 4; ++x)
    for (int y = -4; y < 4; ++y) points.push_back(Vec2(x, y));
  for (std::size_t i = 0; i < points.size(); ++i) cells.insert(i, points[i]);
  const std::size_t sites[] = {5, 13, 29};  // of the square lattice within 1, 2 and 3 spacings
  for (const Vec2& point : points)
    for (int spacings = 1; spacings <= 3; ++spacings) {
      std::size_t found = 0;
      cells.for_each_in_shell(point, spacings, Vec2::Zero(), 0,
                              [&](std::size_t, const Shift<2>&) { ++found; });
      EXPECT_EQ(found, sites[spacings - 1]);
    }
}

}  // namespace
}  // namespace vitrel

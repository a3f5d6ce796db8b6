// Neighbours from cells: against all images of all points, while the points fly, collide and are displaced.

#include "core/neighbors/cell_neighbors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "core/random/stream.h"

namespace vitrel {
namespace {

template <class B>
class CellsOf : public testing::Test {};
using RoundBodies = testing::Types<Disk, Sphere>;
TYPED_TEST_SUITE(CellsOf, RoundBodies);

/// Points in a box of three to five cells, and their cells.
template <class B>
class Flying {
 public:
  static constexpr int dim = B::dimension;
  using Vector = Vec<dim>;
  using Images = std::multiset<std::vector<int>>;

  Flying() : box_(lengths()), cells_(box_, radius, place()) {
    for (Vector& v : velocity) v = random(1);
  }

  std::size_t size() const { return position.size(); }

  /// A time of flight for all, with all crossings on the way.
  void fly(double duration) {
    const double end = now_ + duration;
    while (true) {
      double first = end;
      std::size_t i = size();
      for (std::size_t k = 0; k < size(); ++k) {
        const double exit = now_ + cells_.exit_time(k, position[k], velocity[k]);
        if (exit < first) first = exit, i = k;
      }
      for (std::size_t k = 0; k < size(); ++k) position[k] += (first - now_) * velocity[k];
      now_ = first;
      if (i == size()) return;
      cross(i);
    }
  }

  /// Displaces a point by up to a cell in each direction.
  void displace(std::size_t i) {
    position[i] += random(1);
    while (cells_.exit_time(i, position[i], velocity[i]) == 0) cross(i);
  }

  /// Another velocity, also of points at a wall.
  void collide(std::size_t i) { velocity[i] = random(1); }

  /// Every image of another point closer than a cell is a neighbour, and none is one twice.
  void expect_complete() {
    for (std::size_t i = 0; i < size(); ++i) {
      const Images found = images(cells_.of(i));
      EXPECT_EQ(found.size(), std::set(found.begin(), found.end()).size());
      for (std::size_t j = 0; j < size(); ++j) {
        if (j == i) continue;
        box_.for_each_image(position[j] - position[i], min_cell_width(radius) * (1 - 2e-6),
                            [&](const Shift<dim>& shift, const Vector&) {
                              EXPECT_TRUE(found.contains(key(j, shift))) << i << ' ' << j;
                              ++near_;
                            });
      }
    }
  }
  int near() const { return near_; }
  int crossed_box() const { return crossed_box_; }

  Vector random(double size) {
    Vector v;
    for (int k = 0; k < dim; ++k) v[k] = draw_.uniform(-size, size);
    return v;
  }
  std::vector<Vector> position, velocity;

 private:
  static constexpr double radius = 0.5;

  static Vector lengths() {
    Vector lengths;
    for (int k = 0; k < dim; ++k) lengths[k] = 3.4 + k;
    return lengths;
  }
  const std::vector<Vector>& place() {
    position.resize(60);
    velocity.resize(60);
    for (Vector& r : position) r = random(0.5).cwiseProduct(lengths());
    return position;
  }
  static std::vector<int> key(std::size_t j, const Shift<dim>& shift) {
    std::vector<int> numbers{static_cast<int>(j)};
    for (int k = 0; k < dim; ++k) numbers.push_back(shift[k]);
    return numbers;
  }
  static Images images(std::span<const Neighbor<B>> neighbors) {
    Images all;
    for (const Neighbor<B>& neighbor : neighbors) all.insert(key(neighbor.other, neighbor.shift()));
    return all;
  }

  // Those gained are new, and with those of before they are all.
  void cross(std::size_t i) {
    const std::vector<Neighbor<B>> before(cells_.of(i).begin(), cells_.of(i).end());
    const auto crossing = cells_.cross(i, position[i], velocity[i]);
    position[i] -= box_.translation(crossing.boxes);
    crossed_box_ += !crossing.boxes.isZero();
    Images kept, gained = images(crossing.gained);
    for (const Neighbor<B>& neighbor : before)
      kept.insert(key(neighbor.other, neighbor.shift() - crossing.boxes));
    for (const auto& image : images(cells_.of(i)))
      EXPECT_EQ(kept.contains(image) + gained.contains(image), 1);
  }

  Stream draw_{23, Purpose::tests};
  PeriodicBox<dim> box_;
  CellNeighbors<B> cells_;
  double now_ = 0;
  int near_ = 0, crossed_box_ = 0;
};

TYPED_TEST(CellsOf, FindAllThatAreNearer) {
  Flying<TypeParam> points;
  for (std::size_t step = 0; step < 60; ++step) {
    points.fly(0.1);
    points.collide(step % points.size());
    points.displace((7 * step) % points.size());
    points.expect_complete();
    if (this->HasFailure()) return;
  }
  EXPECT_GT(points.near(), 10'000);
  EXPECT_GT(points.crossed_box(), 50);
}

TYPED_TEST(CellsOf, APointAtRestStays) {
  Flying<TypeParam> points;
  for (auto& v : points.velocity) v.setZero();
  points.fly(1e9);
  points.expect_complete();
}

TEST(Cells, NeedThreeInEachDirection) {
  EXPECT_TRUE(cells_fit(PeriodicBox<2>(Vec2(3.4, 3.4)), 0.5));
  EXPECT_FALSE(cells_fit(PeriodicBox<2>(Vec2(9, 3.2)), 0.5));
}

}  // namespace
}  // namespace vitrel

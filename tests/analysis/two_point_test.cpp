#include "analysis/structure/two_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/particles_of.h"
#include "tests/support/solids.h"

namespace vitrel {
namespace {

Configuration3 alone(const Ellipsoid& shape, const Vec3& lengths) {
  auto c = particles_of<3>({shape}, lengths);
  c.position[0] = Vec3(0.1, -0.2, 0.3);
  return c;
}

/// The share of a unit sphere that a copy shifted by x overlaps.
double overlap(double x) {
  return x < 2 ? 1 - 0.75 * x + x * x * x / 16 : 0;
}

// One sphere of radius 1, alone up to r = 3 in a box of sides 5 and more: S₂ = L = φ (1 − 3r/4 + r³/16). About 270 points
// span its cross-section; the error of S₂ is the noise of the grid, below a hundredth of φ.
TEST(TwoPoint, OfASphereHasAClosedForm) {
  const Configuration3 c = alone({Vec3(1, 1, 1)}, {5, 5.5, 6});
  const TwoPointStatistics found = TwoPointGrid(c).measure(c);
  const double phi = packing_fraction(c);
  ASSERT_GT(found.distance.size(), 15u);
  EXPECT_EQ(found.distance[0], 0);
  for (std::size_t k = 0; k < found.distance.size(); ++k) {
    const double r = found.distance[k];
    const double truth = phi * overlap(r);
    EXPECT_NEAR(found.probability[k], truth, 0.01 * phi) << r;
    for (const std::vector<double>& path : found.lineal_path) EXPECT_NEAR(path[k], truth, 1e-14);
  }
}

// Along its axis k, an ellipsoid and its copy shifted by r overlap like unit spheres at the distance r/a_k.
TEST(TwoPoint, LinealPathEndsWithTheLongestChord) {
  const Vec3 axes(3, 1, 0.5);
  const Configuration3 c = alone({axes}, {9, 9, 9});
  const double phi = packing_fraction(c);
  const TwoPointStatistics found = TwoPointGrid(c).measure(c);
  for (int axis = 0; axis < 3; ++axis)
    for (std::size_t k = 0; k < found.distance.size(); ++k)
      EXPECT_NEAR(found.lineal_path[axis][k], phi * overlap(found.distance[k] / axes[axis]), 1e-14);
}

bool is_inside(const Configuration3& c, const Vec3& point) {
  const Vec3& lengths = c.box.lengths();
  for (std::size_t i = 0; i < c.size(); ++i) {
    Vec3 d = point - c.position[i];
    d -= d.cwiseQuotient(lengths).array().round().matrix().cwiseProduct(lengths);
    if ((c.orientation[i].conjugate() * d).cwiseQuotient(c.shape[i].semi_axes).squaredNorm() <= 1)
      return true;
  }
  return false;
}
double sampled_probability(const Configuration3& c, double r, int count) {
  Stream draw(7, Purpose::tests);
  int hits = 0;
  for (int k = 0; k < count; ++k) {
    Vec3 point;
    for (int axis = 0; axis < 3; ++axis)
      point[axis] = draw.uniform(-0.5, 0.5) * c.box.lengths()[axis];
    hits += is_inside(c, point) && is_inside(c, point + r * random_direction(draw));
  }
  return static_cast<double>(hits) / count;
}

// Random points, which share no code with the grid. With 100 000 of them the standard error is below √(S₂/100 000);
// 4.9 of them, a false alarm in 1e-6 of the seeds each, and the noise of the grid.
TEST(TwoPoint, AgreesWithRandomPoints) {
  const Configuration3 c = cubic_lattice(
      3, 0.3, [](std::size_t i) { return Ellipsoid{Vec3(i % 2 ? 1.2 : 0.8, 1, 0.7)}; });
  const TwoPointStatistics found = TwoPointGrid(c).measure(c);
  constexpr int count = 100'000;
  for (std::size_t k = 0; k < found.distance.size(); k += 6) {
    const double truth = sampled_probability(c, found.distance[k], count);
    EXPECT_NEAR(found.probability[k], truth, 4.9 * std::sqrt(truth / count) + 0.003)
        << found.distance[k];
  }
}

// S₂ falls off like φ − (s/4) r with the specific surface s. Off the lattice, the spheres lie differently on the grid.
TEST(TwoPoint, FallsOffWithTheSpecificSurface) {
  Configuration3 c = cubic_lattice(4, 0.2, [](std::size_t) { return Ellipsoid{}; });
  Stream draw(5, Purpose::tests);
  for (Vec3& position : c.position) position += 0.3 * random_direction(draw);
  const TwoPointStatistics found = TwoPointGrid(c).measure(c);
  EXPECT_NEAR(found.probability[0], 0.2, 0.002);
  const double surface = 64 * 4 * std::numbers::pi / c.box.volume();
  const double slope = (found.probability[2] - found.probability[0]) / found.distance[2];
  // The next term of φ (1 − 3r/4 + r³/16) makes it flatter by r²/12.
  EXPECT_NEAR(slope / (-surface / 4), 1 - std::pow(found.distance[2], 2) / 12, 0.03);
}

}  // namespace
}  // namespace vitrel

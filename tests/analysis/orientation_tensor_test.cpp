#include "analysis/structure/orientation_tensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/random/stream.h"
#include "tests/support/particles_of.h"
#include "tests/support/solids.h"
#include "tests/support/statistics.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;

/// Prolate bodies along these directions.
Configuration3 along(const std::vector<Vec3>& directions) {
  auto c = particles_of<3>(std::vector<Ellipsoid>(directions.size(), prolate(3)));
  for (std::size_t i = 0; i < c.size(); ++i)
    c.orientation[i] = Quaternion::FromTwoVectors(Vec3::UnitX(), directions[i]);
  return c;
}

void expect_same(const Mat3& matrix, const Mat3& truth) {
  EXPECT_LT((matrix - truth).cwiseAbs().maxCoeff(), 1e-14) << matrix;
}

// A quarter turn about z takes the x axis of the body to y, and y to −x.
TEST(FigureAxis, IsTheAxisOfSymmetryOrTheLongest) {
  const Quaternion turn(std::sqrt(0.5), 0, 0, std::sqrt(0.5));
  const auto expect_axis = [&](const Vec3& semi_axes, const Vec3& axis) {
    EXPECT_NEAR(std::abs(figure_axis({semi_axes}, turn).dot(axis)), 1, 1e-15);
  };
  expect_axis({3, 1, 1}, Vec3::UnitY());
  expect_axis({2, 0.5, 2}, Vec3::UnitX());  // oblate, R_2 = 1: the b axis
  expect_axis({2, 2, 0.5}, Vec3::UnitZ());
  expect_axis({1, 1.2, 0.8}, Vec3::UnitX());
}

TEST(OrientationTensor, OfParallelBodies) {
  const Vec3 w = Vec3(1, 2, -2) / 3;
  const OrientationTensor tensor = orientation_tensor(along({w, -w, w, w}));
  expect_same(tensor.matrix, w * w.transpose());
  EXPECT_EQ(tensor.axes, 4u);
  EXPECT_TRUE(std::isinf(tensor.ratio()));
}

TEST(OrientationTensor, OfTheAxesOfACubeIsIsotropic) {
  const OrientationTensor tensor =
      orientation_tensor(along({Vec3::UnitX(), Vec3::UnitY(), -Vec3::UnitZ()}));
  expect_same(tensor.matrix, Mat3::Identity() / 3);
  EXPECT_NEAR(tensor.ratio(), 1, 1e-14);
}

// Directions at equal angles in a plane of the normal n: (1 − n nᵀ)/2.
TEST(OrientationTensor, OfDirectionsInAPlane) {
  const Vec3 n = Vec3(2, -1, 2) / 3, u = Vec3(1, 2, 0).normalized(), v = n.cross(u);
  std::vector<Vec3> directions;
  for (int k = 0; k < 7; ++k)
    directions.push_back(std::cos(k * pi / 7) * u + std::sin(k * pi / 7) * v);
  const OrientationTensor tensor = orientation_tensor(along(directions));
  expect_same(tensor.matrix, 0.5 * (Mat3::Identity() - n * n.transpose()));
  EXPECT_NEAR(tensor.eigenvalues()[2], 0.5, 1e-14);
  EXPECT_TRUE(std::isinf(tensor.ratio()));
}

// A cone of half-angle α: cos² α along its axis, sin² α/2 across; ρ = 2 cot² α = 6 at 30°.
TEST(OrientationTensor, OfAConeOfDirections) {
  std::vector<Vec3> directions;
  for (int k = 0; k < 5; ++k)
    directions.push_back(
        {std::sqrt(0.75), 0.5 * std::cos(2 * k * pi / 5), 0.5 * std::sin(2 * k * pi / 5)});
  EXPECT_NEAR(orientation_tensor(along(directions)).ratio(), 6, 1e-13);
}

TEST(OrientationTensor, LeavesOutRoundBodies) {
  Configuration3 c = along({Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitZ()});
  c.shape[3] = {Vec3::Constant(1.3)};
  EXPECT_NEAR(orientation_tensor(c).ratio(), 1, 1e-14);
  for (Ellipsoid& body : c.shape) body = {Vec3::Ones()};
  EXPECT_EQ(orientation_tensor(c).axes, 0u);
  EXPECT_TRUE(std::isnan(orientation_tensor(c).ratio()));
}

/// As far as a mean of ρ over packings of randomly turned bodies may be off: 2 % of ρ − 1, and four
/// standard errors.
void expect_mean(std::size_t axes, std::size_t packings) {
  std::vector<double> ratios;
  for (std::size_t packing = 0; packing < packings; ++packing) {
    Stream draw(7, Purpose::tests, packing);
    auto c = particles_of<3>(std::vector<Ellipsoid>(axes, oblate(4)));
    for (Quaternion& orientation : c.orientation) orientation = random_orientation(draw);
    ratios.push_back(orientation_tensor(c).ratio());
  }
  const Estimate found = estimate(ratios);
  const IsotropicRatio isotropic = isotropic_ratio(axes);
  EXPECT_NEAR(found.mean, isotropic.mean, 0.02 * (isotropic.mean - 1) + 4 * found.error) << axes;
  const auto n = static_cast<double>(packings);
  const double deviation = found.error * std::sqrt(n);
  // A deviation of n values is known to about 1/√(2n).
  EXPECT_NEAR(deviation / isotropic.standard_deviation, 1, 0.05 + 4 / std::sqrt(2 * n)) << axes;
}

TEST(IsotropicRatio, IsThatOfRandomlyTurnedBodies) {
  for (const std::size_t axes : {30, 100, 300, 999}) expect_mean(axes, 1500);
  for (const std::size_t axes : {1001, 4000}) expect_mean(axes, 600);
}

// Both ways meet where one takes over. The draws know ρ − 1 to 0.7 %, the deviation to 1.6 %; the next
// orders make the rest.
TEST(IsotropicRatio, DrawnAndExpandedAgreeWhereTheyMeet) {
  const IsotropicRatio drawn = isotropic_ratio(1000), expanded = isotropic_ratio(1001);
  EXPECT_NEAR((drawn.mean - 1) / (expanded.mean - 1), 1, 0.02);
  EXPECT_NEAR(drawn.standard_deviation / expanded.standard_deviation, 1, 0.05);
}

TEST(IsotropicRatio, IsInfiniteForVeryFewAxes) {
  EXPECT_TRUE(std::isinf(isotropic_ratio(4).mean));
  EXPECT_TRUE(std::isfinite(isotropic_ratio(5).mean));
  EXPECT_TRUE(std::isinf(isotropic_ratio(6).standard_deviation));
  EXPECT_TRUE(std::isfinite(isotropic_ratio(7).standard_deviation));
}

}  // namespace
}  // namespace vitrel

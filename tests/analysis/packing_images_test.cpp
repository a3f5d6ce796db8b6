#include "analysis/structure/packing_images.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "tests/support/particles_of.h"
#include "tests/support/random_gas.h"
#include "tests/support/solids.h"

namespace vitrel {
namespace {

Vec3 normal_vector(Stream& draw) {
  return {draw.normal(), draw.normal(), draw.normal()};
}

/// Ellipsoids anywhere in a box that the longest of them nearly fill; overlaps do not matter here.
Configuration3 random_solids(std::size_t n, double longest) {
  Stream draw(3, Purpose::tests);
  return random_gas<3>(n, {2, 3, 2.5}, draw, [&](Configuration3& c, std::size_t i) {
    c.orientation[i] = random_orientation(draw);
    c.shape[i] = {
        Vec3{draw.uniform(0.05, longest), draw.uniform(0.05, 0.5), draw.uniform(0.05, 0.5)}};
  });
}

/// (x − r)ᵀ Σ⁻¹ (x − r), in the body's own axes.
double value_at(const Ellipsoid& body, const Pose3& pose, const Vec3& x) {
  return (pose.orientation.conjugate() * (x - pose.position))
      .cwiseQuotient(body.semi_axes)
      .squaredNorm();
}

/// Its minimum in the box by descent along one coordinate after the other, which converges to the
/// least of a convex function between bounds on the coordinates.
double min_by_descent(const Ellipsoid& body, const Pose3& pose, const PeriodicBox<3>& box) {
  const Mat3 inverse = shape_matrix(body, pose.orientation).inverse();
  Vec3 x = Vec3::Zero();
  for (int sweep = 0; sweep < 100'000; ++sweep) {
    const Vec3 before = x;
    for (int k = 0; k < 3; ++k) {
      const double slope = inverse.row(k).dot(x - pose.position);
      const double half = 0.5 * box.lengths()[k];
      x[k] = std::clamp(x[k] - slope / inverse(k, k), -half, half);
    }
    if (x == before) break;
  }
  return value_at(body, pose, x);
}

TEST(HalfExtents, AreTheFarthestPointsOfTheSurface) {
  Stream draw(5, Purpose::tests);
  const Ellipsoid body{Vec3(2, 0.3, 0.7)};
  const Quaternion q = random_orientation(draw);
  Vec3 farthest = Vec3::Zero();
  for (int k = 0; k < 200'000; ++k) {
    const Vec3 point = q * body.semi_axes.cwiseProduct(normal_vector(draw).normalized());
    farthest = farthest.cwiseMax(point);
  }
  const Vec3 extents = half_extents(body, q);
  EXPECT_TRUE((farthest.array() <= extents.array() * (1 + 1e-15)).all());
  // The nearest of n random directions misses by an angle of about 2/√n, the extent by its square.
  EXPECT_TRUE((farthest.array() > extents.array() * (1 - 1e-3)).all());
}

// Spheres about a corner, an edge and a face: the distance to the box is known.
TEST(MeetsBox, SpheresAtTheirDistance) {
  const PeriodicBox<3> box(Vec3(2, 4, 6));
  const Vec3 corner(1, 2, 3);
  for (const Vec3& off : {Vec3(0.3, 0, 0), Vec3(0.3, 0.4, 0), Vec3(0.2, 0.3, 0.6)})
    for (const double sign : {-1.0, 1.0}) {
      Vec3 centre = sign * (corner + off);
      for (int k = 0; k < 3; ++k)
        if (off[k] == 0) centre[k] = 0.1;
      const Pose3 pose{centre, Quaternion::Identity()};
      EXPECT_TRUE(meets_box({Vec3::Constant(off.norm() * (1 + 1e-14))}, pose, box));
      EXPECT_FALSE(meets_box({Vec3::Constant(off.norm() * (1 - 1e-14))}, pose, box));
    }
}

// A needle that passes the corner: its extents meet all three faces, the body none of them.
TEST(MeetsBox, ANeedleThatPassesTheCorner) {
  const PeriodicBox<3> box(Vec3(2, 2, 2));
  const Ellipsoid needle{Vec3(1, 0.05, 0.05)};
  const Quaternion turned(Eigen::AngleAxisd(-0.785, Vec3::UnitZ()));
  const Pose3 past{Vec3(1.05, 1.05, 0), turned}, near{Vec3(1.03, 1.03, 0), turned};
  const Vec3 extents = half_extents(needle, turned);
  EXPECT_GT(extents.x(), 0.05);
  EXPECT_GT(extents.y(), 0.05);
  EXPECT_FALSE(meets_box(needle, past, box));
  EXPECT_TRUE(meets_box(needle, near, box));
}

TEST(MeetsBox, AgreesWithDescentAlongTheCoordinates) {
  Stream draw(7, Purpose::tests);
  const PeriodicBox<3> box(Vec3(2, 3, 2.5));
  int meeting = 0, clear = 0;
  for (int k = 0; k < 3000; ++k) {
    const Ellipsoid body{
        Vec3{draw.uniform(0.05, 2), draw.uniform(0.05, 1), draw.uniform(0.05, 0.5)}};
    const Pose3 pose{1.5 * normal_vector(draw), random_orientation(draw)};
    const double least = min_by_descent(body, pose, box);
    EXPECT_GT(std::abs(least - 1), 1e-7) << "undecided";
    EXPECT_EQ(meets_box(body, pose, box), least < 1) << k;
    ++(least < 1 ? meeting : clear);
  }
  EXPECT_GT(meeting, 500);
  EXPECT_GT(clear, 500);
}

using Key = std::tuple<std::size_t, int, int, int>;

// Every body that holds a random point of the box is listed, and every body listed is seen to meet it.
TEST(BodiesInBox, AreThoseThatHoldPointsOfTheBox) {
  const Configuration3 packing = random_solids(60, 1.6);
  const Vec3& lengths = packing.box.lengths();
  std::set<Key> listed;
  std::size_t cut = 0;
  for (const BodyInBox& body : bodies_in_box(packing)) {
    listed.emplace(body.particle, body.shift.x(), body.shift.y(), body.shift.z());
    const Pose3 pose{packing.position[body.particle] + packing.box.translation(body.shift),
                     packing.orientation[body.particle]};
    EXPECT_LT(min_by_descent(packing.shape[body.particle], pose, packing.box), 1);
    cut += body.is_cut;
  }
  EXPECT_EQ(listed.size(), bodies_in_box(packing).size()) << "one listed twice";
  for (std::size_t i = 0; i < packing.size(); ++i) EXPECT_TRUE(listed.contains({i, 0, 0, 0})) << i;
  EXPECT_GT(cut, 60u);
  Stream draw(9, Purpose::tests);
  double covered = 0;
  constexpr int points = 4000;
  for (int k = 0; k < points; ++k) {
    const Vec3 x = lengths.cwiseProduct(
        Vec3{draw.uniform(-0.5, 0.5), draw.uniform(-0.5, 0.5), draw.uniform(-0.5, 0.5)});
    for (std::size_t i = 0; i < packing.size(); ++i)
      packing.box.for_each_image(x - packing.position[i], 1.7, [&](const Shift<3>& s, const Vec3&) {
        const Pose3 pose{packing.position[i] + packing.box.translation(-s), packing.orientation[i]};
        if (value_at(packing.shape[i], pose, x) > 1) return;
        EXPECT_TRUE(listed.contains({i, -s.x(), -s.y(), -s.z()})) << i;
        ++covered;
      });
  }
  // All bodies together hold a point as often as they cover the box; the number per point varies about
  // like Poisson's, so 5 standard errors are a false alarm in 6e-7 of the seeds.
  const double mean = packing_fraction(packing);
  EXPECT_NEAR(covered / points, mean, 5 * std::sqrt(2 * mean / points));
}

TEST(BodiesInBox, ABodyAcrossOppositeFaces) {
  const auto bodies = bodies_in_box(particles_of<3>({{Vec3(1.2, 0.1, 0.1)}}, {2, 2, 2}));
  ASSERT_EQ(bodies.size(), 3u);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(bodies[k].shift, Shift<3>(k - 1, 0, 0));
    EXPECT_TRUE(bodies[k].is_cut);
  }
}

// A sphere of radius 1 in a box of 10: seen from a face, an edge or a corner it is as far from touching as
// its distance says.
TEST(GrazingDistance, OfASphereFollowsFromItsPlace) {
  const auto distance = [](const Vec3& place, const Vec3& cut = Vec3::Zero()) {
    auto sphere = particles_of<3>({{Vec3::Ones()}}, {10, 10, 10});
    sphere.position[0] = place;
    return grazing_distance(sphere, cut);
  };
  EXPECT_NEAR(distance({4.7, 0, 0}), 0.7, 1e-14);
  EXPECT_NEAR(distance({4.7, 0, 0}, {0.8, 0, 0}), 0.1, 1e-14);
  EXPECT_NEAR(distance({4.4, -4.2, 0}), 0, 1e-14) << "0.6² + 0.8² = 1";
  // Faces: 0.9, 0.2, 0.7; edges and the corner: √0.65, √0.10, √0.73 and √0.74.
  EXPECT_NEAR(distance({4.9, 4.2, -4.7}), 1 - std::sqrt(0.74), 1e-14);
  EXPECT_EQ(distance({0, 0, 0}), 1);
}

TEST(CleanCut, IsFartherFromGrazingThanRandomTranslations) {
  Configuration3 packing = random_solids(20, 0.5);
  const double chosen = grazing_distance(packing, clean_cut(packing));
  Stream draw(11, Purpose::tests);
  for (int k = 0; k < 100; ++k)
    EXPECT_GT(chosen, grazing_distance(packing, 10 * normal_vector(draw)));
}

}  // namespace
}  // namespace vitrel

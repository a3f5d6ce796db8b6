// Capsules hold their ellipsoids, and are told apart exactly when they are apart.

#include "core/geometry/capsule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random/stream.h"
#include "tests/support/overlap_criteria.h"
#include "tests/support/solids.h"

namespace vitrel {
namespace {

// The nearest points by trying all pieces: ends against segments, and the lines.
double distance_of_segments(const Vec3& h1, const Vec3& h2, const Vec3& d) {
  const auto to_segment = [](const Vec3& point, const Vec3& half) {
    const double t = half.squaredNorm() > 0 ? point.dot(half) / half.squaredNorm() : 0;
    return (point - std::clamp(t, -1., 1.) * half).norm();
  };
  double least = std::min({to_segment(d + h2, h1), to_segment(d - h2, h1), to_segment(h1 - d, h2),
                           to_segment(-h1 - d, h2)});
  const Vec3 normal = h1.cross(h2);
  const double square = normal.squaredNorm();
  if (square > 1e-12 * h1.squaredNorm() * h2.squaredNorm()) {
    const double s = d.cross(h2).dot(normal) / square, t = d.cross(h1).dot(normal) / square;
    if (std::abs(s) <= 1 && std::abs(t) <= 1)
      least = std::min(least, std::abs(d.dot(normal)) / std::sqrt(square));
  }
  return least;
}

TEST(Capsules, HoldTheirEllipsoids) {
  Stream draw(1, Purpose::tests, 700);
  double tightest = 1;
  for (int n = 0; n < 20'000; ++n) {
    const Ellipsoid body = random_ellipsoid(draw, 30);
    const Quaternion q = random_orientation(draw);
    const double size = draw.uniform(0.5, 2);
    const Capsule capsule = CapsuleOf(body).at(q, size);
    const Vec3 axis = random_direction(draw);
    const double room =
        std::abs(capsule.half.dot(axis)) + capsule.radius - size * support_function(body, q, axis);
    ASSERT_GE(room, -1e-14 * capsule.radius);
    tightest = std::min(tightest, room / capsule.radius);
  }
  EXPECT_LT(tightest, 1e-3);
}

TEST(Capsules, AreToldApartWhenTheyAre) {
  Stream draw(2, Purpose::tests, 700);
  int apart = 0;
  for (int n = 0; n < 200'000; ++n) {
    const double length1 = std::pow(10, draw.uniform(-1, 2)),
                 length2 = std::pow(10, draw.uniform(-1, 2));
    Capsule one{length1 * random_direction(draw), draw.uniform(0.1, 1)};
    Capsule two{length2 * random_direction(draw), draw.uniform(0.1, 1)};
    if (n % 10 == 0) one.half = Vec3::Zero();
    if (n % 10 >= 7) {  // nearly parallel, to any degree
      const double deviation = std::pow(10, draw.uniform(-17, -1));
      two.half =
          length2 * (one.half.normalized() + deviation * random_direction(draw)).normalized();
    }
    const Vec3 d = random_vector(draw, 0, 1.5 * (length1 + length2));
    const double reach = one.radius + two.radius,
                 truth = distance_of_segments(one.half, two.half, d);
    const double limit =
        n % 2 ? draw.uniform(0, 5) : std::max(0., truth * (1 + draw.uniform(-1e-6, 1e-6)) - reach);
    const bool said = farther_apart(one, two, d, limit);
    if (said) ++apart;
    ASSERT_FALSE(said && truth < (reach + limit) * (1 - 1e-12));
    ASSERT_TRUE(said || truth < (reach + limit) * (1 + 1e-5) + 2e-4 * (length1 + length2));
  }
  EXPECT_GT(apart, 50'000);
  EXPECT_LT(apart, 180'000);
}

}  // namespace
}  // namespace vitrel

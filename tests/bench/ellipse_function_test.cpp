#include "bench/methods/ellipses/ellipse_function.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/free_flight.h"
#include "core/random/stream.h"

namespace vitrel::bench {
namespace {

Flight<Ellipse> random_flight(Stream& draw) {
  const double b = draw.uniform(0.2, 1);
  return {{b * draw.uniform(1, 4), b},
          {{draw.uniform(-1, 1), draw.uniform(-1, 1)}, draw.uniform(-4, 4)},
          {{draw.normal(), draw.normal()}, draw.normal()}};
}

TEST(EllipseFunction, IsZeroOnTheBoundaryAndMinusOneAtTheCentre) {
  const Flight<Ellipse> flight{{3, 1}, {{0.5, -0.2}, 0.7}, {{1, 2}, -0.3}};
  const Pose2 pose = advanced(flight.pose, flight.motion, 0.4);
  EXPECT_NEAR(ellipse_function(flight, 0.4, pose.position).value, -1, 1e-15);
  const Vec2 tip = pose.position + 3 * Vec2(std::cos(pose.angle), std::sin(pose.angle));
  EXPECT_NEAR(ellipse_function(flight, 0.4, tip).value, 0, 1e-14);
}

// Central differences of the value give the gradient, those of the gradient the Hessian.
TEST(EllipseFunction, DerivativesEqualDifferences) {
  Stream draw(7, Purpose::tests);
  for (int trial = 0; trial < 200; ++trial) {
    const Flight<Ellipse> flight = random_flight(draw);
    const Vec3 at{draw.uniform(-1, 1), draw.uniform(-2, 2), draw.uniform(-2, 2)};
    const auto e = [&](const Vec3& y) { return ellipse_function(flight, y[0], y.tail<2>()); };
    const EllipseFunction exact = e(at);
    const double h = 1e-5;
    for (int k = 0; k < 3; ++k) {
      const Vec3 step = h * Vec3::Unit(k);
      const double scale = 1 + exact.hessian.norm() + exact.gradient.norm();
      EXPECT_NEAR((e(at + step).value - e(at - step).value) / (2 * h), exact.gradient[k],
                  1e-6 * scale);
      const Vec3 column = (e(at + step).gradient - e(at - step).gradient) / (2 * h);
      EXPECT_LT((column - exact.hessian.col(k)).norm(), 1e-6 * scale);
    }
  }
}

}  // namespace
}  // namespace vitrel::bench

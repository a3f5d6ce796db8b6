#include "bench/methods/ellipses/unit_circle.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/methods/first_root.h"
#include "bench/methods/opening.h"

#include "core/geometry/free_flight.h"

namespace vitrel::bench {
namespace {

Mat2 rotation(double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  Mat2 turn;
  turn << c, -s, s, c;
  return turn;
}

double min_eigenvalue(const Mat2& s, const Vec2& g) {
  const double length = g.norm();
  const Vec2 e = g.normalized();  // 0 if g = 0
  Eigen::Matrix4d matrix;
  matrix << s, -length * Mat2::Identity(), -length * e * e.transpose(), s;
  thread_local Eigen::EigenSolver<Eigen::Matrix4d> solver;
  solver.compute(matrix, false);
  if (solver.info() != Eigen::Success) return std::numeric_limits<double>::quiet_NaN();
  return solver.eigenvalues().real().minCoeff();
}

struct Transformed {
  Mat2 to_circle;  // the matrix T
  Vec2 c;
  Mat2 m;
};

Transformed transformed(const CollisionCase& asked, double time) {
  const Pose2 pose1 = advanced(asked.one.pose, asked.one.motion, time);
  const Pose2 pose2 = advanced(asked.two.pose, asked.two.motion, time);
  const Ellipse one = body_at(asked.one, time);
  const Ellipse two = body_at(asked.two, time);
  const Mat2 to_circle =
      Vec2(1 / one.a, 1 / one.b).asDiagonal() * rotation(pose1.angle).transpose();
  return {to_circle, to_circle * (pose2.position - pose1.position),
          to_circle * rotation(pose2.angle) * Vec2(two.a, two.b).asDiagonal()};
}

}  // namespace

ClosestPoint closest_to_origin(const Vec2& c, const Mat2& m) {
  const Mat2 s = m.transpose() * m;
  const Vec2 g = m.transpose() * c;
  const double mu = min_eigenvalue(s, g);
  Eigen::SelfAdjointEigenSolver<Mat2> basis;
  basis.computeDirect(s);
  const Vec2 lambda = basis.eigenvalues();  // in ascending order
  const Vec2 along = basis.eigenvectors().transpose() * g;

  Vec2 w = -along.cwiseQuotient(lambda - Vec2::Constant(mu));
  // The second denominator is the larger one. If the first is lost in rounding, |w| = 1 gives its component.
  if (!(lambda[0] - mu > 1e-7 * lambda[1])) {
    w[1] = lambda[1] > mu ? std::clamp(w[1], -1.0, 1.0) : 0.0;
    w[0] = std::copysign(std::sqrt((1 - w[1]) * (1 + w[1])), -along[0]);
  }
  const Vec2 point = c + m * (basis.eigenvectors() * w.normalized());
  const bool origin_inside = m.fullPivLu().solve(c).squaredNorm() < 1;
  return {origin_inside ? -point.norm() : point.norm(), point};
}

Prediction2 unit_circle(const CollisionCase& asked, double tolerance) {
  const Opening opening = open_search(asked);
  if (opening.answer) return *opening.answer;
  const auto excess = [&](double time) {
    const Transformed t = transformed(asked, time);
    return closest_to_origin(t.c, t.m).distance - 1;
  };
  const RootSearch search = first_root(excess, opening.bracket, tolerance);
  if (!search.time) return without_contact(Outcome::none, search.evaluations);

  const double time = *search.time;
  const Transformed t = transformed(asked, time);
  const Vec2 closest = closest_to_origin(t.c, t.m).point.normalized();
  const Vec2 centre = asked.one.pose.position + asked.one.motion.velocity * time;
  return contact_along(t.to_circle.transpose() * closest, time,
                       centre + t.to_circle.inverse() * closest, search.evaluations);
}

}  // namespace vitrel::bench

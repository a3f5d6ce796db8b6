// The series of Euler's equations against conservation laws, closed forms and a slow integration.

#include "bench/reference/taylor_top.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bench/surveys/drawn_class.h"
#include "core/geometry/asymmetric_top.h"
#include "core/random/stream.h"

namespace vitrel::bench {
namespace {

using Real = TaylorTop::Real;
using Vector = TaylorTop::Vector;
using Matrix = TaylorTop::Matrix;

constexpr Real rounding = std::numeric_limits<Real>::epsilon();
const Ellipsoid scalene{Vec3(1, 2.5, 0.6)};

/// Moments over the mass, in 80 bits.
Vector moments_of(const Ellipsoid& shape) {
  const Vector squares = shape.semi_axes.cast<Real>().cwiseAbs2();
  return (Vector::Constant(squares.sum()) - squares) / 5;
}

struct Conserved {
  Vector momentum;
  Real energy;
};
Conserved conserved(const TaylorTop& top, const Ellipsoid& shape, Real time) {
  const TaylorTop::State now = top.at(time);
  const Vector own = now.axes.transpose() * now.angular_velocity;
  const Vector momentum = moments_of(shape).cwiseProduct(own);
  return {now.axes * momentum, momentum.dot(own) / 2};
}

Quaternion any_orientation(Stream& draw) {
  return Quaternion{draw.normal(), draw.normal(), draw.normal(), draw.normal()}.normalized();
}

// Some 40 units in the last place of 80 bits, after hundreds of steps; also where the body turns backwards in time.
TEST(TaylorTop, ConservesMomentumAndEnergyTo1em17) {
  Stream draw(1, Purpose::tests);
  for (int trial = 0; trial < 20; ++trial) {
    const Ellipsoid shape{Vec3{draw.uniform(1, 20), draw.uniform(1, 20), 1}};
    const double end = trial % 2 == 0 ? 20 : -20;
    const TaylorTop top{shape, any_orientation(draw), 3 * thermal_vector<3>(draw), end};
    const Conserved start = conserved(top, shape, 0);
    for (int k = 1; k <= 10; ++k) {
      const Conserved now = conserved(top, shape, 0.1L * k * end);
      EXPECT_LE((now.momentum - start.momentum).norm(), 1e-17L * start.momentum.norm());
      EXPECT_NEAR(static_cast<double>(now.energy / start.energy - 1), 0, 1e-17);
      const Real speed = top.at(0.1L * k * end).angular_velocity.norm();
      EXPECT_LE(speed, top.speed_bound() * (1 + 4 * rounding));
    }
  }
}

// Rodrigues' formula, in closed form.
TEST(TaylorTop, RotatesUniformlyAboutAPrincipalAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    constexpr Real time = 7.25L, speed = 3;
    const TaylorTop top(scalene, Quaternion::Identity(), speed * Vec3::Unit(axis), time);
    Matrix expected = Matrix::Identity();
    const int j = (axis + 1) % 3, k = (axis + 2) % 3;
    expected(j, j) = expected(k, k) = std::cos(speed * time);
    expected(k, j) = std::sin(speed * time);
    expected(j, k) = -expected(k, j);
    EXPECT_LE((top.at(time).axes - expected).norm(), 10 * rounding * speed * time) << axis;
    EXPECT_EQ(top.at(time).angular_velocity, speed * Vector::Unit(axis));
  }
}

// A spheroid with its own moments: ω precesses about the axis of symmetry at (I₃ − I₁)/I₁ ω₃ in the frame of the body, and
// the body rotates about L at L/I₁ as it precesses.
TEST(TaylorTop, PrecessesAsASymmetricTop) {
  const Ellipsoid disk{Vec3(2, 2, 0.5)};
  const Vec3 omega(0.75, 0, 1.5);
  constexpr Real time = 9.5L;
  const TaylorTop top(disk, Quaternion::Identity(), omega, time);
  const Vector moments = moments_of(disk), momentum = moments.cwiseProduct(omega.cast<Real>());
  const Real precession = (moments[2] - moments[0]) / moments[0] * omega[2];
  using Turn = Eigen::AngleAxis<Real>;
  const Matrix expected =
      (Turn(momentum.norm() / moments[0] * time, Vector(momentum.normalized())) *
       Turn(-precession * time, Vector::UnitZ()))
          .toRotationMatrix();
  EXPECT_LE((top.at(time).axes - expected).norm(), 200 * rounding);
}

// Series of other starts, one of them reversed in time: the same state whatever the nodes. The estimate of the sensitivity
// says how far rounding at the new start carries.
TEST(TaylorTop, ContinuesItself) {
  Stream draw(2, Purpose::tests);
  for (int trial = 0; trial < 20; ++trial) {
    const Quaternion orientation = any_orientation(draw);
    const Vec3 omega = 2 * thermal_vector<3>(draw);
    const TaylorTop whole(scalene, orientation, omega, 6);
    const TaylorTop::State middle = whole.at(3);
    const TaylorTop second(scalene, Quaternion(middle.axes.cast<double>()).normalized(),
                           middle.angular_velocity.cast<double>(), -3);
    constexpr double stored = std::numeric_limits<double>::epsilon();
    EXPECT_LE((second.at(-3).axes - whole.at(0).axes).norm(),
              8 * stored * (1 + second.sensitivity(3)));
  }
}

// Two solutions that share nothing. The closed form rounds to doubles.
TEST(TaylorTop, AgreesWithTheClosedForm) {
  Stream draw(3, Purpose::tests);
  for (int trial = 0; trial < 200; ++trial) {
    const Ellipsoid shape{Vec3{draw.uniform(1, 10), 1, draw.uniform(1, 10)}};
    const Quaternion orientation = any_orientation(draw);
    const Vec3 omega = thermal_vector<3>(draw);
    const TaylorTop series(shape, orientation, omega, 10);
    const AsymmetricTop closed(shape, orientation, omega);
    for (int k = 0; k <= 10; ++k) {
      const double allowed = 32 * std::numeric_limits<double>::epsilon() *
                             (1 + static_cast<double>(series.sensitivity(k)));
      EXPECT_LE((series.at(k).axes.cast<double>() - closed.at(k).axes).norm(), allowed)
          << trial << ' ' << k;
    }
  }
}

TEST(TaylorTop, BodiesAtRestStay) {
  const TaylorTop top(scalene, Quaternion::Identity(), Vec3::Zero(), 1e10L);
  EXPECT_EQ(top.at(1e10L).axes, Matrix::Identity());
  EXPECT_EQ(top.speed_bound(), 0);
}

}  // namespace
}  // namespace vitrel::bench

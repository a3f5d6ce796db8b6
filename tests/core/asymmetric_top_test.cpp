// Free rotation in closed form, against Euler's equations integrated in extended precision.

#include "core/geometry/asymmetric_top.h"
#include "core/geometry/free_flight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/support/solids.h"

namespace vitrel {
namespace {

using Real = long double;
using RealVector = Eigen::Matrix<Real, 3, 1>;
using RealQuaternion = Eigen::Quaternion<Real>;

/// The angular velocity in the axes of the body, and its orientation, by Taylor series in time.
class Integration {
 public:
  Integration(const Ellipsoid& shape, const Quaternion& orientation, const Vec3& angular_velocity)
      : inertia_(shape.inertia_per_mass().cast<Real>()),
        q_(orientation.cast<Real>().normalized()),
        omega_(q_.conjugate() * angular_velocity.cast<Real>()) {}

  void advance(Real time) {
    const int steps = 1 + static_cast<int>(8 * std::abs(time) * speed_bound());
    for (int k = 0; k < steps; ++k) step(time / steps);
  }

  Mat3 axes() const { return q_.toRotationMatrix().cast<double>(); }
  Vec3 angular_velocity() const { return (q_ * omega_).cast<double>(); }

  // Changes every number of the state by one unit in the last place of its vector.
  void disturb(Stream& draw) {
    const Real unit = 0x1p-52;
    const auto up_or_down = [&] { return draw.uniform(-1, 1) < 0 ? -unit : unit; };
    const Real size = omega_.norm();
    for (Real& w : omega_) w += up_or_down() * size;
    for (Real& x : q_.coeffs()) x += up_or_down();
    q_.normalize();
  }

  Real separatrix_distance() const {
    std::array<Real, 3> moments{inertia_[0], inertia_[1], inertia_[2]};
    std::ranges::sort(moments);
    const Real twice_energy = inertia_.dot(RealVector(omega_.cwiseAbs2()));
    return std::abs(inertia_.cwiseProduct(omega_).squaredNorm() / (twice_energy * moments[1]) - 1);
  }

 private:
  static constexpr int order = 24;

  Real speed_bound() const { return inertia_.cwiseProduct(omega_).norm() / inertia_.minCoeff(); }

  void step(Real h) {
    std::array<RealVector, order + 1> w;
    std::array<RealQuaternion, order + 1> q;
    w[0] = omega_;
    q[0] = q_;
    for (int n = 0; n < order; ++n) {
      RealVector torque = RealVector::Zero();
      RealQuaternion rate(0, 0, 0, 0);
      for (int k = 0; k <= n; ++k) {
        torque += inertia_.cwiseProduct(w[k]).cross(w[n - k]);
        rate.coeffs() += (q[k] * RealQuaternion(0, w[n - k][0], w[n - k][1], w[n - k][2])).coeffs();
      }
      w[n + 1] = torque.cwiseQuotient(inertia_) / (n + 1);
      q[n + 1].coeffs() = rate.coeffs() / (2 * (n + 1));
    }
    omega_ = w[order];
    q_ = q[order];
    for (int n = order - 1; n >= 0; --n) {
      omega_ = omega_ * h + w[n];
      q_.coeffs() = q_.coeffs() * h + q[n].coeffs();
    }
    q_.normalize();
  }

  RealVector inertia_;
  RealQuaternion q_;
  RealVector omega_;
};

double difference(const AsymmetricTop::State& one, const Integration& two) {
  return std::max(
      (one.axes - two.axes()).cwiseAbs().maxCoeff(),
      (one.angular_velocity - two.angular_velocity()).norm() / one.angular_velocity.norm());
}

struct Body {
  Ellipsoid shape;
  Quaternion orientation;
  Vec3 angular_velocity;

  AsymmetricTop top() const { return {shape, orientation, angular_velocity}; }
  Integration integration() const { return {shape, orientation, angular_velocity}; }
};

Body random_body(Stream& draw) {
  return {random_ellipsoid(draw, 10), random_orientation(draw),
          draw.uniform(0.1, 3) * random_direction(draw)};
}

int middle_axis(const Ellipsoid& shape) {
  const Vec3& axes = shape.semi_axes;
  for (int k = 0; k < 3; ++k)
    if (axes[k] > axes.minCoeff() && axes[k] < axes.maxCoeff()) return k;
  return Ellipsoid::none;
}

// Almost about the middle axis, by down to 1e-12.
Body near_the_separatrix(Stream& draw) {
  Body body = random_body(draw);
  Vec3 own = std::pow(10, draw.uniform(-12, -1)) * random_direction(draw);
  own[middle_axis(body.shape)] = 1;
  body.angular_velocity = body.orientation * own;
  return body;
}

TEST(AsymmetricTop, MovesByEulersEquations) {
  Stream draw(1, Purpose::tests);
  int tested = 0;
  for (int k = 0; k < 150; ++k) {
    const Body body = random_body(draw);
    Integration truth = body.integration();
    if (truth.separatrix_distance() < 1e-3) continue;
    ++tested;
    const AsymmetricTop top = body.top();
    double time = 0;
    EXPECT_LT(difference(top.at(0), truth), 1e-14);
    for (int step = 0; step < 5; ++step) {
      const double wait = draw.uniform(-1, 4);
      truth.advance(wait);
      time += wait;
      EXPECT_LT(difference(top.at(time), truth), 1e-10);
    }
  }
  EXPECT_GT(tested, 120);
}

// Near the separatrix the motion amplifies the rounding of its initial state. A phase of up to a hundred radians is
// rounded, too.
TEST(AsymmetricTop, IsAsGoodAsItsInitialStateNearTheSeparatrix) {
  Stream draw(2, Purpose::tests);
  int near = 0;
  for (int k = 0; k < 60; ++k) {
    const Body body = near_the_separatrix(draw);
    Integration truth = body.integration();
    near += truth.separatrix_distance() < 1e-3;
    const double time = draw.uniform(0, 30);
    double effect = 0;
    std::vector<Integration> disturbed(4, truth);
    truth.advance(time);
    for (Integration& other : disturbed) {
      other.disturb(draw);
      other.advance(time);
      effect = std::max({effect, (other.axes() - truth.axes()).cwiseAbs().maxCoeff(),
                         (other.angular_velocity() - truth.angular_velocity()).norm() /
                             truth.angular_velocity().norm()});
    }
    EXPECT_LT(difference(body.top().at(time), truth), 10 * effect + 1e-13);
  }
  EXPECT_GT(near, 30);
}

// Over a thousand rotations, at any instant.
TEST(AsymmetricTop, ConservesAngularMomentumAndEnergy) {
  Stream draw(3, Purpose::tests);
  for (int k = 0; k < 200; ++k) {
    const Body body = k % 4 == 0 ? near_the_separatrix(draw) : random_body(draw);
    const Vec3 inertia = body.shape.inertia_per_mass();
    const AsymmetricTop top = body.top();
    const auto momentum_and_energy = [&](double time) {
      const AsymmetricTop::State state = top.at(time);
      const Vec3 own = state.axes.transpose() * state.angular_velocity;
      const Vec3 momentum = inertia.cwiseProduct(own);
      return std::pair<Vec3, double>(state.axes * momentum, momentum.dot(own));
    };
    const auto [momentum, energy] = momentum_and_energy(0);
    for (int sample = 0; sample < 50; ++sample) {
      const double time = draw.uniform(0, 1000) * 6.28 / body.angular_velocity.norm();
      const auto [later, later_energy] = momentum_and_energy(time);
      EXPECT_LT((later - momentum).norm(), 1e-12 * momentum.norm());
      EXPECT_NEAR(later_energy, energy, 1e-12 * energy);
    }
  }
}

TEST(AsymmetricTop, RatesAreDerivativesAndSpeedsAreBounded) {
  Stream draw(4, Purpose::tests);
  double fastest = 0;
  for (int k = 0; k < 200; ++k) {
    const Body body = random_body(draw);
    const AsymmetricTop top = body.top();
    const double limit = top.max_speed();
    const double acceleration = AsymmetricTop::max_acceleration_factor(body.shape) * limit * limit;
    for (int sample = 0; sample < 100; ++sample) {
      const double time = draw.uniform(0, 50) / limit, h = 1e-5 / limit;
      const AsymmetricTop::State now = top.at(time), before = top.at(time - h),
                                 after = top.at(time + h);
      EXPECT_LE(now.angular_velocity.norm(), limit * (1 + 1e-14));
      EXPECT_LE(now.angular_acceleration.norm(), acceleration * (1 + 1e-13));
      fastest = std::max(fastest, now.angular_velocity.norm() / limit);
      const Vec3 rate = (after.angular_velocity - before.angular_velocity) / (2 * h);
      EXPECT_LT((rate - now.angular_acceleration).norm(),
                1e-8 * acceleration + 1e-9 * limit * limit);
      for (int axis = 0; axis < 3; ++axis) {
        const Vec3 turning = (after.axes.col(axis) - before.axes.col(axis)) / (2 * h);
        EXPECT_LT((turning - now.angular_velocity.cross(now.axes.col(axis))).norm(), 1e-8 * limit);
      }
    }
  }
  EXPECT_GT(fastest, 0.9999);
}

// About each principal axis, and of spheroids and spheres with their modelled moments (ellipsoid.h).
TEST(AsymmetricTop, RotatesUniformlyWhereItMust) {
  Stream draw(5, Purpose::tests);
  for (int k = 0; k < 300; ++k) {
    Body body = random_body(draw);
    const int kind = k % 6;
    if (kind == 3) body.shape = prolate(3);
    if (kind == 4) body.shape = oblate(3);
    if (kind == 5) body.shape = {Vec3::Ones()};
    if (kind < 3)
      body.angular_velocity = body.orientation * Vec3::Unit(kind) * draw.uniform(0.1, 2);
    // The rounding of the initial state grows exponentially about the middle axis, at a rate of up to Ω.
    const bool is_unstable = kind < 3 && kind == middle_axis(body.shape);
    const double time = is_unstable ? 1 / body.top().max_speed() : 20;
    const Pose3 later =
        advanced({Vec3::Zero(), body.orientation}, {Vec3::Zero(), body.angular_velocity}, time);
    const AsymmetricTop::State state = body.top().at(time);
    // The phases of a slender body, up to thousands of radians, are rounded.
    constexpr double tolerance = 1e-11;
    EXPECT_LT((state.axes - later.orientation.toRotationMatrix()).cwiseAbs().maxCoeff(), tolerance);
    EXPECT_LT((state.angular_velocity - body.angular_velocity).norm(), tolerance);
    if (!is_unstable) {
      EXPECT_NEAR(body.top().max_speed(), body.angular_velocity.norm(), 1e-14);
    }
  }
  const AsymmetricTop at_rest(Ellipsoid{{3, 2, 1}}, Quaternion::Identity(), Vec3::Zero());
  EXPECT_EQ(at_rest.at(10).axes, Mat3(Mat3::Identity()));
}

}  // namespace
}  // namespace vitrel

// Free rotation in closed form, against Euler's equations integrated in extended precision.

#include "core/geometry/asymmetric_top.h"
#include "core/geometry/free_flight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bench/reference/taylor_top.h"
#include "tests/support/solids.h"

namespace vitrel {
namespace {

using bench::TaylorTop;

double difference(const TaylorTop::State& one, const TaylorTop::State& two) {
  return static_cast<double>(
      std::max((one.axes - two.axes).cwiseAbs().maxCoeff(),
               (one.angular_velocity - two.angular_velocity).norm() / two.angular_velocity.norm()));
}
double difference(const AsymmetricTop::State& one, const TaylorTop::State& two) {
  return difference(TaylorTop::State{one.axes.cast<TaylorTop::Real>(),
                                     one.angular_velocity.cast<TaylorTop::Real>()},
                    two);
}

struct Body {
  Ellipsoid shape;
  Quaternion orientation;
  Vec3 angular_velocity;

  AsymmetricTop top() const { return {shape, orientation, angular_velocity}; }
  /// From time 0 to `end`.
  TaylorTop truth(double end) const { return {shape, orientation, angular_velocity, end}; }

  // With every number changed by one unit in the last place of its vector.
  Body disturbed(Stream& draw) const {
    const auto up_or_down = [&] { return draw.uniform(-1, 1) < 0 ? -0x1p-52 : 0x1p-52; };
    Body other = *this;
    const double size = angular_velocity.norm();
    for (double& w : other.angular_velocity) w += up_or_down() * size;
    for (double& x : other.orientation.coeffs()) x += up_or_down();
    return other;
  }

  /// |L²/(2EI₂) − 1|
  double separatrix_distance() const {
    Vec3 moments = shape.inertia_per_mass();
    const Vec3 own = orientation.conjugate() * angular_velocity;
    const double twice_energy = moments.dot(own.cwiseAbs2());
    const double momentum_squared = moments.cwiseProduct(own).squaredNorm();
    std::ranges::sort(moments);
    return std::abs(momentum_squared / (twice_energy * moments[1]) - 1);
  }
};

Body random_body(Stream& draw) {
  return {random_ellipsoid(draw, 10), random_orientation(draw), random_vector(draw, 0.1, 3)};
}

int middle_axis(const Ellipsoid& shape) {
  const Vec3& axes = shape.semi_axes;
  for (int k = 0; k < 3; ++k)
    if (axes[k] > axes.minCoeff() && axes[k] < axes.maxCoeff()) return k;
  return no_axis;
}

// Almost about the middle axis, by down to 1e-12.
Body near_the_separatrix(Stream& draw) {
  Body body = random_body(draw);
  const double deviation = std::pow(10, draw.uniform(-12, -1));
  Vec3 own = deviation * random_direction(draw);
  own[middle_axis(body.shape)] = 1;
  body.angular_velocity = body.orientation * own;
  return body;
}

TEST(AsymmetricTop, MovesByEulersEquations) {
  Stream draw(1, Purpose::tests);
  int tested = 0;
  for (int k = 0; k < 150; ++k) {
    const Body body = random_body(draw);
    if (body.separatrix_distance() < 1e-3) continue;
    ++tested;
    const AsymmetricTop top = body.top();
    for (const double end : {20.0, -5.0}) {
      const TaylorTop truth = body.truth(end);
      EXPECT_LT(difference(top.at(0), truth.at(0)), 1e-14);
      for (int sample = 0; sample < 5; ++sample) {
        const double time = draw.uniform(0, 1) * end;
        EXPECT_LT(difference(top.at(time), truth.at(time)), 1e-10);
      }
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
    near += body.separatrix_distance() < 1e-3;
    const double time = draw.uniform(0, 30);
    const TaylorTop::State truth = body.truth(time).at(time);
    double effect = 0;
    for (int other = 0; other < 4; ++other)
      effect = std::max(effect, difference(body.disturbed(draw).truth(time).at(time), truth));
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

#include "mc/axis_distribution.h"

#include <gtest/gtest.h>

#include <boost/math/special_functions/ellint_rd.hpp>
#include <cmath>

#include "core/random/stream.h"

namespace vitrel {
namespace {

double largest(const Vec3& v) {
  return v.cwiseAbs().maxCoeff();
}

// Boost's R_D shares no code with this one.
TEST(AngularGaussianMoments, AgreeWithTheEllipticIntegral) {
  for (const Vec3& variances : {Vec3(1, 1, 1), Vec3(3, 2, 0.1), Vec3(1, 1e-8, 1e-3),
                                Vec3(1, 1, 1e-12), Vec3(1, 1e-14, 1e-14)}) {
    const Vec3 mu = variances.cwiseInverse(), moments = angular_gaussian_moments(variances);
    for (int k = 0; k < 3; ++k) {
      const double truth = std::sqrt(mu.prod()) / 3 *
                           boost::math::ellint_rd(mu[(k + 1) % 3], mu[(k + 2) % 3], mu[k]);
      EXPECT_NEAR(moments[k] / truth, 1, 1e-14) << variances.transpose();
    }
    EXPECT_NEAR(moments.sum(), 1, 1e-14);
  }
}

// With λ = (1, 1, 1/(1 + s²)), z = cos θ has the density ∝ (1 + s² z²)^(−3/2), so that ⟨z²⟩ =
// (√(1 + s²) arsinh(s)/s − 1)/s².
TEST(AngularGaussianMoments, OfFlatDistributionsHaveAClosedForm) {
  for (const double s : {0.5, 2.0, 30.0}) {
    const double root = std::sqrt(1 + s * s);
    const Vec3 moments = angular_gaussian_moments({1, 1, 1 / (root * root)});
    EXPECT_NEAR(moments[2], (root * std::asinh(s) / s - 1) / (s * s), 1e-14);
    EXPECT_NEAR(moments[0], moments[1], 1e-15);
  }
}

TEST(AngularGaussianVariances, HaveTheMomentsAskedFor) {
  const double small[] = {1.1e-9, 1e-6, 1e-3, 0.1, 0.2, 1.0 / 3};
  for (const double x : small)
    for (const double y : small) {
      const Vec3 moments(x, y, 1 - x - y);
      const Vec3 found = angular_gaussian_moments(angular_gaussian_variances(moments));
      EXPECT_LT(largest(found.cwiseQuotient(moments) - Vec3::Ones()), 1e-12) << moments.transpose();
    }
}

template <int Dim>
using Tensor = typename AxisDistribution<Dim>::Tensor;

template <int Dim>
Tensor<Dim> drawn_tensor(const Tensor<Dim>& given, int count) {
  const AxisDistribution<Dim> axes(given);
  Stream draw(3, Purpose::tests);
  Tensor<Dim> sum = Tensor<Dim>::Zero();
  for (int k = 0; k < count; ++k) {
    const Vec<Dim> u = axes(draw);
    EXPECT_NEAR(u.norm(), 1, 1e-15);
    sum += u * u.transpose();
  }
  return sum / count;
}

// Components of u uᵀ lie in an interval of length 1, so that their standard deviation is at most 1/2. Within 4.9 standard
// errors: a false alarm in at most 1e-6 of the seeds each.
template <int Dim>
void expect_drawn(const Tensor<Dim>& given) {
  constexpr int count = 100'000;
  const Tensor<Dim> error = drawn_tensor<Dim>(given, count) - given;
  EXPECT_LT(error.cwiseAbs().maxCoeff(), 4.9 * 0.5 / std::sqrt(count)) << error;
}

TEST(AxisDistribution, HasTheTensorInSpace) {
  expect_drawn<3>(Vec3(0.6, 0.3, 0.1).asDiagonal());
  expect_drawn<3>(Vec3(0.5, 0.5, 0).asDiagonal());
  expect_drawn<3>(Mat3::Identity() / 3);
  Mat3 rows;
  rows << 0.5, 0.15, -0.1, 0.15, 0.3, 0.05, -0.1, 0.05, 0.2;
  expect_drawn<3>(rows);
}

TEST(AxisDistribution, HasTheTensorInThePlane) {
  expect_drawn<2>(Vec2(0.8, 0.2).asDiagonal());
  Mat2 rows;
  rows << 0.6, -0.3, -0.3, 0.4;
  expect_drawn<2>(rows);
}

TEST(AxisDistribution, StaysInAPlaneOrOnALine) {
  EXPECT_EQ(drawn_tensor<3>(Vec3(0.5, 0.5, 0).asDiagonal(), 100)(2, 2), 0);
  EXPECT_EQ(drawn_tensor<3>(Vec3(0, 1, 0).asDiagonal(), 100)(1, 1), 1);
  EXPECT_EQ(drawn_tensor<2>(Vec2(0, 1).asDiagonal(), 100)(1, 1), 1);
}

}  // namespace
}  // namespace vitrel

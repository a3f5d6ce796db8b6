#include "analysis/statistics/least_squares.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

namespace vitrel {
namespace {

// A line through four points with errors 1, 2, 1, 2: the normal equations give p and (JᵀJ)⁻¹.
TEST(LeastSquares, OfALineAreTheNormalEquations) {
  const Eigen::Vector4d x(0, 1, 2, 4), y(1, 3, 2, 7), error(1, 2, 1, 2);
  Eigen::MatrixXd weighted(4, 2);
  weighted.col(0) = error.cwiseInverse();
  weighted.col(1) = x.cwiseQuotient(error);
  const Eigen::Matrix2d covariance = (weighted.transpose() * weighted).inverse();
  const Eigen::Vector2d exact = covariance * weighted.transpose() * y.cwiseQuotient(error);
  const LeastSquares fit =
      least_squares(4, Eigen::Vector2d(0, 0),
                    [&](const Eigen::VectorXd& p, Eigen::VectorXd& r, Eigen::MatrixXd& j) {
                      r = weighted * p - y.cwiseQuotient(error);
                      j = weighted;
                    });
  EXPECT_TRUE(fit.converged);
  EXPECT_LT((fit.parameters - exact).norm(), 1e-9);
  EXPECT_LT((fit.covariance - covariance).norm(), 1e-12);
  EXPECT_NEAR(fit.chi_square, (weighted * exact - y.cwiseQuotient(error)).squaredNorm(), 1e-12);
}

// Rosenbrock's valley: r = (10 (y − x²), 1 − x), 0 at (1, 1).
TEST(LeastSquares, FollowACurvedValley) {
  const LeastSquares fit =
      least_squares(2, Eigen::Vector2d(-1.2, 1),
                    [](const Eigen::VectorXd& p, Eigen::VectorXd& r, Eigen::MatrixXd& j) {
                      r << 10 * (p[1] - p[0] * p[0]), 1 - p[0];
                      j << -20 * p[0], 10, -1, 0;
                    });
  EXPECT_TRUE(fit.converged);
  EXPECT_LT((fit.parameters - Eigen::Vector2d(1, 1)).norm(), 1e-8);
}

// Derivatives of the wrong sign: no step leads downhill.
TEST(LeastSquares, SayIfTheyDidNotConverge) {
  const LeastSquares fit =
      least_squares(1, Eigen::VectorXd::Constant(1, 5.0),
                    [](const Eigen::VectorXd& p, Eigen::VectorXd& r, Eigen::MatrixXd& j) {
                      r[0] = p[0] * p[0] + 1;
                      j(0, 0) = -2 * p[0];
                    });
  EXPECT_FALSE(fit.converged);
}

}  // namespace
}  // namespace vitrel

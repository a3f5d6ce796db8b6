// Small algebra: an order of its own, whatever Eigen's is, and the right values.

#include "core/geometry/vector.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random/stream.h"

namespace vitrel {
namespace {

// Eigen's products are expressions.
static_assert(std::is_same_v<decltype(Mat3() * Vec3()), Vec3>);
static_assert(std::is_same_v<decltype(Mat3().transpose() * (Vec3() - Vec3())), Vec3>);
static_assert(std::is_same_v<decltype(2 * Mat3() * Mat3().transpose()), Mat3>);
static_assert(
    std::is_same_v<decltype(Vec3().head<2>().transpose() * Mat2()), Eigen::Matrix<double, 1, 2>>);
static_assert(std::is_same_v<decltype(Quaternion().conjugate() * (Vec3() + Vec3())), Vec3>);

Vec3 random_vector(Stream& draw) {
  Vec3 v;
  for (int k = 0; k < 3; ++k) v[k] = draw.normal();
  return v;
}

Quaternion random_rotation(Stream& draw) {
  Quaternion q;
  for (int k = 0; k < 4; ++k) q.coeffs()[k] = draw.normal();
  return normalized(q);
}

// 1 + 2⁻⁵³ rounds to 1, 2⁻⁵³ + 2⁻⁵³ does not vanish: the result tells the order.
TEST(Vector, SumsRunFromTheFirstComponentToTheLast) {
  const double small = 0x1p-53;
  EXPECT_EQ(sum(Vec3(1, small, small)), 1);
  EXPECT_EQ(sum(Vec3(small, small, 1)), 1 + 2 * small);
  EXPECT_EQ(dot(Vec3(1, small, small), Vec3::Ones()), 1);
  EXPECT_EQ(sum(Quaternion(small, 1, small, small).coeffs()), 1);
  EXPECT_EQ((Mat3(Vec3(1, small, small).asDiagonal()) * Mat3::Ones()).row(0).sum(), 3);
  Mat3 rows;
  rows << 1, small, small, small, small, 1, small, 1, small;
  EXPECT_EQ(Vec3(rows * Vec3::Ones()), Vec3(1, 1 + 2 * small, 1));
  EXPECT_EQ(prod(Vec3(3, 1. / 3, 0.1)), 1 * 0.1);
}

TEST(Vector, ProductsAgreeWithEigen) {
  Stream draw(1, Purpose::tests);
  for (int trial = 0; trial < 1000; ++trial) {
    const Quaternion p = random_rotation(draw), q = random_rotation(draw);
    const Vec3 v = random_vector(draw);
    EXPECT_LT((rotation_matrix(q) - q.toRotationMatrix()).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_LT((q * v - q.toRotationMatrix().lazyProduct(v)).cwiseAbs().maxCoeff(), 5e-15);
    EXPECT_LT(((p * q).coeffs() - p.operator*(q).coeffs()).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_NEAR(norm(v), v.norm(), 2e-15);
  }
}

TEST(Vector, QuaternionOfItsRotationMatrix) {
  Stream draw(2, Purpose::tests);
  for (int trial = 0; trial < 1000; ++trial) {
    Quaternion q = random_rotation(draw);
    // Half turns, about the axes too, have no real part.
    if (trial % 4 == 1) q = normalized(Quaternion(0, q.x(), q.y(), q.z()));
    if (trial % 4 == 2) q = Quaternion(1e-9, trial % 3 == 0, trial % 3 == 1, trial % 3 == 2);
    const Quaternion back = quaternion_of(rotation_matrix(q));
    EXPECT_NEAR(std::abs(dot(back.coeffs(), q.coeffs())), 1, 1e-15);
    EXPECT_NEAR(norm(back), 1, 3e-16);
  }
}

TEST(Vector, InverseAndDeterminant) {
  Stream draw(3, Purpose::tests);
  for (int trial = 0; trial < 1000; ++trial) {
    Mat3 m;
    for (int k = 0; k < 3; ++k) m.col(k) = random_vector(draw);
    const Mat2 part = m.topLeftCorner<2, 2>();
    const double scale = 1 / std::abs(determinant(m)), scale2 = 1 / std::abs(determinant(part));
    EXPECT_LT((m * inverse(m) - Mat3::Identity()).cwiseAbs().maxCoeff(), 2e-14 * (1 + 10 * scale));
    EXPECT_LT((part * inverse(part) - Mat2::Identity()).cwiseAbs().maxCoeff(),
              1e-14 * (1 + scale2));
    EXPECT_NEAR(determinant(m), m.determinant(), 1e-13);
  }
}

}  // namespace
}  // namespace vitrel

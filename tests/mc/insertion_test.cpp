#include "mc/insertion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/state/check.h"
#include "tests/support/equal_bodies.h"

namespace vitrel {
namespace {

Configuration2 particles(std::size_t n, const Ellipse& shape, const Vec2& sides = {50, 50}) {
  return equal_bodies(n, shape, sides);
}
Configuration3 solids(std::size_t n, const Ellipsoid& shape, double edge) {
  return equal_bodies<3>(n, shape, Vec3::Constant(edge));
}

TEST(Insertion, GivesAHardStateAtThePackingFraction) {
  for (double aspect_ratio : {1.0, 2.0, 6.0}) {
    Configuration2 c = particles(300, of_aspect_ratio(aspect_ratio));
    const StageReport report = insert_particles(c, {0.35, 100000, false}, 1, {});
    EXPECT_EQ(report.end, StageEnd::reached);
    EXPECT_NEAR(packing_fraction(c), 0.35, 1e-12);
    EXPECT_TRUE(exact_check(c).clean());
  }
}

TEST(Insertion, OfSolidsGivesAHardStateAtThePackingFraction) {
  for (const Vec3& axes : {Vec3(1, 1, 1), Vec3(2, 1, 0.5), Vec3(0.3, 2, 2)})
    for (const double fraction : {1e-8, 0.2}) {
      Configuration3 c = solids(300, {axes}, 40);
      const InsertionReport report = insert_particles(c, {fraction, 100000, false}, 1, {});
      EXPECT_EQ(report.end, StageEnd::reached) << report.reason;
      EXPECT_NEAR(packing_fraction(c), fraction, 1e-12 * fraction);
      EXPECT_TRUE(exact_check(c).clean());
      for (const Quaternion& q : c.orientation) EXPECT_NEAR(q.norm(), 1, 1e-15);
    }
}

/// ⟨u uᵀ⟩ of one of the own axes of the bodies.
Mat3 tensor_of_axes(const Configuration3& c, int axis) {
  Mat3 tensor = Mat3::Zero();
  for (const Quaternion& q : c.orientation) {
    const Vec3 u = q * Vec3::Unit(axis);
    tensor += u * u.transpose() / static_cast<double>(c.size());
  }
  return tensor;
}

/// Components of u uᵀ lie in an interval of length 1, so that their standard deviation is at most 1/2. Within 4.9 standard
/// errors of the mean of n: a false alarm in at most 1e-6 of the seeds each.
double tolerance_of_tensor(std::size_t n) {
  return 4.9 * 0.5 / std::sqrt(static_cast<double>(n));
}

// Dense enough that most places are refused.
TEST(Insertion, OfSolidsKeepsTheOrientationTensorWherePlacesAreRefused) {
  constexpr std::size_t n = 1000;
  Configuration3 c = solids(n, {Vec3(10, 1, 1)}, 100);
  const Mat3 given = Vec3(0.6, 0.1, 0.3).asDiagonal();
  const InsertionReport report =
      insert_particles(c, {0.1, 100000, false, {given.data(), given.data() + 9}}, 1, {});
  ASSERT_EQ(report.end, StageEnd::reached);
  EXPECT_GT(report.trials, 5 * n);
  const Mat3 tensor = tensor_of_axes(c, 0);
  EXPECT_LT((tensor - given).cwiseAbs().maxCoeff(), tolerance_of_tensor(n)) << tensor;
}

// The longest axes have the tensor A. Turned at random around them, other axes have (1 − A)/2.
TEST(Insertion, OfSolidsHasTheOrientationTensor) {
  constexpr std::size_t n = 5000;
  Configuration3 c = solids(n, {Vec3(0.5, 2, 1)}, 200);
  const Mat3 given = Vec3(0.6, 0.1, 0.3).asDiagonal();
  const InsertionOptions options{0.001, 100000, false, {given.data(), given.data() + 9}};
  ASSERT_EQ(insert_particles(c, options, 1, {}).end, StageEnd::reached);
  EXPECT_TRUE(exact_check(c).clean());
  const Mat3 longest = tensor_of_axes(c, 1), middle = tensor_of_axes(c, 2);
  const double tolerance = tolerance_of_tensor(n);
  EXPECT_LT((longest - given).cwiseAbs().maxCoeff(), tolerance) << longest;
  const Mat3 around = 0.5 * (Mat3::Identity() - given);
  EXPECT_LT((middle - around).cwiseAbs().maxCoeff(), tolerance) << middle;
}

TEST(Insertion, HasTheOrientationTensorInThePlane) {
  constexpr std::size_t n = 5000;
  Configuration2 c = particles(n, of_aspect_ratio(2));
  const InsertionOptions options{0.01, 100000, false, {0.8, 0.1, 0.1, 0.2}};
  ASSERT_EQ(insert_particles(c, options, 1, {}).end, StageEnd::reached);
  Mat2 tensor = Mat2::Zero();
  for (const double angle : c.angle) {
    const Vec2 u(std::cos(angle), std::sin(angle));
    tensor += u * u.transpose() / n;
  }
  const double tolerance = tolerance_of_tensor(n);
  EXPECT_NEAR(tensor(0, 0), 0.8, tolerance);
  EXPECT_NEAR(tensor(0, 1), 0.1, tolerance);
}

TEST(Insertion, OfSolidsMindsTheirOwnImages) {
  const Ellipsoid needle{Vec3(3, 0.1, 0.1)};
  Configuration3 c = solids(3, needle, 5.9);
  const StageReport report = insert_particles(c, {packing_fraction(c), 100000, false}, 1, {});
  ASSERT_EQ(report.end, StageEnd::reached);
  EXPECT_TRUE(exact_check(c).clean());
  // Aligned, it overlaps its own image.
  EXPECT_EQ(insert_particles(c, {packing_fraction(c), 1000, true}, 1, {}).end, StageEnd::stalled);
}

TEST(Insertion, IntoABoxOfOneParticleLengthMindsTheImages) {
  Configuration2 c = particles(3, {3, 0.1}, {6.1, 3});
  const StageReport report = insert_particles(c, {packing_fraction(c), 1000000, false}, 1, {});
  ASSERT_EQ(report.end, StageEnd::reached);
  EXPECT_TRUE(exact_check(c).clean());
}

// Beyond the jamming limit of disks, 0.547, there is no way in.
TEST(Insertion, SaysWhenItIsHopeless) {
  Configuration2 c = particles(400, {1, 1});
  const StageReport report = insert_particles(c, {0.6, 2000, false}, 1, {});
  EXPECT_EQ(report.end, StageEnd::stalled);
  EXPECT_NE(report.reason.find("insertion failed"), std::string::npos);
}

TEST(Insertion, AlignedMeansAngleZero) {
  Configuration2 c = particles(50, of_aspect_ratio(4));
  insert_particles(c, {0.3, 100000, true}, 1, {});
  for (double angle : c.angle) EXPECT_EQ(angle, 0);
}

/// Two bodies thrown at random overlap with probability 2 B₂/V: the share of second bodies that find no place at the first
/// attempt. 4 standard errors, false alarm 6e-5.
template <int Dim>
void expect_second_virial_coefficient(const Configuration<Dim>& pair, double b2) {
  const int throws = 40'000;
  int rejected = 0;
  for (int k = 0; k < throws; ++k) {
    Configuration<Dim> c = pair;
    const StageReport report = insert_particles(c, {packing_fraction(c), 1, false}, k, {});
    rejected += report.end == StageEnd::stalled;
  }
  const double p = 2 * b2 / pair.box.volume();
  EXPECT_NEAR(rejected, p * throws, 4 * std::sqrt(throws * p * (1 - p)));
}

// As of ellipses: B₂ = V + S R of a convex body, S the surface and R the mean support function. Of a
// prolate spheroid with c² = a² − b²: S = 2π b² + 2π a²b/c asin(c/a), R = (a + b²/c asinh(c/b))/2. Both
// bodies are turned at random: wrongly turned ones would give another number.
TEST(Insertion, FirstRejectionOfSpheroidsGivesTheSecondVirialCoefficient) {
  const double a = 2, b = 0.4, c = std::sqrt(a * a - b * b);
  const Ellipsoid shape{Vec3(b, a, b)};
  const double surface = 2 * std::numbers::pi * (b * b + a * a * b / c * std::asin(c / a));
  const double b2 = shape.volume() + surface * 0.5 * (a + b * b / c * std::asinh(c / b));
  expect_second_virial_coefficient(solids(2, shape, 8), b2);
}

// B₂ = A + P²/(4π) exactly.
TEST(Insertion, FirstRejectionGivesTheSecondVirialCoefficient) {
  const Ellipse shape = of_aspect_ratio(4);
  const double b2 = shape.volume() + std::pow(perimeter(shape), 2) / (4 * std::numbers::pi);
  expect_second_virial_coefficient(particles(2, shape, {12, 12}), b2);
}

}  // namespace
}  // namespace vitrel

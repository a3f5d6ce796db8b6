#include "core/state/exact_pair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <string>

#include "core/contact/perram_wertheim.h"
#include "core/elementary.h"
#include "tests/support/solids.h"

/// Long double and the sum of two doubles judge the same pairs.
namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double near_contact = 3e-15;  // of the longest semi-axis

template <int Dim>
struct PosedBodies {
  ParticleShape<Dim> one, two;
  Pose<Dim> pose1, pose2;

  template <class Real>
  exact::Particle<Dim, Real> first() const {
    return exact::particle<Real>(one, pose1);
  }
  template <class Real>
  exact::Particle<Dim, Real> second() const {
    return exact::particle<Real>(two, pose2);
  }
  template <class Real>
  bool overlap() const {
    return exact::examine(first<Real>(), second<Real>(), second<Real>().centre,
                          -std::numeric_limits<double>::infinity())
        .overlap;
  }
  template <class Real>
  Real gap() const {
    return exact::examine(first<Real>(), second<Real>(), second<Real>().centre,
                          std::numeric_limits<double>::infinity())
        .gap;
  }
};

template <class Real>
bool overlap_by_criterion(const PosedBodies<2>& pair) {
  const auto d = pair.second<Real>().centre;
  return !vieillard_baron<Real>(pair.first<Real>().axes, pair.second<Real>().axes, d.x(), d.y())
              .disjoint_or_touching();
}

template <class Real>
bool overlap_by_criterion(const PosedBodies<3>& pair) {
  return !ellipsoid_eta<Real>(pair.first<Real>().axes, pair.second<Real>().axes,
                              pair.second<Real>().centre)
              .disjoint_or_touching();
}

std::ostream& operator<<(std::ostream& out, const PosedBodies<2>& pair) {
  out.precision(17);
  return out << pair.one.a << ' ' << pair.one.b << " at " << pair.pose1.angle << ", " << pair.two.a
             << ' ' << pair.two.b << " at " << pair.pose2.angle << ", d "
             << pair.pose2.position.transpose();
}

std::ostream& operator<<(std::ostream& out, const PosedBodies<3>& pair) {
  out.precision(17);
  return out << pair.one.semi_axes.transpose() << " at "
             << pair.pose1.orientation.coeffs().transpose() << ", "
             << pair.two.semi_axes.transpose() << " at "
             << pair.pose2.orientation.coeffs().transpose() << ", d "
             << pair.pose2.position.transpose();
}

double log_uniform(Stream& draw, double low, double high) {
  return low * std::exp(draw.uniform() * std::log(high / low));
}

/// The longest semi-axis of the larger body is 1, that of the other 0.1 … 1; aspect ratios 1 … 100.
Ellipse random_body(Stream& draw, double size, const Ellipse&) {
  return {size, size / log_uniform(draw, 1, 100)};
}

Ellipsoid random_body(Stream& draw, double size, const Ellipsoid&) {
  const double aspect = log_uniform(draw, 1, 100);
  return {size * Vec3(1, 1 / log_uniform(draw, 1, aspect), 1 / aspect)};
}

Pose2 random_pose(Stream& draw, const Pose2&) {
  return {{0, 0}, draw.uniform(-9, 9)};
}

Pose3 random_pose(Stream& draw, const Pose3&) {
  return {{0, 0, 0}, random_orientation(draw)};
}

Vec2 random_direction(Stream& draw, const Vec2&) {
  const double angle = draw.uniform(-pi, pi);
  return {std::cos(angle), std::sin(angle)};
}

Vec3 random_direction(Stream& draw, const Vec3&) {
  return random_direction(draw);
}

long double support(const EllipseAxes<long double>& e, const exact::Point<2, long double>& n) {
  return std::hypot(e.a * (n.x() * e.cosine + n.y() * e.sine),
                    e.b * (n.y() * e.cosine - n.x() * e.sine));
}

long double support(const EllipsoidAxes<long double>& e, const exact::Point<3, long double>& n) {
  return (e.directions.transpose() * n).cwiseProduct(e.lengths).norm();
}

/// Moves the second body along e to where the surfaces are `gap` apart along their common normal at contact. The position
/// is then rounded.
template <int Dim>
void place_near_contact(PosedBodies<Dim>& pair, const Vec<Dim>& e, double gap) {
  using Real = long double;
  const PerramWertheim<Dim> touch = perram_wertheim(pair.one, orientation_of(pair.pose1), pair.two,
                                                    orientation_of(pair.pose2), e);
  const exact::Point<Dim, Real> n = touch.normal.template cast<Real>().normalized();
  const Real heights =
      support(pair.template first<Real>().axes, n) + support(pair.template second<Real>().axes, n);
  const Real distance = (heights + gap) / n.dot(e.template cast<Real>());
  pair.pose2.position = (distance * e.template cast<Real>()).template cast<double>();
}

template <int Dim>
PosedBodies<Dim> random_bodies(Stream& draw) {
  const double size = log_uniform(draw, 0.1, 1);
  PosedBodies<Dim> pair{random_body(draw, 1, ParticleShape<Dim>()),
                        random_body(draw, size, ParticleShape<Dim>()),
                        random_pose(draw, Pose<Dim>()), random_pose(draw, Pose<Dim>())};
  if (draw.uniform() < 0.5) std::swap(pair.one, pair.two);
  return pair;
}

template <int Dim>
void expect_verdict(const PosedBodies<Dim>& pair, bool overlap) {
  ASSERT_EQ(pair.template overlap<long double>(), overlap) << pair;
  ASSERT_EQ(pair.template overlap<DoubleDouble>(), overlap) << pair;
  ASSERT_EQ(overlap_by_criterion<long double>(pair), overlap) << pair;
  ASSERT_EQ(overlap_by_criterion<DoubleDouble>(pair), overlap) << pair;
}

std::uint64_t pairs_to_compare() {
  const char* given = std::getenv("VITREL_EXTENDED_PAIRS");
  return given ? std::stoull(given) : 40'000;
}

/// The number of pairs can be raised by the environment variable VITREL_EXTENDED_PAIRS. Half of them are placed anywhere
/// within the circumcircles (spheres), a quarter each overlap or miss each other by 3e-15.
template <int Dim>
void compare_arithmetics() {
  if (std::numeric_limits<long double>::digits < 64) GTEST_SKIP() << "long double is too short";
  Stream draw(1, Purpose::tests);
  const std::uint64_t pairs = pairs_to_compare();
  std::uint64_t overlapping = 0;
  for (std::uint64_t k = 0; k < pairs; ++k) {
    auto pair = random_bodies<Dim>(draw);
    const Vec<Dim> e = random_direction(draw, Vec<Dim>());
    if (k % 2 == 0) {
      const double gap = k % 4 == 0 ? near_contact : -near_contact;
      place_near_contact(pair, e, gap);
      expect_verdict(pair, gap < 0);
    } else {
      const double touch = pair.one.circumradius() + pair.two.circumradius();
      pair.pose2.position = touch * root(draw.uniform(), Dim) * e;
      expect_verdict(pair, pair.template overlap<long double>());
    }
    if (testing::Test::HasFatalFailure()) return;
    overlapping += pair.template overlap<DoubleDouble>();
  }
  testing::Test::RecordProperty("overlapping", std::to_string(overlapping));
  EXPECT_GT(overlapping, pairs * 3 / 10);
  EXPECT_LT(overlapping, pairs * 7 / 10);
}

TEST(ExactPair, TwoArithmeticsAgreeOnEllipses) {
  compare_arithmetics<2>();
}

TEST(ExactPair, TwoArithmeticsAgreeOnEllipsoids) {
  compare_arithmetics<3>();
}

}  // namespace
}  // namespace vitrel

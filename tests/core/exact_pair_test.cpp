#include "core/state/exact_pair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <string>

#include "core/elementary.h"
#include "tests/support/exact_checks.h"
#include "tests/support/overlap_criteria.h"

/// Long double and the sum of two doubles judge the same pairs.
namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double near_contact = 3e-15;  // of the longest semi-axis

template <class Real, int Dim>
exact::Particle<Dim, Real> first(const PosedBodies<Dim>& pair) {
  return exact::particle<Real>(pair.one, pair.pose1());
}
template <class Real, int Dim>
exact::Particle<Dim, Real> second(const PosedBodies<Dim>& pair) {
  return exact::particle<Real>(pair.two, pair.pose2());
}

template <class Real, int Dim>
bool overlap(const PosedBodies<Dim>& pair) {
  const auto other = second<Real>(pair);
  return exact::examine(first<Real>(pair), other, other.centre,
                        -std::numeric_limits<double>::infinity())
      .overlap;
}

template <class Real, int Dim>
bool overlap_by_criterion(const PosedBodies<Dim>& pair) {
  const auto other = second<Real>(pair);
  return !apart_by_criterion(first<Real>(pair), other, other.centre);
}

/// The longest semi-axis of the larger body is 1, that of the other 0.1 … 1; aspect ratios 1 … 100.
Ellipse random_body(Stream& draw, double size, const Ellipse&) {
  return {size, size / log_uniform(draw, 1, 100)};
}

Ellipsoid random_body(Stream& draw, double size, const Ellipsoid&) {
  const double aspect = log_uniform(draw, 1, 100);
  return {size * Vec3(1, 1 / log_uniform(draw, 1, aspect), 1 / aspect)};
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
  const exact::Point<Dim, Real> n = f_of(pair.with(e)).normal.template cast<Real>().normalized();
  const Real heights = support(first<Real>(pair).axes, n) + support(second<Real>(pair).axes, n);
  const Real distance = (heights + gap) / n.dot(e.template cast<Real>());
  pair.d = (distance * e.template cast<Real>()).template cast<double>();
}

template <int Dim>
PosedBodies<Dim> random_bodies(Stream& draw) {
  const double size = log_uniform(draw, 0.1, 1);
  PosedBodies<Dim> pair{random_body(draw, 1, ParticleShape<Dim>()),
                        random_body(draw, size, ParticleShape<Dim>()), random_turn<Dim>(draw),
                        random_turn<Dim>(draw), Vec<Dim>::Zero()};
  if (draw.uniform() < 0.5) std::swap(pair.one, pair.two);
  return pair;
}

template <int Dim>
void expect_overlap(const PosedBodies<Dim>& pair, bool overlaps) {
  ASSERT_EQ(overlap<long double>(pair), overlaps) << pair;
  ASSERT_EQ(overlap<DoubleDouble>(pair), overlaps) << pair;
  ASSERT_EQ(overlap_by_criterion<long double>(pair), overlaps) << pair;
  ASSERT_EQ(overlap_by_criterion<DoubleDouble>(pair), overlaps) << pair;
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
      expect_overlap(pair, gap < 0);
    } else {
      pair.d = pair.extent() * root(draw.uniform(), Dim) * e;
      expect_overlap(pair, overlap<long double>(pair));
    }
    if (testing::Test::HasFatalFailure()) return;
    overlapping += overlap<DoubleDouble>(pair);
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

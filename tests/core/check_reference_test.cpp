#include <gtest/gtest.h>

#include <cmath>

#include "core/special_values.h"
#include "tests/support/exact_checks.h"

/// The exact check against a plain scan of all pairs and images in long double, without cells and without
/// rejections in double precision. The scan judges round bodies by the general criteria, too.
namespace vitrel {
namespace {

using Real = Extended;
using std::abs;  // beside that of DoubleDouble

/// Images up to `boxes` box lengths away.
template <int Dim>
ExactCheck<Dim> scan(const Configuration<Dim>& state, int boxes) {
  ExactCheck<Dim> result{{}, infinity, 0};
  const exact::Point<Dim> lengths = state.box.lengths().template cast<Real>();
  const Real nearness = largest_circumradius(state);
  Real smallest_gap = nearness;
  for (std::size_t i = 0; i < state.size(); ++i) {
    const exact::Particle<Dim> one = exact::particle(state.shape[i], state.pose(i));
    for (std::size_t j = i; j < state.size(); ++j) {
      const exact::Particle<Dim> two = exact::particle(state.shape[j], state.pose(j));
      for (const Shift<Dim>& shift : all_shifts<Dim>(boxes)) {
        if (i == j && !is_positive_shift<Dim>(shift)) continue;
        exact::Point<Dim> d = two.centre - one.centre;
        for (int k = 0; k < Dim; ++k) d[k] += shift[k] * lengths[k];
        const Real circles = d.norm() - (one.circumradius + two.circumradius);
        if (circles >= nearness) continue;
        if (circles < 0) ++result.pairs_examined;
        if (circles < 0 && !apart_by_criterion(one, two, d))
          result.overlaps.push_back({i, j, shift});
        smallest_gap = std::min(smallest_gap, exact::examine(one, two, d, infinity).gap);
      }
    }
  }
  if (smallest_gap < nearness) result.smallest_gap = static_cast<double>(smallest_gap);
  return result;
}

template <int Dim>
void expect_equal_to_scan(const Configuration<Dim>& state, int boxes) {
  const ExactCheck<Dim> expected = scan(state, boxes);
  expect_equal(exact_check(state), expected);     // one cell
  expect_equal(exact_check(state, 0), expected);  // cells
}

Ellipse random_shape(Stream& draw, double round_share, const Ellipse&) {
  const double b = draw.uniform(0.2, 1);
  return draw.uniform(0, 1) < round_share ? Ellipse{b, b} : Ellipse{b * draw.uniform(1, 6), b};
}

Ellipsoid random_shape(Stream& draw, double round_share, const Ellipsoid&) {
  const double size = draw.uniform(0.2, 1);
  if (draw.uniform(0, 1) < round_share) return {Vec3::Constant(size)};
  return scaled(random_ellipsoid(draw, 6), size);
}

/// n particles of random sizes anywhere, a given share of them round.
template <int Dim>
Configuration<Dim> random_state(Stream& draw, std::size_t n, const Vec<Dim>& lengths,
                                double round_share) {
  Configuration<Dim> state = empty_box<Dim>(lengths);
  state.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    state.shape[i] = random_shape(draw, round_share, ParticleShape<Dim>{});
    for (int k = 0; k < Dim; ++k) state.position[i][k] = draw.uniform(-0.5, 0.5) * lengths[k];
    turn(state, i, random_turn<Dim>(draw));
  }
  return state;
}

TEST(ExactCheckAgainstAScan, DisksAndEllipsesOfRandomSizes) {
  Stream draw(1, Purpose::tests);
  for (double round_share : {0.0, 0.5, 1.0}) {
    for (int k = 0; k < 20; ++k) {
      expect_equal_to_scan(random_state<2>(draw, 40, {30, 24}, round_share), 2);   // dense
      expect_equal_to_scan(random_state<2>(draw, 15, {90, 80}, round_share), 1);   // dilute
      expect_equal_to_scan(random_state<2>(draw, 8, {5, 70}, round_share), 5);     // own images
      expect_equal_to_scan(random_state<2>(draw, 3, {6.5, 7.5}, round_share), 5);  // small box
    }
  }
}

TEST(ExactCheckAgainstAScan, SpheresAndEllipsoidsOfRandomSizes) {
  Stream draw(2, Purpose::tests);
  for (double round_share : {0.0, 0.5, 1.0}) {
    for (int k = 0; k < 5; ++k) {
      expect_equal_to_scan(random_state<3>(draw, 25, {14, 11, 12}, round_share), 2);
      expect_equal_to_scan(random_state<3>(draw, 15, {50, 40, 45}, round_share), 1);
      expect_equal_to_scan(random_state<3>(draw, 6, {5, 30, 30}, round_share), 3);
      expect_equal_to_scan(random_state<3>(draw, 2, {5.5, 6.5, 6}, round_share), 3);
    }
  }
}

/// Positions anywhere within the 300 box lengths that the check allows.
TEST(ExactCheckAgainstAScan, PositionsFarOutsideOfTheBox) {
  Stream draw(3, Purpose::tests);
  for (int k = 0; k < 20; ++k) {
    Configuration2 wrapped = random_state<2>(draw, 20, {16, 32}, 0.5);
    for (Vec2& position : wrapped.position)  // in steps that survive the move
      position = (position * 0x1p30).array().round() * 0x1p-30;
    Configuration2 moved = wrapped;
    std::uint64_t overlaps = 0;
    for (Vec2& position : moved.position)
      position += moved.box.translation(
          {static_cast<int>(draw.uniform(-299, 299)), static_cast<int>(draw.uniform(-299, 299))});
    const ExactCheck<2> expected = scan(wrapped, 2);
    for (std::size_t limit : {100, 0}) {
      const ExactCheck<2> check = exact_check(moved, limit);
      EXPECT_EQ(check.smallest_gap, expected.smallest_gap);
      EXPECT_EQ(check.pairs_examined, expected.pairs_examined);
      EXPECT_EQ(check.overlaps.size(), expected.overlaps.size());
      overlaps += check.overlaps.size();
    }
    EXPECT_GT(overlaps, 0u);
  }
}

template <int Dim>
Real gap_of_two(const Configuration<Dim>& state) {
  const exact::Particle<Dim> one = exact::particle(state.shape[0], state.pose(0)),
                             two = exact::particle(state.shape[1], state.pose(1));
  return exact::examine(one, two, two.centre - one.centre, infinity).gap;
}

/// Moves the second of two particles towards the first until the pair touches but for the spacing of the
/// doubles, and then by a few of these spacings. A step as long as the gap cannot lead to an overlap.
template <int Dim>
void almost_touch(Stream& draw, Configuration<Dim>& state) {
  const Vec<Dim> direction = (state.position[1] - state.position[0]).normalized();
  double distance = state.shape[0].circumradius() + state.shape[1].circumradius();
  for (Real gap = 1; gap > 4e-15;) {
    state.position[1] = state.position[0] + distance * direction;
    gap = gap_of_two(state);
    distance -= static_cast<double>(gap);
  }
  for (double& x : state.position[1])
    x += std::round(draw.uniform(-4, 4)) * (std::nextafter(x, infinity) - x);
}

/// Returns how many pairs of 300 overlap. Pairs closer than what long double resolves are left out.
template <int Dim>
int expect_equal_near_touching(double round_share, std::uint64_t seed) {
  Stream draw(seed, Purpose::tests);
  int overlaps = 0;
  for (int k = 0; k < 300; ++k) {
    Configuration<Dim> state = random_state<Dim>(draw, 2, Vec<Dim>::Constant(60), round_share);
    almost_touch(draw, state);
    const Real gap = gap_of_two(state);
    EXPECT_LT(abs(gap), 1e-13);
    if (abs(gap) < 1e-16) continue;
    expect_equal_to_scan(state, 1);
    if (gap < 0) ++overlaps;
  }
  return overlaps;
}

TEST(ExactCheckAgainstAScan, PairsAFewUnitsInTheLastPlaceFromTouching) {
  for (double round_share : {0.0, 0.5, 1.0}) {
    for (int overlaps : {expect_equal_near_touching<2>(round_share, 4),
                         expect_equal_near_touching<3>(round_share, 5)}) {
      EXPECT_GT(overlaps, 60);
      EXPECT_LT(overlaps, 240);
    }
  }
}

}  // namespace
}  // namespace vitrel

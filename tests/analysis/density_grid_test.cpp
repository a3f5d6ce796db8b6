#include "analysis/structure/density_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include "core/random/stream.h"
#include "tests/support/solids.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;

/// q h/2π.
template <int Dim>
Vec<Dim> grid_wave(const WaveVector<Dim>& q, const Vec<Dim>& lengths, const Vec<Dim>& spacing) {
  Vec<Dim> wave;
  for (int k = 0; k < Dim; ++k) wave[k] = q.n[k] * spacing[k] / lengths[k];
  return wave;
}

// At x = 1/2 the images form Σ 1/(1 + 2m)^p over all whole m: 2 (1 − 2^−12) ζ(12), ζ(12) = 691
// π^12/638512875.
TEST(AliasBound, IsASumOverImages) {
  const double half = 2 * (1 - std::pow(2.0, -12)) * 691 * std::pow(pi, 12) / 638512875;
  EXPECT_NEAR(alias_bound(Vec2(0.5, 0)), half - 1, 1e-13);
  EXPECT_NEAR(alias_bound(Vec2(0, -0.5)), half - 1, 1e-13);
  EXPECT_NEAR(alias_bound(Vec2(0.5, 0.5)), half * half - 1, 1e-13);
  EXPECT_EQ(alias_bound(Vec2(0, 0)), 0);
}

TEST(AliasBound, IsBelowTheToleranceWhereverAGridIsUsed) {
  double largest = 0;
  for (int k = 0; k <= 90; ++k) {
    const double angle = k * pi / 180;
    for (const double x : {0.1, 0.2, largest_grid_wave})
      largest = std::max(largest, alias_bound<2>(x * Vec2(std::cos(angle), std::sin(angle))));
  }
  EXPECT_LT(largest, alias_tolerance);
  EXPECT_GT(largest, 0.9 * alias_tolerance);
}

TEST(AliasBound, IsBelowTheToleranceInThreeDimensions) {
  Stream draw(1, Purpose::tests);
  for (int k = 0; k < 1000; ++k)
    EXPECT_LT(alias_bound<3>(largest_grid_wave * random_direction(draw)), alias_tolerance);
  EXPECT_GT(alias_bound<3>(largest_grid_wave * Vec3::UnitZ()), 0.9 * alias_tolerance);
}

/// All images are in phase, and the error of ρ = 1 is the bound itself.
template <int Dim>
void expect_off_by_the_bound(const Vec<Dim>& lengths, double to) {
  const DensityGrid<Dim> grid(lengths, 0, to);
  const std::vector<Vec<Dim>> origin{Vec<Dim>::Zero()};
  const std::vector<Modes> modes = grid.modes(origin, {{1.0}});
  double largest = 0;
  for (std::size_t k = 0; k < modes[0].size(); ++k) {
    const Vec<Dim> x = grid_wave<Dim>(grid.wave_vectors()[k], lengths, grid.spacing());
    EXPECT_NEAR(std::abs(modes[0][k] - (1 + alias_bound<Dim>(x))), 0, 1e-12);
    largest = std::max(largest, std::abs(modes[0][k] - 1.0));
  }
  EXPECT_GT(largest, 0.5 * alias_tolerance);
  EXPECT_LT(largest, alias_tolerance);
}

TEST(DensityGrid, OfAPointOnANodeIsOffByTheBound) {
  expect_off_by_the_bound<2>({20, 31}, 6);
  expect_off_by_the_bound<3>({9, 15, 20}, 4.09);
}

template <int Dim>
struct Scene {
  Vec<Dim> lengths;
  double from, to;
};

/// Positive and negative weights, positions far outside of the box. Rounding: 1e-13 of the sum.
template <int Dim>
void expect_direct_sum_within_bound(const Scene<Dim>& scene) {
  const auto& [lengths, from, to] = scene;
  SCOPED_TRACE(lengths.transpose());
  Stream draw(3, Purpose::tests);
  std::vector<Vec<Dim>> positions;
  std::vector<Weights> fields(2);
  double sums[2] = {0, 0};
  for (int i = 0; i < 150; ++i) {
    Vec<Dim> boxes;
    for (double& box : boxes) box = draw.uniform(-2, 2);
    positions.push_back(lengths.cwiseProduct(boxes));
    fields[0].push_back(draw.uniform(-1, 2));
    fields[1].push_back(i % 2);
    for (int f = 0; f < 2; ++f) sums[f] += std::abs(fields[f].back());
  }
  const DensityGrid<Dim> grid(lengths, from, to);
  const std::vector<Modes> fast = grid.modes(positions, fields);
  const std::vector<Modes> exact = direct_modes(lengths, grid.wave_vectors(), positions, fields);
  double largest = 0;
  for (int f = 0; f < 2; ++f)
    for (std::size_t k = 0; k < exact[f].size(); ++k) {
      const double error = std::abs(fast[f][k] - exact[f][k]);
      const Vec<Dim> x = grid_wave<Dim>(grid.wave_vectors()[k], lengths, grid.spacing());
      EXPECT_LE(error, (alias_bound<Dim>(x) + 1e-13) * sums[f]);
      largest = std::max(largest, error / sums[f]);
    }
  // As large as √N images without order make it: the bound is no empty one.
  EXPECT_GT(largest, 0.1 * alias_tolerance / std::sqrt(150.0));
}

TEST(DensityGrid, AgreesWithTheDirectSumWithinTheBound) {
  const Scene<2> plane[] = {
      {{30, 30}, 0, 5}, {{7, 90}, 0, 4}, {{90, 7}, 2, 4}, {{2.5, 3}, 0, 9}, {{0.3, 40}, 0, 5}};
  for (const Scene<2>& scene : plane) expect_direct_sum_within_bound(scene);
  const Scene<3> space[] = {{{10, 10, 10}, 0, 5},
                            {{3, 12, 17}, 0, 4},
                            {{17, 12, 3}, 2, 4},
                            {{2.5, 3, 3}, 0, 9},
                            {{9, 0.3, 14}, 0, 4}};
  for (const Scene<3>& scene : space) expect_direct_sum_within_bound(scene);
}

/// Of every two opposite wave vectors with these wave numbers one is listed; returns how many there
/// are.
template <int Dim>
double expect_one_of_each(const Vec<Dim>& lengths, double from, double to) {
  const DensityGrid<Dim> grid(lengths, from, to);
  std::set<std::array<int, Dim>> met;
  for (const WaveVector<Dim>& q : grid.wave_vectors()) {
    const Eigen::Map<const Eigen::Vector<int, Dim>> n(q.n.data());
    std::array<int, Dim> opposite;
    std::ranges::transform(q.n, opposite.begin(), std::negate());
    EXPECT_TRUE(met.insert(q.n).second);
    EXPECT_FALSE(met.contains(opposite));
    const double wave_number = 2 * pi * n.template cast<double>().cwiseQuotient(lengths).norm();
    EXPECT_NEAR(q.wave_number, wave_number, 1e-12);
    EXPECT_TRUE(q.wave_number >= from && q.wave_number < to);
  }
  return static_cast<double>(met.size());
}

// π (q_max² − q_min²) L_x L_y/(2π)² wave vectors, half of them listed; the number of lattice points
// in an annulus is off by no more than the length of its edges. In space 4π (q_max³ − q_min³)/3 ·
// V/(2π)³; off by no more than half a cell of reciprocal space along the surfaces.
TEST(DensityGrid, ListsOneOfEachTwoOppositeWaveVectors) {
  const DensityGrid<2> grid({50, 40}, 2, 5);
  for (const WaveVector<2>& q : grid.wave_vectors())
    EXPECT_TRUE(q.n[1] > 0 || (q.n[1] == 0 && q.n[0] > 0));
  const double area = 50 * 40 / (4 * pi * pi), volume = 14 * 10 * 12 / std::pow(2 * pi, 3);
  EXPECT_NEAR(expect_one_of_each<2>({50, 40}, 2, 5), 0.5 * pi * (25 - 4) * area,
              0.5 * 2 * pi * (5 + 2) * std::sqrt(area));
  EXPECT_NEAR(expect_one_of_each<3>({14, 10, 12}, 2, 4), 0.5 * 4 * pi / 3 * (64 - 8) * volume,
              0.5 * 4 * pi * (16 + 4) * 0.5 * std::pow(volume, 2.0 / 3));
}

// ρ at three wave vectors of two points, by hand: L = 4, points at x = ±1 and y = 0, 1.
TEST(DirectModes, OfTwoPoints) {
  const std::vector<WaveVector<2>> waves{{{1, 0}, 0}, {{2, 0}, 0}, {{0, 1}, 0}};
  const std::vector<Vec2> positions{{1, 0}, {-1, 1}};
  const Modes rho = direct_modes(Vec2(4, 4), waves, positions, {{1.0, 3.0}})[0];
  // exp(−iπ/2) + 3 exp(iπ/2) = 2i; exp(−iπ) + 3 exp(iπ) = −4; 1 + 3 exp(−iπ/2) = 1 − 3i.
  EXPECT_NEAR(std::abs(rho[0] - std::complex<double>(0, 2)), 0, 1e-15);
  EXPECT_NEAR(std::abs(rho[1] - std::complex<double>(-4, 0)), 0, 1e-14);
  EXPECT_NEAR(std::abs(rho[2] - std::complex<double>(1, -3)), 0, 1e-14);
}

// L = 4, points at (1, 0, 1) and (0, 1, −1).
TEST(DirectModes, OfTwoPointsInThreeDimensions) {
  const std::vector<WaveVector<3>> waves{{{0, 0, 1}, 0}, {{1, -1, 2}, 0}};
  const std::vector<Vec3> positions{{1, 0, 1}, {0, 1, -1}};
  const Modes rho = direct_modes(Vec3(4, 4, 4), waves, positions, {{1.0, 3.0}})[0];
  // −i + 3i; exp(−i 3π/2) + 3 exp(−iπ/2 (−1 − 2)) = i − 3i.
  EXPECT_NEAR(std::abs(rho[0] - std::complex<double>(0, 2)), 0, 1e-15);
  EXPECT_NEAR(std::abs(rho[1] - std::complex<double>(0, -2)), 0, 1e-14);
}

}  // namespace
}  // namespace vitrel

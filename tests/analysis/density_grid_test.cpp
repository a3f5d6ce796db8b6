#include "analysis/structure/density_grid.h"

#include <gtest/gtest.h>

#include <cmath>
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

class DensityGridOfAGas : public testing::TestWithParam<Scene<2>> {};
TEST_P(DensityGridOfAGas, AgreesWithTheDirectSumWithinTheBound) {
  expect_direct_sum_within_bound(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Boxes, DensityGridOfAGas,
                         testing::Values(Scene<2>{{30, 30}, 0, 5}, Scene<2>{{7, 90}, 0, 4},
                                         Scene<2>{{90, 7}, 2, 4}, Scene<2>{{2.5, 3}, 0, 9},
                                         Scene<2>{{0.3, 40}, 0, 5}));

class DensityGridOfASolidGas : public testing::TestWithParam<Scene<3>> {};
TEST_P(DensityGridOfASolidGas, AgreesWithTheDirectSumWithinTheBound) {
  expect_direct_sum_within_bound(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Boxes, DensityGridOfASolidGas,
                         testing::Values(Scene<3>{{10, 10, 10}, 0, 5}, Scene<3>{{3, 12, 17}, 0, 4},
                                         Scene<3>{{17, 12, 3}, 2, 4}, Scene<3>{{2.5, 3, 3}, 0, 9},
                                         Scene<3>{{9, 0.3, 14}, 0, 4}));

// π (q_max² − q_min²) L_x L_y/(2π)² wave vectors, half of them listed; the number of lattice points
// in an annulus is off by no more than the length of its edges.
TEST(DensityGrid, ListsOneOfEachTwoOppositeWaveVectors) {
  const Vec2 lengths(50, 40);
  const DensityGrid grid(lengths, 2, 5);
  for (const WaveVector<2>& q : grid.wave_vectors()) {
    EXPECT_TRUE(q.n[1] > 0 || (q.n[1] == 0 && q.n[0] > 0));
    EXPECT_NEAR(q.wave_number, 2 * pi * std::hypot(q.n[0] / lengths.x(), q.n[1] / lengths.y()),
                1e-12);
    EXPECT_TRUE(q.wave_number >= 2 && q.wave_number < 5);
  }
  const double area = lengths.prod() / (4 * pi * pi);
  EXPECT_NEAR(static_cast<double>(grid.wave_vectors().size()), 0.5 * pi * (25 - 4) * area,
              0.5 * 2 * pi * (5 + 2) * std::sqrt(area));
}

// 4π (q_max³ − q_min³)/3 · V/(2π)³ of them, half of them listed; off by no more than half a cell of
// reciprocal space along the surfaces.
TEST(DensityGrid, ListsOneOfEachTwoOppositeWaveVectorsInThreeDimensions) {
  const Vec3 lengths(14, 10, 12);
  const DensityGrid<3> grid(lengths, 2, 4);
  std::set<std::array<int, 3>> met;
  for (const WaveVector<3>& q : grid.wave_vectors()) {
    const auto& [x, y, z] = q.n;
    EXPECT_TRUE(met.insert(q.n).second);
    EXPECT_FALSE(met.contains({-x, -y, -z}));
    EXPECT_NEAR(q.wave_number,
                2 * pi * std::hypot(x / lengths.x(), y / lengths.y(), z / lengths.z()), 1e-12);
    EXPECT_TRUE(q.wave_number >= 2 && q.wave_number < 4);
  }
  const double density = lengths.prod() / std::pow(2 * pi, 3);
  EXPECT_NEAR(static_cast<double>(met.size()), 0.5 * 4 * pi / 3 * (64 - 8) * density,
              0.5 * 4 * pi * (16 + 4) * 0.5 * std::pow(density, 2.0 / 3));
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

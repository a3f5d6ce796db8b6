#include "analysis/structure/structure_factor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/chi_squared.h"
#include "tests/support/fluids.h"
#include "tests/support/mixtures.h"
#include "tests/support/random_gas.h"
#include "tests/support/scenes.h"
#include "tests/support/triangular_lattice.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;

/// Two species, every third particle of the second, at random places; in the plane with random angles.
template <int Dim>
Configuration<Dim> gas(std::size_t n, const Vec<Dim>& lengths, std::uint64_t seed) {
  Stream draw(seed, Purpose::tests);
  auto c = random_gas<Dim>(n, lengths, draw, [&](Configuration<Dim>& gas, std::size_t i) {
    gas.species[i] = i % 3 == 0;
    if constexpr (Dim == 2) {
      gas.shape[i] = of_aspect_ratio(2);
      gas.angle[i] = draw.uniform(-pi, pi);
    }
  });
  c.species_names = {"A", "B"};
  return c;
}

/// |ΔS| of a pair of fields with n and m members and the structure factors s and t, when each mode is
/// off by ε times its members: products of ρ = √(n s) and √(m t).
double bound(double n, double m, double s, double t) {
  return alias_tolerance * (std::sqrt(s * m) + std::sqrt(t * n)) +
         alias_tolerance * alias_tolerance * std::sqrt(n * m) + 1e-11;
}

template <int Dim>
void expect_same_within_bound(const Configuration<Dim>& c, const ShellOptions& options) {
  const ScatteringShells<Dim> shells(c.box.lengths(), options);
  const StructureFactor fast = shells.transformed_structure_factor(c);
  const StructureFactor exact = shells.direct_structure_factor(c);
  std::vector<double> members(2, 0.0);
  for (const std::int32_t kind : c.species) members[kind] += 1;
  const double n = static_cast<double>(c.size());
  EXPECT_EQ(fast.modes, exact.modes);
  for (std::size_t k = 0; k < exact.q.size(); ++k) {
    if (exact.modes[k] == 0) continue;
    EXPECT_NEAR(fast.total[k], exact.total[k], bound(n, n, exact.total[k], exact.total[k]));
    // Both fields have Σ|w| ≤ R, and |c| + |s| ≤ √2 √(|c|² + |s|²).
    if (!exact.orientation.empty()) {
      EXPECT_NEAR(fast.orientation[k], exact.orientation[k],
                  2 * bound(n, n, exact.orientation[k], exact.orientation[k]));
    }
    if (exact.partial.empty()) continue;
    const double s[3] = {exact.partial[0][k], exact.partial[1][k], exact.partial[2][k]};
    EXPECT_NEAR(fast.partial[0][k], s[0], bound(members[0], members[0], s[0], s[0]));
    EXPECT_NEAR(fast.partial[1][k], s[1], bound(members[0], members[1], s[0], s[2]));
    EXPECT_NEAR(fast.partial[2][k], s[2], bound(members[1], members[1], s[2], s[2]));
  }
}

// To the last bit one of the two, so the choice shows.
TEST(StructureFactor, IsThatOfDirectSumsForFewParticles) {
  const Vec2 lengths(12, 9);
  const ScatteringShells shells(lengths, {8, 1});
  const Configuration2 few = gas<2>(ScatteringShells<2>::max_summed_directly, lengths, 3);
  EXPECT_EQ(shells.structure_factor(few).total, shells.direct_structure_factor(few).total);
  EXPECT_NE(shells.structure_factor(few).total, shells.transformed_structure_factor(few).total);
  const Configuration2 many = gas<2>(ScatteringShells<2>::max_summed_directly + 1, lengths, 3);
  EXPECT_EQ(shells.structure_factor(many).total, shells.transformed_structure_factor(many).total);
  EXPECT_NE(shells.structure_factor(many).total, shells.direct_structure_factor(many).total);
}

TEST(StructureFactor, ByTransformIsThatOfTheDirectSumInAFluid) {
  expect_same_within_bound(swollen_fluid(300, 3, 0.6), {});
  expect_same_within_bound(swollen_fluid(200, 1.5, 0.5, 0.2), {});
  for (const Mixture& mixture : mixtures()) {
    SCOPED_TRACE(mixture.name);
    expect_same_within_bound(inserted_mixture(mixture), {20, 0.3});
  }
}

// 120² q²: the box is folded twice, or along its longer side only. In space the second and the
// third box are folded, along all sides or the two longer.
TEST(StructureFactor, ByTransformIsThatOfTheDirectSumInFoldedBoxes) {
  expect_same_within_bound(gas<2>(300, {120, 120}, 1), {25, 0.2});
  expect_same_within_bound(gas<2>(100, {700, 30}, 2), {20, 0.5});
  expect_same_within_bound(gas<3>(200, {9, 11, 10}, 1), {6, 0.2});
  expect_same_within_bound(gas<3>(100, {25, 25, 25}, 2), {9, 0.3});
  expect_same_within_bound(gas<3>(100, {60, 12, 40}, 3), {8, 0.4});
}

TEST(StructureFactor, OfALatticeInStepWithTheGridKeepsToTheBound) {
  expect_same_within_bound(
      square_lattice(16, 0.5, 0.2, [](std::size_t) { return of_aspect_ratio(1.2); }), {10, 0.05});
}

// Folding leaves out wave vectors, but those it takes are wave vectors of the box: every level's are
// whole multiples, and each shell has some where the box has.
TEST(StructureFactor, TakesWaveVectorsInEveryShell) {
  const Vec2 lengths(200, 150);
  const ScatteringShells shells(lengths, {15, 0.2});
  const StructureFactor s = shells.structure_factor(gas<2>(10, lengths, 1));
  ASSERT_EQ(s.modes.size(), 75u);
  const double density = lengths.prod() / (4 * pi * pi);  // wave vectors per area
  for (std::size_t k = 0; k < 75; ++k) {
    const double all = 0.5 * pi * 0.04 * static_cast<double>(2 * k + 1) * density;
    EXPECT_GT(s.modes[k], std::min(0.6 * all, 90.0)) << k;
    EXPECT_LT(s.modes[k], 1.5 * all + 5) << k;
    EXPECT_NEAR(s.q[k], 0.2 * (static_cast<double>(k) + 0.5), 0.1) << k;
  }
}

/// Σ S over the wave vectors of every shell; those of the reciprocal lattice (columns: its primitive
/// vectors) have S = N, all others 0.
template <int Dim>
void expect_peaks(const Configuration<Dim>& c, const Eigen::Matrix<double, Dim, Dim>& reciprocal,
                  int rings) {
  const ShellOptions options{12, 0.05};
  const double n = static_cast<double>(c.size());
  std::vector<double> peaks(240, 0);
  const int most = 20;
  for (int i = -most; i <= most; ++i)
    for (int j = -most; j <= most; ++j)
      for (int k = Dim == 3 ? -most : 0; k <= (Dim == 3 ? most : 0); ++k) {
        const double q = (reciprocal * Vec3(i, j, k).head<Dim>()).norm();
        if (q > 0 && q < 12) peaks[static_cast<std::size_t>(q / 0.05)] += 0.5 * n;
      }
  const StructureFactor s = ScatteringShells<Dim>(c.box.lengths(), options).structure_factor(c);
  ASSERT_EQ(s.total.size(), peaks.size());
  int seen = 0;
  for (std::size_t k = 0; k < peaks.size(); ++k) {
    if (s.modes[k] == 0) continue;
    // Each wave vector within the bound for S = N, or for 0.
    const double tolerance = 2 * alias_tolerance * (peaks[k] + s.modes[k] * 1e-6 * n) + 1e-9;
    EXPECT_NEAR(s.modes[k] * s.total[k], peaks[k], tolerance) << s.q[k];
    seen += peaks[k] > 0;
  }
  EXPECT_EQ(seen, rings);
}

// Rings at √1, 2, 4, 5, 8, 9, 10, 13, 16, 17 and 18 times the first, 2.75.
TEST(StructureFactor, OfASquareLatticeHasPeaksOfHeightN) {
  const Configuration2 c = square_lattice(32, 0.6, 0, [](std::size_t) { return Ellipse{1, 1}; });
  const double q = 2 * pi * 32 / c.box.lengths().x();
  expect_peaks<2>(c, q * Mat2::Identity(), 11);
}

// 2π/2.03 = 3.09 times the root of 1, 2, 3, 4, 5, 6, 8, 9, 10, 11, 12, 13 and 14.
TEST(StructureFactor, OfASimpleCubicLatticeHasPeaksOfHeightN) {
  const Configuration3 c = cubic_lattice(8, simple_cubic, 0.5, {});
  expect_peaks<3>(c, 2 * pi * 8 / c.box.lengths().x() * Mat3::Identity(), 13);
}

// (2π/3.03) (h, k, l), all odd or all even: 2.07 times the root of 3, 4, 8, 11, 12, 16, 19, 20, 24, 27 and
// 32.
TEST(StructureFactor, OfAFaceCentredCubicLatticeHasPeaksOfHeightN) {
  const Configuration3 c = cubic_lattice(8, face_centred_cubic, 0.6, {});
  const Mat3 body_centred = (Mat3() << -1, 1, 1, 1, -1, 1, 1, 1, -1).finished();
  expect_peaks<3>(c, 2 * pi * 8 / c.box.lengths().x() * body_centred, 11);
}

// Rows of spacing d = 2.1, h = √3 d/2 apart: reciprocal vectors (2π/d)(1, −1/√3) and (2π/d)(0, 2/√3);
// rings at √1, 3, 4, 7, 9 and 12 times the first, 4π/(√3 d) = 3.45.
TEST(StructureFactor, OfATriangularLatticeHasPeaksOfHeightN) {
  const double d = 2.1;
  const Configuration2 c = triangular_lattice(32, 32, d);
  const double q = 2 * pi / d;
  const double third = 1 / std::sqrt(3.0);
  expect_peaks<2>(c, q * (Mat2() << 1, 0, -third, 2 * third).finished(), 6);
}

/// For independent points ⟨|ρ|²⟩ is N at every wave vector of the box, N_α for a species, and ⟨ρ_α
/// ρ_β*⟩ = 0; angles do not matter. Over 300 gases; χ² per shell is 1 with standard deviation
/// √(2/shells), six of them: neighbouring shells are correlated weakly through N only.
template <int Dim>
void expect_one_in_a_gas(const Vec<Dim>& lengths, const ShellOptions& options) {
  const ScatteringShells<Dim> shells(lengths, options);
  std::vector<BinnedValues> quantities(Dim == 2 ? 5 : 4);
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const StructureFactor s = shells.structure_factor(gas<Dim>(150, lengths, seed));
    const std::vector<double>* rows[5] = {&s.total, &s.partial.front(), &s.partial[1],
                                          &s.partial[2], &s.orientation};
    for (std::size_t m = 0; m < quantities.size(); ++m) {
      quantities[m].add(*rows[m]);
      EXPECT_TRUE(std::isnan(rows[m]->at(0)));  // the first shell has no wave vector
    }
  }
  for (std::size_t m = 0; m < quantities.size(); ++m) {
    SCOPED_TRACE(m);
    const ChiSquared chi = quantities[m].chi_squared(m == 2 ? 0 : 1);
    EXPECT_GT(chi.values, 20);
    chi.expect_one(6);
  }
}

TEST(StructureFactor, OfAnIdealGasIsOne) {
  expect_one_in_a_gas<2>({30, 22}, {6, 0.2});
  expect_one_in_a_gas<3>({13, 10, 11}, {5, 0.2});
}

/// However dilute a gas is, folding bounds the wave vectors. |ρ|²/N of independent points has the variance
/// 1 − 1/N at every one of them, and no correlation between them: χ² over the n shells within 6 √(2n).
template <int Dim>
void expect_one_in_a_dilute_gas(double side) {
  const Configuration<Dim> c = gas<Dim>(400, Vec<Dim>::Constant(side), 1);
  const StructureFactor s = ScatteringShells<Dim>(c.box.lengths(), {}).structure_factor(c);
  double vectors = 0;
  ChiSquared shells;
  for (std::size_t k = 0; k < s.q.size(); ++k) {
    if (s.modes[k] == 0) continue;
    vectors += s.modes[k];
    shells.add(s.total[k] - 1, std::sqrt((1 - 1 / 400.0) / s.modes[k]));
  }
  EXPECT_GT(shells.values, 115) << side;
  EXPECT_LT(vectors, 150'000) << side;
  shells.expect_one(6);
}

// φ = 5 × 10⁻⁴ and 5 × 10⁻⁸: in the plane there are 1.4 × 10⁷ and 1.4 × 10¹¹ wave vectors.
TEST(StructureFactor, OfADiluteGasIsOneOnABoundedNumberOfWaveVectors) {
  expect_one_in_a_dilute_gas<2>(1585);
  expect_one_in_a_dilute_gas<2>(158'500);
  expect_one_in_a_dilute_gas<3>(149.6);
  expect_one_in_a_dilute_gas<3>(3224);
}

// Σ_αβ √(x_α x_β) S_αβ = S, where A_B counts twice.
TEST(StructureFactor, OfTheSpeciesAddsUpToTheTotal) {
  const Configuration2 c = gas<2>(90, {20, 25}, 5);
  const StructureFactor s = ScatteringShells(c.box.lengths(), {8, 0.25}).structure_factor(c);
  for (std::size_t k = 0; k < s.q.size(); ++k) {
    if (s.modes[k] == 0) continue;
    const double sum = 2.0 / 3 * s.partial[0][k] + 2 * std::sqrt(2.0) / 3 * s.partial[1][k] +
                       1.0 / 3 * s.partial[2][k];
    EXPECT_NEAR(sum, s.total[k], 1e-12);
  }
  EXPECT_EQ(pair_names({"A", "B", "C"}),
            (std::vector<std::string>{"A_A", "A_B", "A_C", "B_B", "B_C", "C_C"}));
}

TEST(StructureFactor, OfOrientationsIsThatOfCentresWhereAllAreParallel) {
  Configuration2 c = gas<2>(60, {20, 20}, 6);
  for (double& angle : c.angle) angle = 0.7;
  const StructureFactor s = ScatteringShells(c.box.lengths(), {8, 0.4}).structure_factor(c);
  for (std::size_t k = 1; k < s.q.size(); ++k) EXPECT_NEAR(s.orientation[k], s.total[k], 1e-10);
}

// Angles that turn along x by 3 half turns per box: cos 2θ and sin 2θ are waves with n = 3, their modes
// N/2 at ± q and S₂ = N/2 there; the lattice shows nothing.
TEST(StructureFactor, OfOrientationsSeesAWaveOfTheDirector) {
  Configuration2 c = square_lattice(12, 0.5, 0, [](std::size_t) { return of_aspect_ratio(1.5); });
  const double wave = 2 * pi * 3 / c.box.lengths().x(), step = wave / 9.5;
  for (std::size_t i = 0; i < c.size(); ++i) c.angle[i] = 0.5 * wave * c.position[i].x();
  const StructureFactor s =
      ScatteringShells(c.box.lengths(), {10 * step, step}).structure_factor(c);
  for (std::size_t k = 0; k < 10; ++k) {
    if (s.modes[k] == 0) continue;
    // (3, 0) and (0, 3) are alone in their shell: (2, 2) has 2.83.
    EXPECT_NEAR(s.modes[k] * s.orientation[k], k == 9 ? 72 : 0, 72 * 4 * alias_tolerance) << k;
    EXPECT_NEAR(s.total[k], 0, 1e-6);
  }
  EXPECT_EQ(s.modes[9], 2);
}

TEST(StructureFactor, OfDisksAndSolidsHasNoOrientation) {
  Configuration2 c = gas<2>(20, {20, 20}, 6);
  for (Ellipse& shape : c.shape) shape = {1, 1};
  EXPECT_TRUE(ScatteringShells(c.box.lengths(), {}).structure_factor(c).orientation.empty());
  const Configuration3 solids = gas<3>(20, {9, 9, 9}, 6);
  EXPECT_TRUE(ScatteringShells<3>(solids.box.lengths(), {4, 0.5})
                  .structure_factor(solids)
                  .orientation.empty());
}

}  // namespace
}  // namespace vitrel

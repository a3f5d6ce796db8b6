#include "analysis/structure/pair_correlation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random/stream.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;

Configuration2 gas(std::size_t n, const Vec2& lengths, std::uint64_t seed) {
  Configuration2 c;
  c.resize(n);
  c.box = PeriodicBox<2>(lengths);
  Stream draw(seed, Purpose::tests);
  for (std::size_t i = 0; i < n; ++i) {
    c.shape[i] = i % 4 == 0 ? Ellipse{1, 1} : of_aspect_ratio(2);
    c.position[i] = lengths.cwiseProduct(Vec2{draw.uniform(-0.5, 0.5), draw.uniform(-0.5, 0.5)});
    c.angle[i] = draw.uniform(-pi, pi);
  }
  return c;
}

// All pairs, nearest images, angles as they are.
TEST(PairCorrelation, IsThatOfALoopOverAllPairs) {
  for (const Vec2& lengths : {Vec2(30, 30), Vec2(50, 17), Vec2(9, 70)})
    for (const double range : {3.1, 40.0}) {
      const Configuration2 c = gas(120, lengths, 2);
      const PairCorrelation fast = pair_correlation(c, {range, 0.5});
      const auto bins =
          static_cast<std::size_t>(std::min(range, 0.5 * lengths.minCoeff()) / 0.5 + 1e-9);
      ASSERT_EQ(fast.g.size(), bins);
      std::vector<double> pairs(bins), rotors(bins), cosines_2(bins), cosines_4(bins);
      for (std::size_t i = 0; i < c.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
          Vec2 d = c.position[j] - c.position[i];
          d += c.box.translation(c.box.nearest_shift(d));
          const auto bin = static_cast<std::size_t>(d.norm() / 0.5);
          if (bin >= bins) continue;
          ++pairs[bin];
          if (i % 4 == 0 || j % 4 == 0) continue;
          ++rotors[bin];
          cosines_2[bin] += std::cos(2 * (c.angle[i] - c.angle[j]));
          cosines_4[bin] += std::cos(4 * (c.angle[i] - c.angle[j]));
        }
      for (std::size_t k = 0; k < bins; ++k) {
        const double r = 0.5 * static_cast<double>(k);
        const double ring = pi * ((r + 0.5) * (r + 0.5) - r * r);
        EXPECT_NEAR(fast.g[k], pairs[k] * lengths.prod() / (120 * 119 / 2. * ring), 1e-10);
        EXPECT_NEAR(fast.distance[k], r + 0.25, 1e-12);
        EXPECT_EQ(fast.rotor_pairs[k], rotors[k]);
        if (rotors[k] == 0) continue;
        EXPECT_NEAR(fast.g_2[k], cosines_2[k] / rotors[k], 1e-12);
        EXPECT_NEAR(fast.g_4[k], cosines_4[k] / rotors[k], 1e-12);
      }
    }
}

// ⟨g⟩ = 1 in every bin, ⟨g_n⟩ = 0; 300 gases. χ² per bin with its standard deviation √(2/bins), five
// of them.
TEST(PairCorrelation, OfAnIdealGasIsOne) {
  std::vector<std::vector<double>> g(20), g_2(20), g_4(20);
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const PairCorrelation one = pair_correlation(gas(100, {24, 20}, seed), {10, 0.5});
    for (std::size_t k = 0; k < 20; ++k) {
      g[k].push_back(one.g[k]);
      if (one.rotor_pairs[k] == 0) continue;
      g_2[k].push_back(one.g_2[k]);
      g_4[k].push_back(one.g_4[k]);
    }
  }
  const auto chi_squared = [](const std::vector<std::vector<double>>& values, double truth) {
    double sum = 0;
    for (const std::vector<double>& bin : values) {
      const Estimate mean = estimate(bin);
      sum += std::pow((mean.mean - truth) / mean.error, 2);
    }
    return sum / static_cast<double>(values.size());
  };
  EXPECT_NEAR(chi_squared(g, 1), 1, 5 * std::sqrt(2.0 / 20));
  EXPECT_NEAR(chi_squared(g_2, 0), 1, 5 * std::sqrt(2.0 / 20));
  EXPECT_NEAR(chi_squared(g_4, 0), 1, 5 * std::sqrt(2.0 / 20));
}

// Square lattice, neighbours of a checkerboard turned by 45°: cos 2·45° = 0 and cos 4·45° = −1 between
// the two colours, 1 within one.
TEST(PairCorrelation, OfACheckerboard) {
  Configuration2 c = square_lattice(12, 0.4, 0, [](std::size_t) { return of_aspect_ratio(1.2); });
  for (std::size_t i = 0; i < c.size(); ++i)
    c.angle[i] = (i % 12 + i / 12) % 2 ? 0.3 : 0.3 + pi / 4;
  const double spacing = c.box.lengths().x() / 12, step = 0.11 * spacing;
  const PairCorrelation pairs = pair_correlation(c, {6 * spacing, step});
  const double density = 143 / c.box.volume();
  for (const auto& [r, sign, neighbours] :
       {std::tuple{1.0, -1, 4}, {std::sqrt(2.0), 1, 4}, {2.0, 1, 4}, {std::sqrt(5.0), -1, 8}}) {
    const auto bin = static_cast<std::size_t>(r * spacing / step);
    const double inner = static_cast<double>(bin) * step, outer = inner + step;
    EXPECT_NEAR(pairs.g[bin] * density * pi * (outer * outer - inner * inner), neighbours, 1e-10);
    EXPECT_NEAR(pairs.g_2[bin], sign > 0 ? 1 : 0, 1e-12);
    EXPECT_NEAR(pairs.g_4[bin], sign, 1e-12);
  }
  EXPECT_EQ(pairs.g[2], 0);
  EXPECT_TRUE(std::isnan(pairs.g_2[2]));
}

/// Two thirds of them spheroids, the others spheres.
Configuration3 solid_gas(std::size_t n, const Vec3& lengths, std::uint64_t seed) {
  Configuration3 c;
  c.resize(n);
  c.box = PeriodicBox<3>(lengths);
  Stream draw(seed, Purpose::tests);
  for (std::size_t i = 0; i < n; ++i) {
    for (int k = 0; k < 3; ++k) c.position[i][k] = lengths[k] * draw.uniform(-0.5, 0.5);
    if (i % 3 == 0) continue;
    c.shape[i].semi_axes = Vec3(1, 1, 2);
    c.orientation[i] =
        Quaternion{draw.normal(), draw.normal(), draw.normal(), draw.normal()}.normalized();
  }
  return c;
}

double shell(double inner, double outer) {
  return 4 * pi / 3 * (std::pow(outer, 3) - std::pow(inner, 3));
}

TEST(PairCorrelation, IsThatOfALoopOverAllPairsInThreeDimensions) {
  for (const Vec3& lengths : {Vec3(12, 12, 12), Vec3(7, 30, 9), Vec3(20, 5, 40)})
    for (const double range : {1.1, 30.0}) {
      const Configuration3 c = solid_gas(150, lengths, 2);
      const PairCorrelation fast = pair_correlation(c, {range, 0.25});
      const auto bins =
          static_cast<std::size_t>(std::min(range, 0.5 * lengths.minCoeff()) / 0.25 + 1e-9);
      ASSERT_EQ(fast.g.size(), bins);
      std::vector<double> pairs(bins), rotor_pairs(bins), p_2(bins), p_4(bins);
      for (std::size_t i = 0; i < c.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
          Vec3 d = c.position[j] - c.position[i];
          d += c.box.translation(c.box.nearest_shift(d));
          const auto bin = static_cast<std::size_t>(d.norm() / 0.25);
          if (bin >= bins) continue;
          ++pairs[bin];
          if (i % 3 == 0 || j % 3 == 0) continue;
          const double cosine =
              (c.orientation[i] * Vec3::UnitZ()).dot(c.orientation[j] * Vec3::UnitZ());
          ++rotor_pairs[bin];
          p_2[bin] += std::legendre(2, cosine);
          p_4[bin] += std::legendre(4, cosine);
        }
      for (std::size_t k = 0; k < bins; ++k) {
        const double r = 0.25 * static_cast<double>(k);
        EXPECT_NEAR(fast.g[k], pairs[k] * lengths.prod() / (150 * 149 / 2. * shell(r, r + 0.25)),
                    1e-10);
        EXPECT_NEAR(fast.distance[k], r + 0.125, 1e-12);
        EXPECT_EQ(fast.rotor_pairs[k], rotor_pairs[k]);
        if (rotor_pairs[k] == 0) continue;
        EXPECT_NEAR(fast.g_2[k], p_2[k] / rotor_pairs[k], 1e-12);
        EXPECT_NEAR(fast.g_4[k], p_4[k] / rotor_pairs[k], 1e-12);
      }
    }
}

// As in the plane; the first bin of 0.4 has 2 pairs on the average, too few for χ².
TEST(PairCorrelation, OfAnIdealGasIsOneInThreeDimensions) {
  std::vector<std::vector<double>> g(12);
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const PairCorrelation one = pair_correlation(solid_gas(150, {10, 12, 11}, seed), {5, 0.4});
    ASSERT_EQ(one.g.size(), g.size());
    for (std::size_t k = 0; k < g.size(); ++k) g[k].push_back(one.g[k]);
  }
  double chi_squared = 0;
  for (std::size_t k = 1; k < g.size(); ++k) {
    const Estimate mean = estimate(g[k]);
    chi_squared += std::pow((mean.mean - 1) / mean.error, 2);
  }
  EXPECT_NEAR(chi_squared / 11, 1, 5 * std::sqrt(2.0 / 11));
}

// 12 neighbours at d, 6 at √2 d, 24 at √3 d, 12 at 2 d, nothing between.
TEST(PairCorrelation, OfAFaceCentredCubicLattice) {
  const Configuration3 c = cubic_lattice(5, face_centred_cubic, 0.5, {});
  const double d = c.box.lengths().x() / 5 / std::sqrt(2.0), step = 0.11 * d;
  const PairCorrelation pairs = pair_correlation(c, {3 * d, step});
  const double density = static_cast<double>(c.size() - 1) / c.box.volume();
  std::vector<double> neighbours(pairs.g.size());
  for (const auto& [r, count] : {std::pair{1.0, 12},
                                 {std::sqrt(2.0), 6},
                                 {std::sqrt(3.0), 24},
                                 {2.0, 12},
                                 {std::sqrt(5.0), 24},
                                 {std::sqrt(6.0), 8},
                                 {std::sqrt(7.0), 48},
                                 {std::sqrt(8.0), 6}})
    neighbours[static_cast<std::size_t>(r * d / step)] += count;
  for (std::size_t k = 0; k < pairs.g.size(); ++k) {
    const double inner = static_cast<double>(k) * step;
    EXPECT_NEAR(pairs.g[k] * density * shell(inner, inner + step), neighbours[k], 1e-9) << k;
  }
}

/// Species A, B and C in turn, and a single particle of species D.
template <class Gas>
Gas mixed(Gas gas) {
  gas.species_names = {"A", "B", "C", "D"};
  for (std::size_t i = 0; i < gas.size(); ++i) gas.species[i] = static_cast<std::int32_t>(i % 3);
  gas.species.back() = 3;
  return gas;
}

// Species are counted beside the pairs: nothing else changes by a bit.
TEST(PairCorrelation, IsTheSameWithoutSpecies) {
  const PairCorrelation one = pair_correlation(gas(120, {30, 40}, 4));
  const PairCorrelation four = pair_correlation(mixed(gas(120, {30, 40}, 4)));
  EXPECT_TRUE(one.partial.empty());
  EXPECT_EQ(one.g, four.g);
  EXPECT_EQ(one.rotor_pairs, four.rotor_pairs);
  for (std::size_t k = 0; k < one.g.size(); ++k) {
    if (one.rotor_pairs[k] == 0) continue;
    EXPECT_EQ(one.g_2[k], four.g_2[k]);
    EXPECT_EQ(one.g_4[k], four.g_4[k]);
  }
}

TEST(PairCorrelation, HasNoSpeciesWhereOneHasAllParticles) {
  Configuration2 c = gas(30, {20, 20}, 4);
  c.species_names = {"A", "B"};
  EXPECT_TRUE(pair_correlation(c).partial.empty());
  c.species[7] = 1;
  EXPECT_EQ(pair_correlation(c).partial.size(), 3u);
}

/// Mean of (g − 1)²/error² over bins of independent gases, and the number of bins.
struct ChiSquared {
  double sum = 0, bins = 0;

  void add(const std::vector<std::vector<double>>& g_of_gases, std::size_t first) {
    for (std::size_t k = first; k < g_of_gases.front().size(); ++k, ++bins) {
      std::vector<double> values;
      for (const std::vector<double>& g : g_of_gases) values.push_back(g[k]);
      const Estimate mean = estimate(values);
      sum += std::pow((mean.mean - 1) / mean.error, 2);
    }
  }
  /// Five standard deviations √(2/bins) of the mean.
  void expect_one() const { EXPECT_NEAR(sum / bins, 1, 5 * std::sqrt(2 / bins)); }
};

// Six particles of A: with N_A²/2 pairs instead of N_A (N_A − 1)/2, g_AA would be 5/6, which is 1.5 to 3
// standard errors in every bin. Bins from r = 2 on, with some 90 pairs of A or more in the 400 gases.
TEST(PairCorrelation, OfSpeciesOfAnIdealGasIsOne) {
  std::vector<std::vector<std::vector<double>>> g(3);
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    Configuration2 c = gas(36, {24, 20}, seed);
    c.species_names = {"A", "B"};
    for (std::size_t i = 6; i < 36; ++i) c.species[i] = 1;
    const PairCorrelation pairs = pair_correlation(c, {10, 0.5});
    ASSERT_EQ(pairs.partial.size(), 3u);
    for (std::size_t pair = 0; pair < 3; ++pair) g[pair].push_back(pairs.partial[pair]);
  }
  for (const std::vector<std::vector<double>>& of_pair : g) {
    ChiSquared chi;
    chi.add(of_pair, 4);
    EXPECT_EQ(chi.bins, 16);
    chi.expect_one();
  }
}

TEST(PairCorrelation, IsEmptyInABoxNarrowerThanTwoBins) {
  EXPECT_TRUE(pair_correlation(gas(5, {1, 8}, 1), {20, 0.6}).g.empty());
}

}  // namespace
}  // namespace vitrel

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

double number_of(const std::vector<std::int32_t>& species, std::size_t kind) {
  return static_cast<double>(std::ranges::count(species, static_cast<std::int32_t>(kind)));
}

/// Place of the pair A ≤ B among AA, AB … BB … of four species.
std::size_t place_of_pair(std::size_t a, std::size_t b) {
  return a * 4 - a * (a + 1) / 2 + b;
}

double shell_of(const Configuration2&, double inner, double outer) {
  return pi * (outer * outer - inner * inner);
}
double shell_of(const Configuration3&, double inner, double outer) {
  return shell(inner, outer);
}

Vec2 axis_of(const Configuration2& c, std::size_t i) {
  return {std::cos(c.angle[i]), std::sin(c.angle[i])};
}
Vec3 axis_of(const Configuration3& c, std::size_t i) {
  return c.orientation[i] * Vec3::UnitZ();
}

/// The bin of an axis and a separation, by the angle itself.
std::size_t angle_bin(const Vec2& axis, const Vec2& separation) {
  const double cosine = std::abs(axis.dot(separation)) / separation.norm();
  return std::min<std::size_t>(static_cast<std::size_t>(std::acos(cosine) * 18 / pi), 8);
}
std::size_t angle_bin(const Vec3& axis, const Vec3& separation) {
  const double cosine = std::abs(axis.dot(separation)) / separation.norm();
  return 9 - std::min<std::size_t>(static_cast<std::size_t>(10 * cosine), 9);
}

/// What is counted in bins of width 0.5: pairs of every two species, and neighbours by the angle.
template <int Dim>
struct Counts {
  std::vector<std::vector<double>> species, angles;

  Counts(const Configuration<Dim>& c, std::size_t bins)
      : species(10, std::vector<double>(bins)),
        angles(axis_angle_bins<Dim>, std::vector<double>(bins)) {
    for (std::size_t i = 0; i < c.size(); ++i)
      for (std::size_t j = 0; j < c.size(); ++j) {
        Vec<Dim> d = c.position[j] - c.position[i];
        d += c.box.translation(c.box.nearest_shift(d));
        const auto bin = static_cast<std::size_t>(d.norm() / 0.5);
        if (i == j || bin >= bins) continue;
        const auto a = static_cast<std::size_t>(c.species[i]);
        const auto b = static_cast<std::size_t>(c.species[j]);
        if (a < b || (a == b && i < j)) ++species[place_of_pair(a, b)][bin];
        if (!c.shape[i].is_round()) ++angles[angle_bin(axis_of(c, i), d)][bin];
      }
  }
};

/// g · pairs · shell/volume is the count.
template <int Dim>
void expect_counts(const Configuration<Dim>& c, const std::vector<double>& g, double pairs,
                   const std::vector<double>& counts) {
  ASSERT_EQ(g.size(), counts.size());
  for (std::size_t k = 0; k < g.size(); ++k) {
    const double r = 0.5 * static_cast<double>(k);
    EXPECT_NEAR(g[k] * pairs * shell_of(c, r, r + 0.5) / c.box.volume(), counts[k], 1e-9) << k;
  }
}

template <int Dim>
void expect_loop_over_all_pairs(const Configuration<Dim>& c) {
  const PairCorrelation pairs = pair_correlation(c, {20, 0.5});
  const Counts<Dim> counts(c, pairs.g.size());
  ASSERT_EQ(pairs.partial.size(), 10u);
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = a; b < 4; ++b) {
      const std::vector<double>& g = pairs.partial[place_of_pair(a, b)];
      const double of_a = number_of(c.species, a), of_b = number_of(c.species, b);
      if (a == 3)
        EXPECT_TRUE(g.empty());  // of a single particle
      else
        expect_counts(c, g, a == b ? of_a * (of_a - 1) / 2 : of_a * of_b,
                      counts.species[place_of_pair(a, b)]);
    }
  const PairCorrelationByAngle by_angle = pair_correlation_by_angle(c, {20, 0.5});
  const auto rotors = static_cast<double>(rotor_count(c)), n = static_cast<double>(c.size());
  ASSERT_EQ(by_angle.g.size(), counts.angles.size());
  for (std::size_t angle = 0; angle < by_angle.g.size(); ++angle) {
    const std::vector<double>& all = counts.angles[angle];
    ASSERT_LE(by_angle.g[angle].size(), all.size());
    const auto end = all.begin() + static_cast<std::ptrdiff_t>(by_angle.g[angle].size());
    expect_counts(c, by_angle.g[angle], rotors * (n - 1) / static_cast<double>(by_angle.g.size()),
                  {all.begin(), end});
  }
}

TEST(PairCorrelation, OfSpeciesAndAnglesIsThatOfALoopOverAllPairs) {
  for (const Vec2& lengths : {Vec2(30, 30), Vec2(50, 17), Vec2(9, 70)})
    expect_loop_over_all_pairs(mixed(gas(121, lengths, 3)));
  for (const Vec3& lengths : {Vec3(12, 12, 12), Vec3(7, 30, 9), Vec3(24, 25, 40)})
    expect_loop_over_all_pairs(mixed(solid_gas(151, lengths, 3)));
}

// 2.5 times the longest diameter, 2 √2 of ellipses and 4 of spheroids, in steps of 0.5; half a box; and what was
// asked for.
TEST(PairCorrelation, ByAngleReachesAsFarAsTheParticlesAreLong) {
  EXPECT_EQ(pair_correlation_by_angle(gas(20, {40, 50}, 1), {20, 0.5}).distance.size(), 14u);
  EXPECT_EQ(pair_correlation_by_angle(gas(20, {8, 50}, 1), {20, 0.5}).distance.size(), 8u);
  EXPECT_EQ(pair_correlation_by_angle(gas(20, {40, 50}, 1), {3, 0.5}).distance.size(), 6u);
  const Configuration3 solids = solid_gas(20, {40, 50, 60}, 1);
  const PairCorrelationByAngle pairs = pair_correlation_by_angle(solids, {20, 0.5});
  ASSERT_EQ(pairs.distance.size(), 20u);
  EXPECT_EQ(pairs.distance[3], 1.75);
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

/// Σ over pairs of species, weighted with their numbers, is g; the mean over the angles is g if none is round.
template <int Dim>
void expect_sums(Configuration<Dim> c, const ParticleShape<Dim>& shape) {
  c.shape.assign(c.size(), shape);
  const PairCorrelation pairs = pair_correlation(c, {20, 0.3});
  const PairCorrelationByAngle by_angle = pair_correlation_by_angle(c, {20, 0.3});
  const auto n = static_cast<double>(c.size());
  for (std::size_t k = 0; k < pairs.g.size(); ++k) {
    double sum = 0;
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = a; b < 4; ++b) {
        const std::vector<double>& g = pairs.partial[place_of_pair(a, b)];
        const double of_a = number_of(c.species, a), of_b = number_of(c.species, b);
        if (!g.empty()) sum += g[k] * (a == b ? of_a * (of_a - 1) / 2 : of_a * of_b);
      }
    EXPECT_NEAR(sum / (n * (n - 1) / 2), pairs.g[k], 1e-12 * (1 + pairs.g[k]));
  }
  ASSERT_GT(by_angle.distance.size(), 15u);
  for (std::size_t k = 0; k < by_angle.distance.size(); ++k) {
    double sum = 0;
    for (const std::vector<double>& g : by_angle.g) sum += g[k];
    EXPECT_NEAR(sum / static_cast<double>(by_angle.g.size()), pairs.g[k], 1e-12 * (1 + pairs.g[k]));
  }
}

TEST(PairCorrelation, IsTheSumOverSpeciesAndTheMeanOverAngles) {
  expect_sums<2>(mixed(gas(200, {24, 20}, 5)), of_aspect_ratio(3));
  expect_sums<3>(mixed(solid_gas(200, {10, 12, 11}, 5)), Ellipsoid{Vec3(1, 1, 3)});
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

/// From r = 1 on, every bin of both has 2000 neighbours or more in the 300 gases.
template <class Gas>
void expect_no_angles(Gas&& gas_of) {
  std::vector<std::vector<std::vector<double>>> g;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const PairCorrelationByAngle one = pair_correlation_by_angle(gas_of(seed), {10, 0.5});
    g.resize(one.g.size());
    for (std::size_t angle = 0; angle < g.size(); ++angle) g[angle].push_back(one.g[angle]);
  }
  ChiSquared all;
  for (const std::vector<std::vector<double>>& of_angle : g) {
    ChiSquared chi;
    chi.add(of_angle, 2);
    chi.expect_one();
    all.add(of_angle, 2);
  }
  all.expect_one();
}

TEST(PairCorrelation, ByAngleOfAnIdealGasIsOne) {
  expect_no_angles([](std::uint64_t seed) { return gas(100, {24, 20}, seed); });
  expect_no_angles([](std::uint64_t seed) { return solid_gas(150, {10, 12, 11}, seed); });
}

/// Two species at the sites of a lattice like the colours of a chessboard; all axes along x, in space along z.
Configuration2 two_colours(const Configuration2& lattice) {
  Configuration2 c = lattice;
  c.species_names = {"A", "B"};
  for (std::size_t i = 0; i < c.size(); ++i) {
    c.species[i] = (i % 12 + i / 12) % 2;
    c.angle[i] = 0;
  }
  return c;
}
Configuration3 two_colours(const Configuration3& lattice) {
  Configuration3 c = lattice;
  c.species_names = {"A", "B"};
  const double spacing = c.box.lengths().x() / 6;
  for (std::size_t i = 0; i < c.size(); ++i) {
    const Vec3 site = (c.position[i] / spacing).array().floor();
    c.species[i] = static_cast<long>(site.sum()) % 2 != 0;
  }
  return c;
}

/// Neighbours of every site at a distance, all of its own species or all of the other, and how many of them
/// are in a bin of the angle.
struct Neighbours {
  double squared_distance;
  bool is_like;
  double count;
  std::vector<std::pair<std::size_t, double>> angles;
};

/// Bins narrower than the distances differ.
template <int Dim>
void expect_crystal(const Configuration<Dim>& c, double spacing,
                    const std::vector<Neighbours>& shells) {
  const double step = 0.11 * spacing, n = static_cast<double>(c.size());
  const PairCorrelation pairs = pair_correlation(c, {2.4 * spacing, step});
  const PairCorrelationByAngle by_angle = pair_correlation_by_angle(c, {2.4 * spacing, step});
  const std::size_t bins = pairs.g.size();
  std::vector<double> like(bins), unlike(bins);
  std::vector<std::vector<double>> angles(axis_angle_bins<Dim>, std::vector<double>(bins));
  for (const Neighbours& shell : shells) {
    const auto bin = static_cast<std::size_t>(std::sqrt(shell.squared_distance) * spacing / step);
    (shell.is_like ? like : unlike)[bin] += shell.count;
    for (const auto& [angle, count] : shell.angles) angles[angle][bin] += count;
  }
  ASSERT_EQ(pairs.partial.size(), 3u);
  ASSERT_EQ(by_angle.distance.size(), bins);
  for (std::size_t k = 0; k < bins; ++k) {
    const double inner = static_cast<double>(k) * step;
    const double share = shell_of(c, inner, inner + step) / c.box.volume();
    EXPECT_NEAR(pairs.partial[0][k] * (n / 2 - 1) * share, like[k], 1e-9) << k;
    EXPECT_NEAR(pairs.partial[1][k] * (n / 2) * share, unlike[k], 1e-9) << k;
    EXPECT_NEAR(pairs.partial[2][k] * (n / 2 - 1) * share, like[k], 1e-9) << k;
    for (std::size_t angle = 0; angle < angles.size(); ++angle)
      EXPECT_NEAR(by_angle.g[angle][k] * (n - 1) * share / axis_angle_bins<Dim>, angles[angle][k],
                  1e-9)
          << k << ' ' << angle;
  }
}

// The four at 45° are in the fifth of the bins of 10°; the eight at √5 at 26.6° and 63.4°.
TEST(PairCorrelation, OfTwoSquareLattices) {
  const Configuration2 c =
      two_colours(square_lattice(12, 0.7, 0, [](std::size_t) { return of_aspect_ratio(1.2); }));
  expect_crystal(c, c.box.lengths().x() / 12,
                 {{1, false, 4, {{0, 2}, {8, 2}}},
                  {2, true, 4, {{4, 4}}},
                  {4, true, 4, {{0, 2}, {8, 2}}},
                  {5, false, 8, {{2, 4}, {6, 4}}}});
}

// Rock salt, axes along z; bins of cos θ from 1 downwards, 0.1 each: 1/√2 is in the third, 1/√3 in the fifth;
// (1, 2, 0) and its like have 2/√5 = 0.89, 1/√5 = 0.45 and 0.
TEST(PairCorrelation, OfRockSalt) {
  const Configuration3 c = two_colours(cubic_lattice(6, simple_cubic, 0.5, {Vec3(1, 1, 1.3)}));
  expect_crystal(c, c.box.lengths().x() / 6,
                 {{1, false, 6, {{0, 2}, {9, 4}}},
                  {2, true, 12, {{2, 8}, {9, 4}}},
                  {3, false, 8, {{4, 8}}},
                  {4, true, 6, {{0, 2}, {9, 4}}},
                  {5, false, 24, {{1, 8}, {5, 8}, {9, 8}}}});
}

/// Two particles at a distance of 2.3, each across an edge of the box: what they have in the bin from 2.2 to
/// 2.4, as shares of what all have; elsewhere there is nothing.
template <int Dim>
std::vector<double> shares(Configuration<Dim> c, const Vec<Dim>& direction) {
  c.box = PeriodicBox<Dim>(Vec<Dim>::Constant(12));
  c.position[0] = 5.9 * direction;
  c.position[1] = (5.9 + 2.3) * direction;
  c.position[1] += c.box.translation(c.box.nearest_shift(c.position[1]));
  const PairCorrelationByAngle pairs = pair_correlation_by_angle(c, {5, 0.2});
  const double ideal = shell_of(c, 2.2, 2.4) / c.box.volume() / axis_angle_bins<Dim>;
  std::vector<double> shares;
  for (const std::vector<double>& g : pairs.g) {
    shares.push_back(g[11] * ideal);
    for (std::size_t k = 0; k < g.size(); ++k) EXPECT_TRUE(k == 11 || g[k] == 0) << k;
  }
  return shares;
}

void expect_shares(const std::vector<double>& shares, double first, double last) {
  for (std::size_t angle = 0; angle < shares.size(); ++angle)
    EXPECT_NEAR(shares[angle], angle == 0 ? first : angle + 1 == shares.size() ? last : 0, 1e-12);
}

TEST(PairCorrelation, ByAngleOfTwoEllipses) {
  Configuration2 c;
  c.resize(2);
  c.shape.assign(2, of_aspect_ratio(2));
  expect_shares(shares<2>(c, Vec2::UnitX()), 1, 0);  // head to tail
  expect_shares(shares<2>(c, Vec2::UnitY()), 0, 1);  // side by side
  c.angle[1] = pi;                                   // the same, turned round
  expect_shares(shares<2>(c, Vec2::UnitX()), 1, 0);
  c.angle = {0.5, 0.5};
  expect_shares(shares<2>(c, {std::cos(0.5), std::sin(0.5)}), 1, 0);
  expect_shares(shares<2>(c, {-std::sin(0.5), std::cos(0.5)}), 0, 1);
  c.angle[0] = 0;
  c.angle[1] = -pi / 2;  // a T: one along, one across
  expect_shares(shares<2>(c, Vec2::UnitX()), 0.5, 0.5);
  c.shape[1] = {1, 1};  // only the ellipse counts
  expect_shares(shares<2>(c, Vec2::UnitX()), 1, 0);
  expect_shares(shares<2>(c, Vec2::UnitY()), 0, 1);
}

TEST(PairCorrelation, ByAngleOfTwoSpheroids) {
  Configuration3 c;
  c.resize(2);
  for (const double along : {2.0, 0.5}) {  // of an oblate one the short axis
    c.shape.assign(2, Ellipsoid{Vec3(1, 1, along)});
    c.orientation.assign(2, Quaternion::Identity());
    expect_shares(shares<3>(c, Vec3::UnitZ()), 1, 0);
    expect_shares(shares<3>(c, Vec3::UnitX()), 0, 1);
    c.orientation[1] = Quaternion(Eigen::AngleAxisd(pi / 2, Vec3::UnitX()));
    expect_shares(shares<3>(c, Vec3::UnitZ()), 0.5, 0.5);
    c.shape[1] = Ellipsoid{Vec3(1, 1, 1)};
    expect_shares(shares<3>(c, Vec3::UnitZ()), 1, 0);
  }
}

TEST(PairCorrelation, IsEmptyInABoxNarrowerThanTwoBins) {
  EXPECT_TRUE(pair_correlation(gas(5, {1, 8}, 1), {20, 0.6}).g.empty());
  EXPECT_TRUE(pair_correlation_by_angle(gas(5, {1, 8}, 1), {20, 0.6}).g.empty());
}

}  // namespace
}  // namespace vitrel

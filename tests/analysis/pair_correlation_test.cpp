#include "analysis/structure/pair_correlation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/chi_squared.h"
#include "tests/support/pairs.h"
#include "tests/support/particles_of.h"
#include "tests/support/random_gas.h"
#include "tests/support/scenes.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;

/// Three quarters of them ellipses, the others disks.
Configuration2 gas(std::size_t n, const Vec2& lengths, std::uint64_t seed) {
  Stream draw(seed, Purpose::tests);
  return random_gas(n, lengths, draw, [&](Configuration2& c, std::size_t i) {
    c.shape[i] = i % 4 == 0 ? Ellipse{1, 1} : of_aspect_ratio(2);
    c.angle[i] = draw.uniform(-pi, pi);
  });
}

/// Two thirds of them spheroids, the others spheres.
Configuration3 solid_gas(std::size_t n, const Vec3& lengths, std::uint64_t seed) {
  Stream draw(seed, Purpose::tests);
  return random_gas(n, lengths, draw, [&](Configuration3& c, std::size_t i) {
    if (i % 3 == 0) return;
    c.shape[i].semi_axes = Vec3(1, 1, 2);
    c.orientation[i] =
        Quaternion{draw.normal(), draw.normal(), draw.normal(), draw.normal()}.normalized();
  });
}

Vec2 axis_of(const Configuration2& c, std::size_t i) {
  return {std::cos(c.angle[i]), std::sin(c.angle[i])};
}
Vec3 axis_of(const Configuration3& c, std::size_t i) {
  return c.orientation[i] * Vec3::UnitZ();
}

/// cos n(θ_i − θ_j), in space P_n of the cosine between the axes.
double alignment(unsigned n, const Configuration2& c, std::size_t i, std::size_t j) {
  return std::cos(n * (c.angle[i] - c.angle[j]));
}
double alignment(unsigned n, const Configuration3& c, std::size_t i, std::size_t j) {
  return std::legendre(n, axis_of(c, i).dot(axis_of(c, j)));
}

/// All pairs i > j by nearest images: visit(i, j, separation from j to i, bin).
template <int Dim, class Visit>
void for_each_pair(const Configuration<Dim>& c, double step, std::size_t bins, Visit&& visit) {
  for (std::size_t i = 0; i < c.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vec<Dim> d = to_nearest_image<Dim>(c.box, c.position[i] - c.position[j]);
      const auto bin = static_cast<std::size_t>(d.norm() / step);
      if (bin < bins) visit(i, j, d, bin);
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

/// How many pairs there are of every two of the four species, in the order AA, AB … DD.
std::vector<double> numbers_of_pairs(const std::vector<std::int32_t>& species) {
  double members[4] = {};
  for (const std::int32_t kind : species) ++members[kind];
  std::vector<double> pairs;
  for (int a = 0; a < 4; ++a)
    for (int b = a; b < 4; ++b)
      pairs.push_back(a == b ? members[a] * (members[a] - 1) / 2 : members[a] * members[b]);
  return pairs;
}

/// Place of the pair A ≤ B in that order.
std::size_t place_of_pair(std::size_t a, std::size_t b) {
  return a * 4 - a * (a + 1) / 2 + b;
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

/// g · pairs · shell/volume is the count in every bin.
template <int Dim>
void expect_counts(const Configuration<Dim>& c, double step, const std::vector<double>& g,
                   double pairs, const std::vector<double>& counts) {
  ASSERT_LE(g.size(), counts.size());
  for (std::size_t k = 0; k < g.size(); ++k) {
    const double r = step * static_cast<double>(k);
    const double share = volume_between<Dim>(r, r + step) / c.box.volume();
    EXPECT_NEAR(g[k] * pairs * share, counts[k], 1e-9) << k;
  }
}

/// g, its moments, g of every two species, and g by the angle.
template <int Dim>
void expect_loop_over_all_pairs(const Configuration<Dim>& c, double range, double step) {
  const PairCorrelation pairs = pair_correlation(c, {range, step});
  const double reach = std::min(range, 0.5 * c.box.lengths().minCoeff());
  const auto bins = static_cast<std::size_t>(reach / step + 1e-9);
  ASSERT_EQ(pairs.g.size(), bins);
  const std::vector<double> zeros(bins);
  std::vector<double> all = zeros, rotor_pairs = zeros, g_2 = zeros, g_4 = zeros;
  std::vector<std::vector<double>> species(10, zeros), angles(axis_angle_bins<Dim>, zeros);
  for_each_pair(c, step, bins, [&](auto i, auto j, const Vec<Dim>& d, auto bin) {
    ++all[bin];
    const auto [a, b] = std::minmax(c.species[i], c.species[j]);
    ++species[place_of_pair(a, b)][bin];
    for (const std::size_t one : {i, j})
      if (!c.shape[one].is_round()) ++angles[angle_bin(axis_of(c, one), d)][bin];
    if (c.shape[i].is_round() || c.shape[j].is_round()) return;
    ++rotor_pairs[bin];
    g_2[bin] += alignment(2, c, i, j);
    g_4[bin] += alignment(4, c, i, j);
  });
  EXPECT_EQ(pairs.rotor_pairs, rotor_pairs);
  const auto n = static_cast<double>(c.size());
  for (std::size_t k = 0; k < bins; ++k) {
    const double r = step * static_cast<double>(k);
    const double ideal = n * (n - 1) / 2 * volume_between<Dim>(r, r + step) / c.box.volume();
    EXPECT_NEAR(pairs.g[k], all[k] / ideal, 1e-10);
    EXPECT_NEAR(pairs.distance[k], r + step / 2, 1e-12);
    if (rotor_pairs[k] == 0) continue;
    EXPECT_NEAR(pairs.g_2[k], g_2[k] / rotor_pairs[k], 1e-12);
    EXPECT_NEAR(pairs.g_4[k], g_4[k] / rotor_pairs[k], 1e-12);
  }
  const std::vector<double> numbers = numbers_of_pairs(c.species);
  ASSERT_EQ(pairs.partial.size(), 10u);
  EXPECT_TRUE(pairs.partial[9].empty()) << "of a single particle";
  for (std::size_t pair = 0; pair < 9; ++pair) {
    ASSERT_EQ(pairs.partial[pair].size(), bins);
    expect_counts(c, step, pairs.partial[pair], numbers[pair], species[pair]);
  }
  const PairCorrelationByAngle by_angle = pair_correlation_by_angle(c, {range, step});
  const auto rotors = static_cast<double>(rotor_count(c));
  const double pairs_per_angle = rotors * (n - 1) / axis_angle_bins<Dim>;
  ASSERT_EQ(by_angle.g.size(), angles.size());
  for (std::size_t angle = 0; angle < angles.size(); ++angle)
    expect_counts(c, step, by_angle.g[angle], pairs_per_angle, angles[angle]);
}

TEST(PairCorrelation, IsThatOfALoopOverAllPairs) {
  for (const std::uint64_t seed : {2, 3}) {
    for (const Vec2& lengths : {Vec2(30, 30), Vec2(50, 17), Vec2(9, 70)})
      for (const double range : {3.1, 40.0})
        expect_loop_over_all_pairs(mixed(gas(121, lengths, seed)), range, 0.5);
    for (const Vec3& lengths :
         {Vec3(12, 12, 12), Vec3(7, 30, 9), Vec3(20, 5, 40), Vec3(24, 25, 40)})
      for (const double range : {1.1, 30.0})
        expect_loop_over_all_pairs(mixed(solid_gas(151, lengths, seed)), range, 0.25);
  }
}

// ⟨g⟩ = 1 in every bin, ⟨g_n⟩ = 0; 300 gases, five standard deviations. In space the first bin of
// 0.4 has 2 pairs on the average, too few for χ².
TEST(PairCorrelation, OfAnIdealGasIsOne) {
  BinnedValues g, g_2, g_4, g_in_space;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const PairCorrelation one = pair_correlation(gas(100, {24, 20}, seed), {10, 0.5});
    g.add(one.g);
    g_2.add(one.g_2);
    g_4.add(one.g_4);
    g_in_space.add(pair_correlation(solid_gas(150, {10, 12, 11}, seed), {5, 0.4}).g);
  }
  ASSERT_EQ(g.size(), 20u);
  g.chi_squared(1).expect_one(5);
  g_2.chi_squared(0).expect_one(5);
  g_4.chi_squared(0).expect_one(5);
  ASSERT_EQ(g_in_space.size(), 12u);
  g_in_space.chi_squared(1, 1).expect_one(5);
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
    const double inner = static_cast<double>(bin) * step;
    EXPECT_NEAR(pairs.g[bin] * density * volume_between<2>(inner, inner + step), neighbours, 1e-10);
    EXPECT_NEAR(pairs.g_2[bin], sign > 0 ? 1 : 0, 1e-12);
    EXPECT_NEAR(pairs.g_4[bin], sign, 1e-12);
  }
  EXPECT_EQ(pairs.g[2], 0);
  EXPECT_TRUE(std::isnan(pairs.g_2[2]));
}

// 12 neighbours at d, 6 at √2 d, 24 at √3 d, 12 at 2 d …, nothing between.
TEST(PairCorrelation, OfAFaceCentredCubicLattice) {
  const Configuration3 c = cubic_lattice(5, face_centred_cubic, 0.5, {});
  const double d = c.box.lengths().x() / 5 / std::sqrt(2.0), step = 0.11 * d;
  const PairCorrelation pairs = pair_correlation(c, {3 * d, step});
  std::vector<double> neighbours(pairs.g.size());
  const int shells[] = {12, 6, 24, 12, 24, 8, 48, 6};  // at the roots of 1, 2 … 8
  for (int k = 0; k < 8; ++k)
    neighbours[static_cast<std::size_t>(std::sqrt(k + 1.0) * d / step)] += shells[k];
  expect_counts(c, step, pairs.g, static_cast<double>(c.size() - 1), neighbours);
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
  const std::vector<double> numbers = numbers_of_pairs(c.species);
  for (std::size_t k = 0; k < pairs.g.size(); ++k) {
    double sum = 0;
    for (std::size_t pair = 0; pair < 10; ++pair)
      if (!pairs.partial[pair].empty()) sum += pairs.partial[pair][k] * numbers[pair];
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

// Six particles of A: with N_A²/2 pairs instead of N_A (N_A − 1)/2, g_AA would be 5/6, which is 1.5 to 3
// standard errors in every bin. Bins from r = 2 on, with some 90 pairs of A or more in the 400 gases.
TEST(PairCorrelation, OfSpeciesOfAnIdealGasIsOne) {
  BinnedValues g[3];
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    Configuration2 c = gas(36, {24, 20}, seed);
    c.species_names = {"A", "B"};
    for (std::size_t i = 6; i < 36; ++i) c.species[i] = 1;
    const PairCorrelation pairs = pair_correlation(c, {10, 0.5});
    ASSERT_EQ(pairs.partial.size(), 3u);
    for (std::size_t pair = 0; pair < 3; ++pair) g[pair].add(pairs.partial[pair]);
  }
  for (const BinnedValues& of_pair : g) {
    EXPECT_EQ(of_pair.size(), 20u);
    of_pair.chi_squared(1, 4).expect_one(5);
  }
}

/// From r = 1 on, every bin of both has 2000 neighbours or more in the 300 gases.
template <class Gas>
void expect_no_angles(Gas&& gas_of) {
  std::vector<BinnedValues> g;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const PairCorrelationByAngle one = pair_correlation_by_angle(gas_of(seed), {10, 0.5});
    g.resize(one.g.size());
    for (std::size_t angle = 0; angle < g.size(); ++angle) g[angle].add(one.g[angle]);
  }
  ChiSquared all;
  for (const BinnedValues& of_angle : g) {
    const ChiSquared one = of_angle.chi_squared(1, 2);
    one.expect_one(5);
    all.sum += one.sum;
    all.values += one.values;
  }
  all.expect_one(5);
}

TEST(PairCorrelation, ByAngleOfAnIdealGasIsOne) {
  expect_no_angles([](std::uint64_t seed) { return gas(100, {24, 20}, seed); });
  expect_no_angles([](std::uint64_t seed) { return solid_gas(150, {10, 12, 11}, seed); });
}

/// Neighbours of every site at a distance, all of its own species or all of the other, and how many of them
/// are in a bin of the angle.
struct Neighbours {
  double squared_distance;
  bool is_like;
  double count;
  std::vector<std::pair<std::size_t, double>> angles;
};

/// Two species at the sites of a lattice like the colours of a chessboard. Bins are narrower than
/// the distances differ.
template <int Dim>
void expect_crystal(Configuration<Dim> c, int cells, const std::vector<Neighbours>& shells) {
  const double spacing = c.box.lengths().x() / cells;
  const double step = 0.11 * spacing, n = static_cast<double>(c.size());
  c.species_names = {"A", "B"};
  for (std::size_t i = 0; i < c.size(); ++i) {
    const Vec<Dim> site = (c.position[i] / spacing).array().floor();
    c.species[i] = static_cast<long>(site.sum()) % 2 != 0;
  }
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
  expect_counts(c, step, pairs.partial[0], n / 2 - 1, like);
  expect_counts(c, step, pairs.partial[1], n / 2, unlike);
  expect_counts(c, step, pairs.partial[2], n / 2 - 1, like);
  for (std::size_t angle = 0; angle < angles.size(); ++angle)
    expect_counts(c, step, by_angle.g[angle], (n - 1) / axis_angle_bins<Dim>, angles[angle]);
}

// Axes along x. The four at 45° are in the fifth of the bins of 10°; the eight at √5 at 26.6° and
// 63.4°.
TEST(PairCorrelation, OfTwoSquareLattices) {
  expect_crystal(square_lattice(12, 0.7, 0, [](std::size_t) { return of_aspect_ratio(1.2); }), 12,
                 {{1, false, 4, {{0, 2}, {8, 2}}},
                  {2, true, 4, {{4, 4}}},
                  {4, true, 4, {{0, 2}, {8, 2}}},
                  {5, false, 8, {{2, 4}, {6, 4}}}});
}

// Rock salt, axes along z; bins of cos θ from 1 downwards, 0.1 each: 1/√2 is in the third, 1/√3 in the fifth;
// (1, 2, 0) and its like have 2/√5 = 0.89, 1/√5 = 0.45 and 0.
TEST(PairCorrelation, OfRockSalt) {
  expect_crystal(cubic_lattice(6, simple_cubic, 0.5, {Vec3(1, 1, 1.3)}), 6,
                 {{1, false, 6, {{0, 2}, {9, 4}}},
                  {2, true, 12, {{2, 8}, {9, 4}}},
                  {3, false, 8, {{4, 8}}},
                  {4, true, 6, {{0, 2}, {9, 4}}},
                  {5, false, 24, {{1, 8}, {5, 8}, {9, 8}}}});
}

/// Two particles at a distance of 2.3 in a direction, each across an edge of the box: what the
/// first and the last bin of the angle have in the bin from 2.2 to 2.4, as shares of what all have;
/// elsewhere there is nothing.
template <int Dim>
void expect_shares(Configuration<Dim> c, const Vec<Dim>& direction, double first, double last) {
  c.box = PeriodicBox<Dim>(Vec<Dim>::Constant(12));
  c.position[0] = 5.9 * direction;
  c.position[1] = to_nearest_image<Dim>(c.box, (5.9 + 2.3) * direction);
  const PairCorrelationByAngle pairs = pair_correlation_by_angle(c, {5, 0.2});
  const double ideal = volume_between<Dim>(2.2, 2.4) / c.box.volume() / axis_angle_bins<Dim>;
  for (std::size_t angle = 0; angle < pairs.g.size(); ++angle) {
    const std::vector<double>& g = pairs.g[angle];
    const double share = angle == 0 ? first : angle + 1 == pairs.g.size() ? last : 0;
    EXPECT_NEAR(g[11] * ideal, share, 1e-12);
    for (std::size_t k = 0; k < g.size(); ++k) EXPECT_TRUE(k == 11 || g[k] == 0) << k;
  }
}

TEST(PairCorrelation, ByAngleOfTwoEllipses) {
  auto c = particles_of<2>({of_aspect_ratio(2), of_aspect_ratio(2)});
  expect_shares<2>(c, Vec2::UnitX(), 1, 0);  // head to tail
  expect_shares<2>(c, Vec2::UnitY(), 0, 1);  // side by side
  c.angle[1] = pi;                           // the same, turned round
  expect_shares<2>(c, Vec2::UnitX(), 1, 0);
  c.angle = {0.5, 0.5};
  expect_shares<2>(c, {std::cos(0.5), std::sin(0.5)}, 1, 0);
  expect_shares<2>(c, {-std::sin(0.5), std::cos(0.5)}, 0, 1);
  c.angle[0] = 0;
  c.angle[1] = -pi / 2;  // a T: one along, one across
  expect_shares<2>(c, Vec2::UnitX(), 0.5, 0.5);
  c.shape[1] = {1, 1};  // only the ellipse counts
  expect_shares<2>(c, Vec2::UnitX(), 1, 0);
  expect_shares<2>(c, Vec2::UnitY(), 0, 1);
}

TEST(PairCorrelation, ByAngleOfTwoSpheroids) {
  for (const double along : {2.0, 0.5}) {  // of an oblate one the short axis
    auto c = particles_of<3>(std::vector<Ellipsoid>(2, {Vec3(1, 1, along)}));
    expect_shares<3>(c, Vec3::UnitZ(), 1, 0);
    expect_shares<3>(c, Vec3::UnitX(), 0, 1);
    c.orientation[1] = Quaternion(Eigen::AngleAxisd(pi / 2, Vec3::UnitX()));
    expect_shares<3>(c, Vec3::UnitZ(), 0.5, 0.5);
    c.shape[1] = Ellipsoid{Vec3(1, 1, 1)};
    expect_shares<3>(c, Vec3::UnitZ(), 1, 0);
  }
}

TEST(PairCorrelation, IsEmptyInABoxNarrowerThanTwoBins) {
  EXPECT_TRUE(pair_correlation(gas(5, {1, 8}, 1), {20, 0.6}).g.empty());
  EXPECT_TRUE(pair_correlation_by_angle(gas(5, {1, 8}, 1), {20, 0.6}).g.empty());
}

}  // namespace
}  // namespace vitrel

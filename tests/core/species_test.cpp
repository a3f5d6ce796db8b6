#include "core/state/species.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/random/stream.h"
#include "core/state/configuration.h"

namespace vitrel {
namespace {

using Kind = Distribution::Kind;

Distribution number(double value) {
  return {Kind::constant, value, 0, 0, 0, 0};
}
Distribution uniform(double low, double high, double min) {
  return {Kind::uniform, 0, 0, low, high, min};
}

std::vector<Species> species_of(const std::vector<double>& fractions) {
  std::vector<Species> species(fractions.size());
  for (std::size_t k = 0; k < fractions.size(); ++k) species[k].fraction = fractions[k];
  return species;
}

/// Draws the particles in a square or cube.
template <int Dim>
Configuration<Dim> drawn(const std::vector<Species>& species, std::size_t particles,
                         std::uint64_t seed = 7) {
  return draw_particles<Dim>(species, particles, 0.3, Vec<Dim>::Ones(), seed);
}

TEST(SpeciesCounts, LargestRemaindersGetTheParticlesLeftOver) {
  const std::vector<Species> equal = species_of({1.0 / 3, 1.0 / 3, 1.0 / 3});
  EXPECT_EQ(species_counts(equal, 100), (std::vector<std::size_t>{34, 33, 33}));
  EXPECT_EQ(species_counts(equal, 99), (std::vector<std::size_t>{33, 33, 33}));
  // The shares are 0.7 → 1, 5.8 → 6 and 3.5 → 3.
  EXPECT_EQ(species_counts(species_of({0.07, 0.58, 0.35}), 10),
            (std::vector<std::size_t>{1, 6, 3}));
}

TEST(DrawParticles, TheBoxHasThePackingFractionAndTheAspect) {
  std::vector<Species> species = species_of({0.5, 0.5});
  species[0].aspect_ratio = number(3);
  species[1].size = number(1.4);
  const Configuration2 system = draw_particles<2>(species, 101, 0.6, Vec2(1, 2.5), 7);
  EXPECT_NEAR(packing_fraction(system), 0.6, 1e-14);
  EXPECT_NEAR(system.box.lengths().y() / system.box.lengths().x(), 2.5, 1e-14);
  for (std::size_t i = 0; i < system.size(); ++i) {
    const Ellipse& shape = system.shape[i];
    const bool first = system.species[i] == 0;
    EXPECT_NEAR(shape.aspect_ratio(), first ? 3 : 1, 1e-14);
    EXPECT_NEAR(shape.a * shape.b, first ? 1 : 1.96, 1e-14);
    EXPECT_EQ(system.mass[i], shape.a * shape.b);
  }
  EXPECT_TRUE(system.shape[0].is_round() || system.species[0] == 0);
}

TEST(DrawParticles, SpeciesAreMixedAndTheSeedDecides) {
  std::vector<Species> species = species_of({0.5, 0.5});
  const auto order = [&](std::uint64_t seed) {
    return draw_particles<2>(species, 1000, 0.5, Vec2::Ones(), seed).species;
  };
  EXPECT_EQ(order(3), order(3));
  EXPECT_NE(order(3), order(4));
  // Unlike neighbours in the order: mean N/2, variance about N/4; 5 standard deviations, a false
  // alarm in 6e-7 of the seeds, and the seed is fixed.
  const std::vector<std::int32_t> mixed = order(3);
  int changes = 0;
  for (std::size_t i = 1; i < mixed.size(); ++i) changes += mixed[i] != mixed[i - 1];
  EXPECT_NEAR(changes, 500, 5 * std::sqrt(250));
}

TEST(DrawParticles, SemiAxesAndMassAreTakenAsGiven) {
  std::vector<Species> species(1);
  species[0].semi_axes = {number(3.3), number(0.7)};
  species[0].mass = 5;
  const Configuration2 system = drawn<2>(species, 4, 1);
  EXPECT_EQ(system.shape[2].a, 3.3);
  EXPECT_EQ(system.shape[2].b, 0.7);
  EXPECT_EQ(system.mass[2], 5);
}

TEST(DrawParticles, TheLargerOfTwoDrawnSemiAxesIsTheMajorOne) {
  std::vector<Species> species(1);
  species[0].semi_axes = {uniform(1, 2, 0.1), uniform(1, 2, 0.1)};
  constexpr std::size_t n = 1000;
  double major = 0, minor = 0;
  for (const Ellipse& shape : drawn<2>(species, n).shape) {
    EXPECT_GE(shape.a, shape.b);
    major += shape.a;
    minor += shape.b;
  }
  // Order statistics of two uniform numbers: means 1/3 and 2/3 of the interval, variance 1/18; 4.9 standard errors, a
  // false alarm in 1e-6 of the seeds each.
  EXPECT_NEAR(major / n, 5.0 / 3, 4.9 / std::sqrt(18.0 * n));
  EXPECT_NEAR(minor / n, 4.0 / 3, 4.9 / std::sqrt(18.0 * n));
}

TEST(DrawParticles, TheFirstSemiAxisReplacesTheSize) {
  std::vector<Species> species(1);
  species[0].first_semi_axis = number(3);
  species[0].aspect_ratio = uniform(1, 5, 1);
  for (const Ellipse& shape : drawn<2>(species, 20).shape) {
    EXPECT_EQ(shape.a, 3);
    EXPECT_GE(shape.b, 0.6);
  }
}

TEST(DrawSolids, TheCubeHasThePackingFractionAndTheShapesTheRatios) {
  std::vector<Species> species = species_of({0.25, 0.25, 0.5});
  species[0].aspect_ratio = number(3);
  species[1].aspect_ratios = {number(4), number(0.5)};
  species[1].size = number(1.4);
  species[2].semi_axes = {number(1.5), number(3), number(0.7)};
  const Configuration3 system = draw_particles<3>(species, 101, 1e-6, Vec3(1, 2, 0.5), 7);
  EXPECT_NEAR(packing_fraction(system), 1e-6, 1e-20);
  const Vec3& box = system.box.lengths();
  EXPECT_EQ(box.y(), 2 * box.x());
  EXPECT_EQ(box.z(), 0.5 * box.x());
  const double sizes[] = {1, 1.4, std::cbrt(1.5 * 3 * 0.7)};
  for (std::size_t i = 0; i < system.size(); ++i) {
    const int kind = system.species[i];
    const Vec3& axes = system.shape[i].semi_axes;
    if (kind == 2) {
      EXPECT_EQ(axes, Vec3(1.5, 3, 0.7));
      continue;
    }
    EXPECT_NEAR(axes[0] / axes[1], kind == 0 ? 3 : 4, 1e-14);
    EXPECT_NEAR(axes[0] / axes[2], kind == 0 ? 3 : 0.5, 1e-14);
    EXPECT_NEAR(std::cbrt(axes.prod()), sizes[kind], 1e-14);
    EXPECT_EQ(system.mass[i], axes.prod());
    EXPECT_EQ(system.shape[i].rotations(), kind == 0 ? 2 : 3);
  }
}

TEST(DrawSolids, BothAspectRatiosAreDrawn) {
  std::vector<Species> species(1);
  species[0].aspect_ratios = {uniform(1, 5, 1), uniform(0.1, 2, 0.1)};
  const Configuration3 system = drawn<3>(species, 1000);
  double sum1 = 0, sum2 = 0;
  for (const Ellipsoid& shape : system.shape) {
    sum1 += shape.semi_axes[0] / shape.semi_axes[1];
    sum2 += shape.semi_axes[0] / shape.semi_axes[2];
  }
  // 4.9 standard errors (b − a)/√(12 N), a false alarm in 1e-6 of the seeds each.
  EXPECT_NEAR(sum1 / 1000, 3, 4.9 * 4 / std::sqrt(12'000));
  EXPECT_NEAR(sum2 / 1000, 1.05, 4.9 * 1.9 / std::sqrt(12'000));
}

// The ratios are those drawn without a first semi-axis.
TEST(DrawSolids, TheFirstSemiAxisIsTheSameAtAllRatios) {
  std::vector<Species> species(1);
  species[0].aspect_ratios = {uniform(0.1, 2, 0.1), uniform(0.1, 2, 0.1)};
  const Configuration3 sized = drawn<3>(species, 50);
  species[0].first_semi_axis = number(3);
  const Configuration3 system = drawn<3>(species, 50);
  for (std::size_t i = 0; i < system.size(); ++i) {
    const Vec3 &axes = system.shape[i].semi_axes, &other = sized.shape[i].semi_axes;
    EXPECT_EQ(axes[0], 3);
    EXPECT_TRUE((axes / axes[0]).isApprox(other / other[0], 1e-14));
  }
}

TEST(DrawSolids, SemiAxesAreDrawnOneByOne) {
  std::vector<Species> species(1);
  species[0].semi_axes = {uniform(1, 2, 1), number(0.5), uniform(3, 4, 1)};
  double sum = 0;
  for (const Ellipsoid& shape : drawn<3>(species, 1000).shape) {
    const Vec3& axes = shape.semi_axes;
    EXPECT_TRUE(axes[0] >= 1 && axes[0] <= 2 && axes[1] == 0.5 && axes[2] >= 3 && axes[2] <= 4);
    sum += axes[0] + axes[2];
  }
  // 4.9 standard errors of a sum of two uniform numbers, a false alarm in 1e-6 of the seeds.
  EXPECT_NEAR(sum / 1000, 5, 4.9 / std::sqrt(6'000));
}

// Mean and standard deviation of n draws against those asked for, within 4.9 standard errors
// (two-sided false-alarm rate 1e-6 each): σ/√n for the mean, and for the standard deviation σ √((k
// − 1)/(4n)) with the kurtosis k = 3 of a Gaussian, 1.8 of a uniform, and that of this
// lognormal, 3.7 at σ/⟨x⟩ = 0.2.
void expect_moments(const Distribution& distribution, double mean, double deviation,
                    double kurtosis) {
  constexpr std::size_t n = 200'000;
  double sum = 0, squares = 0;
  Stream stream(5, Purpose::tests);
  for (std::size_t k = 0; k < n; ++k) {
    const double x = distribution.draw(stream) - mean;
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / n, 0, 4.9 * deviation / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), deviation,
              4.9 * deviation * std::sqrt((kurtosis - 1) / (4.0 * n)));
}

TEST(Distribution, HasTheMomentsAskedFor) {
  expect_moments({Kind::gaussian, 2, 0.4, 0, 0, -1e9}, 2, 0.4, 3);
  expect_moments({Kind::lognormal, 2, 0.4, 0, 0, 0}, 2, 0.4, 3.7);
  expect_moments({Kind::uniform, 1, 0, 1, 4, 0}, 2.5, 3 / std::sqrt(12.0), 1.8);
}

// ⟨x^k⟩ of a density ∝ x^n between 1 and 2 is the ratio of two integrals of powers.
TEST(Distribution, PowerLawHasItsMoments) {
  for (const double n : {-3., -1., 0., 2.5}) {
    const auto integral = [](double power) {
      return power == -1 ? std::log(2.0) : (std::pow(2.0, power + 1) - 1) / (power + 1);
    };
    const auto moment = [&](int k) { return integral(n + k) / integral(n); };
    const double mean = moment(1), variance = moment(2) - mean * mean;
    const double fourth = moment(4) - 4 * mean * moment(3) + 6 * mean * mean * moment(2) -
                          3 * mean * mean * mean * mean;
    expect_moments({.kind = Kind::power_law, .low = 1, .high = 2, .exponent = n}, mean,
                   std::sqrt(variance), fourth / (variance * variance));
  }
}

double share_of_normal(double z) {
  return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

// Against the distribution functions.
TEST(Distribution, QuantilesDivideItIntoEqualShares) {
  constexpr std::size_t n = 100;
  const auto expect_shares = [](const Distribution& d, auto&& share) {
    const std::vector<double> values = d.quantiles(n);
    for (std::size_t k = 0; k < n; ++k)
      EXPECT_NEAR(share(values[k]), (static_cast<double>(k) + 0.5) / n, 1e-14);
  };
  expect_shares(uniform(1, 3, 0.1), [](double x) { return (x - 1) / 2; });
  expect_shares(uniform(1, 3, 2), [](double x) { return x - 2; });
  for (const double m : {-2., 1.5}) {
    const Distribution law{.kind = Kind::power_law, .low = 0.1, .high = 10, .exponent = m - 1};
    const double low = std::pow(0.1, m), high = std::pow(10, m);
    expect_shares(law, [&](double x) { return (std::pow(x, m) - low) / (high - low); });
  }
  // Half a Gaussian, which is not moved.
  expect_shares({Kind::gaussian, 1, 0.5, 0, 0, 1},
                [](double x) { return 2 * share_of_normal((x - 1) / 0.5) - 1; });
}

TEST(Distribution, QuantilesHaveTheMomentsAskedFor) {
  for (const Kind kind : {Kind::gaussian, Kind::lognormal})
    for (const std::size_t n : {2U, 10U, 1001U}) {
      const std::vector<double> values = Distribution{kind, 2, 0.4, 0, 0, 0.1}.quantiles(n);
      double sum = 0, squares = 0;
      for (const double x : values) sum += x, squares += (x - 2) * (x - 2);
      const auto count = static_cast<double>(n);
      EXPECT_NEAR(sum / count, 2, 1e-14);
      EXPECT_NEAR(std::sqrt(squares / count), 0.4, 1e-14);
      EXPECT_TRUE(std::ranges::is_sorted(values));
    }
  EXPECT_EQ((Distribution{Kind::lognormal, 2, 0.4, 0, 0, 0.1}.quantiles(1)), std::vector{2.0});
  // So broad that the smallest of three would be negative.
  EXPECT_GT((Distribution{Kind::lognormal, 1, 5, 0, 0, 1e-3}.quantiles(3)[0]), 0);
  EXPECT_THROW(uniform(0, 1, 2).quantiles(5), UserError);
}

std::vector<Species> two_laws() {
  std::vector<Species> species = species_of({0.7, 0.3});
  species[0].aspect_ratio = Distribution{Kind::gaussian, 3, 0.3, 0, 0, 1};
  species[0].size = Distribution{Kind::power_law, 0, 0, 0.5, 2, 0.1};
  species[1].aspect_ratio = number(2);
  return species;
}

/// Size and aspect ratio of all particles of the first species, sorted.
std::vector<std::pair<double, double>> shapes_of_first(const Configuration2& c) {
  std::vector<std::pair<double, double>> found;
  for (std::size_t i = 0; i < c.size(); ++i)
    if (c.species[i] == 0)
      found.emplace_back(std::sqrt(c.shape[i].a * c.shape[i].b), c.shape[i].a / c.shape[i].b);
  std::ranges::sort(found);
  return found;
}

Configuration2 two_laws(std::uint64_t seed, ShapeDraw draw) {
  return draw_particles<2>(two_laws(), 1000, 0.3, Vec2::Ones(), seed, draw);
}

TEST(DrawParticles, AllSeedsAreOneLiquid) {
  const Configuration2 one = two_laws(1, ShapeDraw::quantiles),
                       two = two_laws(2, ShapeDraw::quantiles);
  EXPECT_EQ(shapes_of_first(one), shapes_of_first(two));
  EXPECT_NE(one.shape[0].a, two.shape[0].a);
  // The sums of the areas differ in the order of the particles.
  EXPECT_NEAR(one.box.lengths()[0], two.box.lengths()[0], 1e-12 * one.box.lengths()[0]);
  EXPECT_NE(shapes_of_first(two_laws(1, ShapeDraw::random)),
            shapes_of_first(two_laws(2, ShapeDraw::random)));
}

// 700 values that are paired at random have a correlation of about 1/√700 = 0.04.
TEST(DrawParticles, SeveralDistributionsAreNotCorrelated) {
  const auto shapes = shapes_of_first(two_laws(1, ShapeDraw::quantiles));
  const auto n = static_cast<double>(shapes.size());
  double size = 0, ratio = 0, sizes = 0, ratios = 0, both = 0;
  for (const auto& [x, y] : shapes) size += x / n, ratio += y / n;
  for (const auto& [x, y] : shapes) {
    sizes += (x - size) * (x - size);
    ratios += (y - ratio) * (y - ratio);
    both += (x - size) * (y - ratio);
  }
  EXPECT_LT(std::abs(both) / std::sqrt(sizes * ratios), 0.015);
}

TEST(Distribution, DrawsBelowTheMinimumAreDrawnAgain) {
  Stream stream(5, Purpose::tests);
  const Distribution half{Kind::gaussian, 1, 0.5, 0, 0, 1};
  for (int k = 0; k < 1000; ++k) EXPECT_GE(half.draw(stream), 1);
  EXPECT_THROW(uniform(0, 1, 2).draw(stream), UserError);
}

}  // namespace
}  // namespace vitrel

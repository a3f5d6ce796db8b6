#include "analysis/structure/order.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/special_values.h"
#include "tests/support/chi_squared.h"
#include "tests/support/particles_of.h"
#include "tests/support/random_gas.h"
#include "tests/support/scenes.h"
#include "tests/support/triangular_lattice.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;

/// n ellipses at random places and angles; they may overlap.
Configuration2 gas(std::size_t n, std::uint64_t seed) {
  const double length = std::sqrt(10.0 * static_cast<double>(n));
  Stream draw(seed, Purpose::tests);
  return random_gas<2>(n, {length, 1.2 * length}, draw, [&](Configuration2& c, std::size_t i) {
    c.shape[i] = of_aspect_ratio(2);
    c.angle[i] = draw.uniform(-3 * pi, 3 * pi);
  });
}

Configuration2 square_lattice_of_disks(int side) {
  return square_lattice(side, 0.5, 0, [](std::size_t) { return Ellipse{1, 1}; });
}

TEST(NematicOrder, IsZeroForCrossedPairsAndForDisks) {
  EXPECT_EQ(nematic_order(particles_of<2>({{1, 1}, {1, 1}})), 0);
  auto state = particles_of<2>({{2, 1}, {2, 1}});
  state.angle = {0.3, 0.3 + pi / 2};
  EXPECT_NEAR(nematic_order(state), 0, 1e-15);
  state.angle = {0.3, 0.3 + pi};
  EXPECT_NEAR(nematic_order(state), 1, 1e-15);
}

TEST(NematicOrder, LeavesRoundParticlesOut) {
  auto state = particles_of<2>({{2, 1}, {1, 1}, {2, 1}});
  state.angle = {0.4, 0.4 + pi / 2, 0.4};
  EXPECT_NEAR(nematic_order(state), 1, 1e-15);
}

// ⟨S²⟩ = 1/R for independent angles, with the standard deviation 1/R of an exponential
// distribution. √(π/(4R)) is the mean of the same walk's length, with the standard deviation √((1 −
// π/4)/R); for R = 50 the formula itself is off by 0.1 %. 400 systems, five standard errors.
TEST(NematicOrder, OfARandomGasIsThatOfARandomWalk) {
  double sum = 0, squares = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const double order = nematic_order(gas(50, seed));
    sum += order;
    squares += order * order;
  }
  EXPECT_NEAR(50 * squares / 400, 1, 5.0 / 20);
  EXPECT_NEAR(sum / 400, nematic_order_by_chance(50, 2), 5 * std::sqrt((1 - pi / 4) / 50 / 400));
}

// Q from its definition, ⟨2 u uᵀ − 1⟩, and the director as its eigenvector to + S.
TEST(OrderTensor, IsTheMeanOfTheMajorAxes) {
  for (const double mean : {-1.2, 0.0, 0.4, 1.5}) {
    Configuration2 c = gas(40, 3);
    Mat2 sum = Mat2::Zero();
    for (double& angle : c.angle) {
      angle = mean + 0.2 * angle;
      const Vec2 u(std::cos(angle), std::sin(angle));
      sum += 2 * u * u.transpose() - Mat2::Identity();
    }
    const OrderTensor tensor = order_tensor(c);
    EXPECT_TRUE(tensor.matrix().isApprox(sum / 40, 1e-13));
    const Vec2 director(std::cos(tensor.director()), std::sin(tensor.director()));
    EXPECT_TRUE((tensor.matrix() * director).isApprox(tensor.order() * director, 1e-13));
    EXPECT_GT(tensor.order(), 0.1);
    EXPECT_EQ(tensor.order(), nematic_order(c));
  }
}

// Evenly spread angles: the bins differ by one angle at most.
TEST(OrientationDistribution, OfEvenlySpreadAnglesIsFlat) {
  Configuration2 c = gas(1000, 1);
  for (std::size_t i = 0; i < c.size(); ++i) c.angle[i] = 0.1 + pi * static_cast<double>(i) / 1000;
  for (const double density : orientation_distribution(c, 20))
    EXPECT_NEAR(density, 1 / pi, 1.001 / (1000 * pi / 20));
}

TEST(OrientationDistribution, OfParallelParticlesIsOnePeakInTheMiddle) {
  Configuration2 c = gas(50, 1);
  for (std::size_t i = 0; i < c.size(); ++i) c.angle[i] = 1.3 + pi * static_cast<double>(i % 7);
  const std::vector<double> density = orientation_distribution(c, 9);
  for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(density[k], k == 4 ? 9 / pi : 0, 1e-12);
}

// ⟨cos 2α⟩ = S and ⟨sin 2α⟩ = 0 hold in every state, whichever way the director points; a bin's width
// is off by at most |d cos 2α/dα| width/2.
TEST(OrientationDistribution, HasTheMomentsOfTheOrder) {
  for (const double turn : {0.0, 0.9, -2.0}) {
    Configuration2 c = gas(30, 8);
    c.shape[3] = {1, 1};
    for (double& angle : c.angle) angle += turn;
    const std::size_t bins = 400;
    const double width = pi / static_cast<double>(bins);
    const std::vector<double> density = orientation_distribution(c, bins);
    double sum = 0, cosine = 0, sine = 0;
    for (std::size_t k = 0; k < bins; ++k) {
      const double angle = (static_cast<double>(k) + 0.5) * width - pi / 2;
      sum += density[k] * width;
      cosine += density[k] * width * std::cos(2 * angle);
      sine += density[k] * width * std::sin(2 * angle);
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_NEAR(cosine, nematic_order(c), width);
    EXPECT_NEAR(sine, 0, width);
  }
}

TEST(OrientationDistribution, OfDisksIsEmpty) {
  EXPECT_TRUE(orientation_distribution(particles_of<2>(std::vector<Ellipse>(3)), 10).empty());
}

TEST(NematicCorrelation, IsOneWhereAllAreParallel) {
  Configuration2 c = gas(200, 1);
  for (std::size_t i = 0; i < c.size(); ++i) c.angle[i] = 0.7 + pi * static_cast<double>(i);
  const NematicCorrelation g = nematic_correlation(c, 1);
  EXPECT_EQ(g.distance.size(), 22u);  // half of √2000 = 44.7, by 1
  for (std::size_t k = 0; k < g.value.size(); ++k) {
    if (g.pairs[k] == 0) continue;
    EXPECT_NEAR(g.value[k], 1, 1e-10);
  }
  EXPECT_EQ(correlation_length(g), std::numeric_limits<double>::infinity());
}

// Crosswise neighbours on the square lattice: −1 at distances √(m² + n²) with m + n odd, else 1.
TEST(NematicCorrelation, OfACheckerboard) {
  const int side = 12;
  Configuration2 c = square_lattice(side, 0.4, 0, [](std::size_t) { return Ellipse{1.2, 0.8}; });
  for (std::size_t i = 0; i < c.size(); ++i)
    c.angle[i] = (i % side + i / side) % 2 ? 0.3 : 0.3 + pi / 2;
  const double spacing = c.box.lengths().x() / side;
  const NematicCorrelation g = nematic_correlation(c, 0.11 * spacing);
  const auto at = [&](double r) {
    return static_cast<std::size_t>(r * spacing / (2 * g.distance.front()));
  };
  const std::size_t n = c.size();
  for (const auto& [r, sign, neighbours] : {std::tuple{1.0, -1, 4},
                                            {std::sqrt(2.0), 1, 4},
                                            {2.0, 1, 4},
                                            {std::sqrt(5.0), -1, 8},
                                            {3.0, -1, 4}}) {
    EXPECT_NEAR(g.value[at(r)], sign, 1e-12) << r;
    EXPECT_EQ(g.pairs[at(r)], n * static_cast<std::size_t>(neighbours) / 2) << r;
  }
  EXPECT_EQ(g.pairs[at(0.5)], 0u);
  EXPECT_TRUE(std::isnan(g.value[at(0.5)]));
}

// Each bin scatters by 1/√(2 pairs), so χ² per bin is 1, with standard deviation √(2/bins) — the
// pairs of a bin are uncorrelated, though not independent. Five standard deviations.
TEST(NematicCorrelation, OfARandomGasIsZeroWithinItsScatter) {
  ChiSquared bins;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const NematicCorrelation g = nematic_correlation(gas(300, seed), 2);
    for (std::size_t k = 0; k < g.value.size(); ++k) {
      if (g.pairs[k] < 20) continue;
      bins.add(g.value[k], 1 / std::sqrt(2.0 * static_cast<double>(g.pairs[k])));
    }
  }
  EXPECT_GT(bins.values, 250);
  bins.expect_one(5);
}

// All pairs nearer than half the box, which the mean number of neighbours knows.
TEST(NematicCorrelation, CountsEveryPairOnce) {
  const Configuration2 c = gas(300, 4);
  const double range = 0.5 * c.box.lengths().minCoeff();
  std::size_t expected = 0, counted = 0;
  for (std::size_t i = 0; i < c.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      c.box.for_each_image(c.position[j] - c.position[i], range,
                           [&](const Shift<2>&, const Vec2&) { ++expected; });
  for (const std::size_t pairs : nematic_correlation(c, 0.7).pairs) counted += pairs;
  EXPECT_EQ(counted, expected);
}

// Beyond 4096 particles only some are origins: 5000 are thinned to every second. Pairs of two
// origins count once, pairs of none not at all: 1 − 1/4 of all.
TEST(NematicCorrelation, ThinsTheOriginsOfLargeSystems) {
  const Configuration2 c = gas(5000, 6);
  const double range = 0.5 * c.box.lengths().minCoeff();
  std::size_t counted = 0;
  const NematicCorrelation g = nematic_correlation(c, 0.5);
  for (const std::size_t pairs : g.pairs) counted += pairs;
  const double all = 0.5 * 5000 * 4999 * pi * range * range / c.box.volume();
  // Poisson scatter of the count, five standard deviations.
  EXPECT_NEAR(static_cast<double>(counted), 0.75 * all, 5 * std::sqrt(0.75 * all));
}

TEST(NematicCorrelation, NeedsTwoParticlesThatAreNotRound) {
  Configuration2 c = gas(3, 1);
  c.shape[0] = c.shape[2] = {1, 1};
  EXPECT_TRUE(nematic_correlation(c, 1).distance.empty());
  EXPECT_EQ(correlation_length(nematic_correlation(c, 1)), 0);
}

TEST(CorrelationLength, IsTheFarEndOfTheLastBinAboveOneOverE) {
  NematicCorrelation g{{0.5, 1.5, 2.5, 3.5}, {unknown, 0.9, 0.2, 0.1}, {0, 5, 5, 5}};
  EXPECT_EQ(correlation_length(g), 2);
  g.value[2] = 0.4;
  EXPECT_EQ(correlation_length(g), 3);
  g.value = {unknown, 0.3, 0.2, unknown};
  g.pairs[3] = 0;
  EXPECT_EQ(correlation_length(g), 0);
  g.value[2] = 0.4;
  EXPECT_EQ(correlation_length(g), std::numeric_limits<double>::infinity());
}

void expect_hexatic(const Configuration2& c, double wanted) {
  const HexaticOrder order = hexatic_order(c);
  EXPECT_NEAR(order.global, wanted, 1e-12);
  EXPECT_NEAR(order.local, wanted, 1e-12);
}

TEST(HexaticOrder, IsOneOnTheTriangularLatticeAndZeroOnTheSquareLattice) {
  expect_hexatic(triangular_lattice(6, 8, 1), 1);
  expect_hexatic(square_lattice_of_disks(7), 0);
}

// The triangular lattice stretched by s along x: neighbours at (±s, 0) and (±s/2, ±h), h = √(3)/2.
// The corners of the cell are the circumcentres of the triangles, at (0, ±y₀), y₀ = h/2 + s²/(8h),
// and (±s/2, ±y₁), y₁ = h − y₀. So the edge to (s, 0) has the length 2 y₁, the others √(s²/4 + (y₀
// − y₁)²).
TEST(HexaticOrder, OfAStretchedTriangularLattice) {
  for (const double s : {1.05, 1.2, 1.35}) {
    const double h = std::sqrt(0.75), y0 = h / 2 + s * s / (8 * h), y1 = h - y0;
    const double along = 2 * y1, oblique = std::hypot(s / 2, y0 - y1);
    const double wanted =
        (2 * along + 4 * oblique * std::cos(6 * std::atan2(h, s / 2))) / (2 * along + 4 * oblique);
    SCOPED_TRACE(s);
    expect_hexatic(triangular_lattice(8, 10, 1, s), std::abs(wanted));
  }
}

// Two crystallites turned by 30° against each other would cancel; a small displacement of one
// particle changes the order only a little, also on the square lattice.
TEST(HexaticOrder, IsContinuous) {
  Configuration2 c = square_lattice_of_disks(6);
  const double small = 1e-6;
  c.position[7] += Vec2(small, 0.4 * small);
  EXPECT_LT(hexatic_order(c).local, 10 * small);
  EXPECT_GT(hexatic_order(c).local, 1e-3 * small);
}

// No order of long range: Σψ of a gas grows like √N, so N |⟨ψ⟩|² has the same mean for all N. The
// correlations of neighbouring cells make it a little other than the mean of |ψ|².
TEST(HexaticOrder, OfARandomGasVanishesLikeOneOverRootN) {
  const auto mean_square = [](std::size_t n, std::uint64_t systems) {
    double sum = 0;
    for (std::uint64_t seed = 0; seed < systems; ++seed)
      sum += std::pow(hexatic_order(gas(n, seed)).global, 2);
    return static_cast<double>(n) * sum / static_cast<double>(systems);
  };
  // |⟨ψ⟩|² is exponentially distributed: relative standard errors of 1/√200 each, 5 of the
  // difference.
  const double few = mean_square(50, 200), many = mean_square(800, 200);
  EXPECT_NEAR(std::log(many / few), 0, 5 * std::sqrt(2.0 / 200));
  EXPECT_GT(hexatic_order(gas(800, 1)).local, 0.2);
}

}  // namespace
}  // namespace vitrel

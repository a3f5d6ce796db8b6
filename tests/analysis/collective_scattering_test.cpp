#include "analysis/dynamics/collective_scattering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <set>

#include "core/error.h"
#include "tests/support/free_brownian.h"

namespace vitrel {
namespace {

/// An ideal gas: n ellipses at random places.
Configuration2 ideal_gas(std::size_t n, std::uint64_t seed) {
  Configuration2 configuration = ellipses(n);
  configuration.box = PeriodicBox<2>(Vec2(14, 9));
  Stream draw(seed, Purpose::tests, 1);
  for (Vec2& position : configuration.position)
    position = Vec2{draw.uniform(-7, 7), draw.uniform(-4.5, 4.5)};
  return configuration;
}

template <std::size_t N, int Dim = static_cast<int>(N)>
Vec<Dim> wave_vector(const std::array<int, N>& n, const PeriodicBox<Dim>& box) {
  const Eigen::Map<const Eigen::Vector<int, Dim>> steps(n.data());
  return 2 * std::numbers::pi * steps.template cast<double>().cwiseQuotient(box.lengths());
}

TEST(WaveVectorShell, HasTheNearestVectorsOfTheBoxOnceEach) {
  const PeriodicBox<2> box(Vec2(2 * std::numbers::pi, 4 * std::numbers::pi));  // steps 1 and 1/2
  const WaveVectorShell<2> smallest = wave_vector_shell(box, 0.6);
  ASSERT_EQ(smallest.n.size(), 1u);
  EXPECT_EQ(smallest.n[0], (std::array<int, 2>{0, 1}));
  EXPECT_DOUBLE_EQ(smallest.wave_number, 0.5);
  // |q| = 1: (0, 2) and (1, 0); next are (1, ±1) with √1.25 = 1.118.
  const WaveVectorShell<2> second = wave_vector_shell(box, 1);
  ASSERT_EQ(second.n.size(), 4u);
  EXPECT_NEAR(second.wave_number, (2 + 2 * std::sqrt(1.25)) / 4, 1e-15);
  EXPECT_EQ(wave_vector_shell(box, 30).n.size(), 32u);
  EXPECT_NEAR(wave_vector_shell(box, 30).wave_number, 30, 0.02);
  EXPECT_THROW(wave_vector_shell(box, 0.2), UserError);
}

/// The lengths of the vectors of a shell from all vectors with components up to `order` steps.
template <int Dim>
std::vector<double> nearest_lengths(const PeriodicBox<Dim>& box, double wave_number, int order) {
  const double reach = std::numbers::pi / box.lengths().maxCoeff();
  std::vector<double> lengths;
  std::array<int, Dim> n;
  n.fill(-order);
  for (std::size_t d = 0; d < Dim;) {
    const double q = wave_vector(n, box).norm();
    if (n > std::array<int, Dim>{} && std::abs(q - wave_number) <= reach) lengths.push_back(q);
    for (d = 0; d < Dim && ++n[d] > order; ++d) n[d] = -order;
  }
  std::ranges::sort(lengths, {}, [&](double q) { return std::abs(q - wave_number); });
  if (lengths.size() > 32) lengths.resize(32);
  return lengths;
}

template <int Dim>
void expect_nearest(const Vec<Dim>& sides, double wave_number, int order) {
  const PeriodicBox<Dim> box(sides);
  const WaveVectorShell<Dim> shell = wave_vector_shell(box, wave_number);
  const std::vector<double> expected = nearest_lengths(box, wave_number, order);
  ASSERT_EQ(shell.n.size(), expected.size()) << wave_number;
  const std::set distinct(shell.n.begin(), shell.n.end());
  EXPECT_EQ(distinct.size(), expected.size()) << wave_number;
  // Distances, since rounding decides between lengths that are equally far.
  for (std::size_t k = 0; k < expected.size(); ++k)
    EXPECT_NEAR(std::abs(wave_vector(shell.n[k], box).norm() - wave_number),
                std::abs(expected[k] - wave_number), 1e-13)
        << wave_number;
}

TEST(WaveVectorShell, HasTheNearestOfAllVectors) {
  for (const double q : {0.7, 1.3, 2.0, 3.3}) {
    expect_nearest<2>({37, 53}, q, 30);
    expect_nearest<3>({17, 23, 11}, q, 14);
  }
}

// 400 particles at φ = 5 × 10⁻⁸ in the plane, 5 × 10⁻⁶ in space, and the wave number of a liquid: inside of the
// shells are 7 × 10⁹ and 5 × 10⁷ vectors.
TEST(WaveVectorShell, OfADiluteGasHasAsManyVectorsAsOthers) {
  const WaveVectorShell<2> plane = wave_vector_shell(PeriodicBox<2>(Vec2(158'533, 158'533)), 2.7);
  EXPECT_EQ(plane.n.size(), 32u);
  EXPECT_NEAR(plane.wave_number, 2.7, std::numbers::pi / 158'533);
  const WaveVectorShell<3> space = wave_vector_shell(PeriodicBox<3>(Vec3::Constant(694)), 2.7);
  EXPECT_EQ(space.n.size(), 32u);
  EXPECT_NEAR(space.wave_number, 2.7, std::numbers::pi / 694);
}

// S(q) from the sum over all particles, frame by frame, with the same vectors.
TEST(CollectiveScattering, BeginsAtTheStructureFactor) {
  MemoryTrajectory2 trajectory = free_brownian(ideal_gas(70, 1), 11, 1);
  const std::vector<double> wave_numbers{0.6, 5};
  const CollectiveScattering found = collective_scattering(trajectory, wave_numbers);
  ASSERT_EQ(found.modes.size(), 2u);
  EXPECT_EQ(found.lag[0], 0);
  EXPECT_EQ(found.origins[0], 11u);
  for (std::size_t s = 0; s < 2; ++s) {
    const auto shell = wave_vector_shell(trajectory.read(0).box, wave_numbers[s]);
    double sum = 0;
    for (std::size_t k = 0; k < 11; ++k) {
      const Configuration2& frame = trajectory.read(k);
      for (const auto& n : shell.n) {
        std::complex<double> rho = 0;
        for (const Vec2& r : frame.position)
          rho += std::polar(1.0, wave_vector(n, frame.box).dot(r));
        sum += std::norm(rho);
      }
    }
    const double expected = sum / (11.0 * 70 * static_cast<double>(shell.n.size()));
    EXPECT_NEAR(found.scattering[s].value[0], expected, 1e-12);
  }
}

/// F of an ideal gas is F_s: ⟨exp(−q² v/2)⟩ over the shell, v the variance of displacements per axis.
double ideal_scattering(const WaveVectorShell<2>& shell, const PeriodicBox<2>& box, double time) {
  double sum = 0;
  for (const auto& n : shell.n)
    sum += std::exp(-wave_vector(n, box).squaredNorm() * free_msd(time) / 4);
  return sum / static_cast<double>(shell.n.size());
}

// 100 runs; counts within 3.5 binomial standard deviations (4.65 and 2.2): false-alarm rate 0.05 % each.
// At q = 2 modes live for 50 of 1000 steps, at q = 4 for 12; the shells have 9 and 18 wave vectors.
TEST(CollectiveScattering, ErrorBarsCoverTheIdealGas) {
  const std::vector<double> wave_numbers{2, 4};
  const std::size_t lags[] = {0, 1, 5, 20, 50};
  int one[2][5] = {}, two[2][5] = {};
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    MemoryTrajectory2 trajectory = free_brownian(ideal_gas(50, seed), 1001, 500 + seed);
    const CollectiveScattering found = collective_scattering(trajectory, wave_numbers);
    const PeriodicBox<2> box = trajectory.read(0).box;
    for (std::size_t s = 0; s < 2; ++s)
      for (std::size_t l = 0; l < 5; ++l) {
        const double truth =
            ideal_scattering(wave_vector_shell(box, wave_numbers[s]), box, brownian_step * lags[l]);
        const double away = std::abs(found.scattering[s].value[lags[l]] - truth);
        one[s][l] += away < found.scattering[s].error[lags[l]];
        two[s][l] += away < 2 * found.scattering[s].error[lags[l]];
      }
  }
  for (std::size_t s = 0; s < 2; ++s)
    for (std::size_t l = 0; l < 5; ++l) {
      EXPECT_NEAR(one[s][l], 68.27, 3.5 * 4.65) << "q " << wave_numbers[s] << " lag " << lags[l];
      EXPECT_NEAR(two[s][l], 95, 3.5 * 2.2) << "q " << wave_numbers[s] << " lag " << lags[l];
    }
}

TEST(CollectiveScattering, ResultDoesNotDependOnTheNumberOfThreads) {
  MemoryTrajectory2 trajectory = free_brownian(ideal_gas(200, 3), 100, 3);
  const std::vector<double> wave_numbers{3};
  const auto one = collective_scattering(trajectory, wave_numbers, {}, {}, 1);
  const auto two = collective_scattering(trajectory, wave_numbers, {}, {}, 2);
  EXPECT_EQ(one.scattering[0].value, two.scattering[0].value);
}

// Too few origins for blocks: the error is the spread of the wave vectors. Time 0 is that of all frames.
TEST(CollectiveScattering, LogarithmicTimesUseAllPairsOfEqualDifference) {
  Configuration2 configuration = ideal_gas(50, 4);
  std::vector<Configuration2> frames;
  for (const double time : {0.0, 1.0, 2.0, 4.0}) {
    frames.push_back(configuration);
    frames.back().time = time;
  }
  MemoryTrajectory2 trajectory(std::move(frames));
  const auto found = collective_scattering(trajectory, std::vector<double>{3.0});
  EXPECT_EQ(found.lag, (std::vector<double>{0, 1, 2, 4}));
  EXPECT_EQ(found.origins, (std::vector<std::size_t>{4, 2, 2, 1}));
  EXPECT_EQ(found.scattering[0].value[3], found.scattering[0].value[0]) << "nothing has moved";
  EXPECT_GT(found.scattering[0].error[0], 0);
  EXPECT_EQ(found.scattering[0].blocks[0], 0u);
}

TEST(CollectiveScattering, ABoxThatChangesIsRefused) {
  Configuration2 first = ideal_gas(5, 5), second = first;
  second.time = 1;
  second.box = PeriodicBox<2>(Vec2(14, 9.5));
  MemoryTrajectory2 trajectory({first, second});
  EXPECT_THROW(collective_scattering(trajectory, std::vector<double>{3.0}), UserError);
}

}  // namespace
}  // namespace vitrel

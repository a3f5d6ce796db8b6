#include "analysis/dynamics/collective_scattering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <set>

#include "core/error.h"
#include "tests/support/coverage.h"
#include "tests/support/frames.h"
#include "tests/support/free_brownian.h"
#include "tests/support/walking_solids.h"

namespace vitrel {
namespace {

using std::numbers::pi;

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
  return 2 * pi * steps.template cast<double>().cwiseQuotient(box.lengths());
}

TEST(WaveVectorShell, HasTheNearestVectorsOfTheBoxOnceEach) {
  const PeriodicBox<2> box(Vec2(2 * pi, 4 * pi));  // steps 1 and 1/2
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

TEST(WaveVectorShell, HasTheNearestVectorsOfABoxInSpaceOnceEach) {
  const PeriodicBox<3> box(2 * pi * Vec3(1, 1, 0.5));  // steps 1, 1 and 2
  // Within 1/2 of 1: (1, 0, 0), (0, 1, 0) and (1, ±1, 0) with √2.
  const WaveVectorShell<3> shell = wave_vector_shell(box, 1);
  ASSERT_EQ(shell.n.size(), 4u);
  EXPECT_NEAR(shell.wave_number, (2 + 2 * std::sqrt(2.0)) / 4, 1e-15);
  EXPECT_EQ(wave_vector_shell(box, 20).n.size(), 32u);
}

/// The lengths of the vectors of a shell from all vectors with components up to `order` steps.
template <int Dim>
std::vector<double> nearest_lengths(const PeriodicBox<Dim>& box, double wave_number, int order) {
  const double reach = pi / box.lengths().maxCoeff();
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
template <int Dim>
void expect_dilute(double side) {
  const PeriodicBox<Dim> box(Vec<Dim>::Constant(side));
  const WaveVectorShell<Dim> shell = wave_vector_shell(box, 2.7);
  EXPECT_EQ(shell.n.size(), 32u);
  EXPECT_NEAR(shell.wave_number, 2.7, pi / side);
}

TEST(WaveVectorShell, OfADiluteGasHasAsManyVectorsAsOthers) {
  expect_dilute<2>(158'533);
  expect_dilute<3>(694);
}

/// ρ(q) of a frame.
template <int Dim>
std::complex<double> density_mode(const Configuration<Dim>& frame, const Vec<Dim>& q) {
  std::complex<double> rho = 0;
  for (const Vec<Dim>& r : frame.position) rho += std::polar(1.0, q.dot(r));
  return rho;
}

/// F(q, t) from the sum over all particles and origins, with the same wave vectors; S(q) at first.
template <int Dim>
void expect_loop(MemoryTrajectory<Dim>& trajectory, const std::vector<double>& wave_numbers,
                 double tolerance) {
  const CollectiveScattering found = collective_scattering(trajectory, wave_numbers);
  const PeriodicBox<Dim> box = trajectory.read(0).box;
  const auto n = static_cast<double>(trajectory.read(0).size());
  ASSERT_EQ(found.modes.size(), wave_numbers.size());
  EXPECT_EQ(found.lag[0], 0);
  EXPECT_EQ(found.origins[0], trajectory.frames());
  for (std::size_t s = 0; s < wave_numbers.size(); ++s) {
    const auto shell = wave_vector_shell(box, wave_numbers[s]);
    EXPECT_EQ(found.modes[s], shell.n.size());
    for (const std::size_t lag : {0, 1, 4}) {
      double sum = 0, count = 0;
      for (const auto& steps : shell.n)
        for (std::size_t k = 0; k + lag < trajectory.frames(); ++k, ++count) {
          const Vec<Dim> q = wave_vector(steps, box);
          sum += std::real(std::conj(density_mode(trajectory.read(k), q)) *
                           density_mode(trajectory.read(k + lag), q));
        }
      EXPECT_NEAR(found.scattering[s].value[lag], sum / (n * count), tolerance) << lag;
    }
  }
}

TEST(CollectiveScattering, IsThatOfALoop) {
  MemoryTrajectory2 plane = free_brownian(ideal_gas(70, 1), 11, 1);
  expect_loop(plane, {0.6, 5}, 1e-12);
  MemoryTrajectory3 space = walkers(20, 12, Vec3(1, 1, 1), 0.1, 6);
  expect_loop(space, {2.5}, 1e-11);
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
  Coverage coverage[2][5];
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    MemoryTrajectory2 trajectory = free_brownian(ideal_gas(50, seed), 1001, 500 + seed);
    const CollectiveScattering found = collective_scattering(trajectory, wave_numbers);
    const PeriodicBox<2> box = trajectory.read(0).box;
    for (std::size_t s = 0; s < 2; ++s)
      for (std::size_t l = 0; l < 5; ++l) {
        const double truth =
            ideal_scattering(wave_vector_shell(box, wave_numbers[s]), box, brownian_step * lags[l]);
        const Correlation& scattering = found.scattering[s];
        coverage[s][l].count(scattering.value[lags[l]] - truth, scattering.error[lags[l]]);
      }
  }
  for (std::size_t s = 0; s < 2; ++s)
    for (std::size_t l = 0; l < 5; ++l) {
      SCOPED_TRACE(testing::Message() << "q " << wave_numbers[s] << " lag " << lags[l]);
      expect_binomial(coverage[s][l].one, 100, 0.6827, 3.5);
      expect_binomial(coverage[s][l].two, 100, 0.95, 3.5);
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
  const double times[] = {0, 1, 2, 4};
  MemoryTrajectory2 trajectory = trajectory_of(
      4, ideal_gas(50, 4), [&](Configuration2& c, std::size_t k) { c.time = times[k]; });
  const auto found = collective_scattering(trajectory, std::vector<double>{3.0});
  EXPECT_EQ(found.lag, std::vector<double>(std::begin(times), std::end(times)));
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

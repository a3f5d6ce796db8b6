#include "analysis/dynamics/velocity_correlation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random/stream.h"
#include "tests/support/coverage.h"
#include "tests/support/frames.h"
#include "tests/support/particles_of.h"
#include "tests/support/series.h"

namespace vitrel {
namespace {

using std::numbers::pi;

constexpr double interval = 0.25;

/// Frames of n particles whose velocities at frame k `set(configuration, k)` gives.
template <int Dim, class Set>
MemoryTrajectory<Dim> moving(std::size_t n, std::size_t frames, Set&& set) {
  auto c = particles_of<Dim>(std::vector<ParticleShape<Dim>>(n), Vec<Dim>::Constant(10));
  c.species_names = {"A"};
  return trajectory_of(frames, c, [&](Configuration<Dim>& frame, std::size_t k) {
    frame.time = interval * static_cast<double>(k);
    set(frame, k);
  });
}

/// An angular velocity, in space about an axis between two others.
template <int Dim>
AngularVelocity<Dim> spin(double omega) {
  if constexpr (Dim == 2)
    return omega;
  else
    return omega * Vec3(0.6, 0, 0.8);
}

/// Σ g Δω, the ends halved.
double integral(const VelocityCorrelations& found, const std::vector<double>& g) {
  double sum = -0.5 * (g.front() + g.back());
  for (const double value : g) sum += value;
  return sum * found.frequency[1];
}

/// What Hann's window makes of C = 1, whose transform is a line at 0: with T = t_M, T/π at 0, half of that at π/T.
void expect_line_at_zero(const VelocityCorrelations& found, const VelocityCorrelation& velocity) {
  for (std::size_t l = 0; l < found.lag.size(); ++l) {
    EXPECT_NEAR(velocity.correlation.value[l], 1, 1e-14);
    EXPECT_NEAR(velocity.correlation.error[l], 0, 1e-14);
  }
  const double height = 20 * interval / pi;
  ASSERT_EQ(velocity.spectrum.mean.size(), 21u);
  for (std::size_t j = 0; j < 21; ++j)
    EXPECT_NEAR(velocity.spectrum.mean[j], j == 0 ? height : j == 1 ? height / 2 : 0, 1e-13) << j;
}

template <int Dim>
void expect_free_flight() {
  Stream draw(1, Purpose::tests);
  std::vector<Vec<Dim>> drawn(30);
  for (Vec<Dim>& v : drawn)
    for (double& x : v) x = draw.normal();
  auto trajectory = moving<Dim>(30, 41, [&](Configuration<Dim>& c, std::size_t) {
    c.velocity = drawn;
    c.angular_velocity[3] = spin<Dim>(0.5);
  });
  const VelocityCorrelations found = velocity_correlations(trajectory);
  EXPECT_EQ(found.lag.size(), 21u);
  EXPECT_EQ(found.lag.front(), 0);
  EXPECT_NEAR(found.frequency.back(), pi / interval, 1e-12);
  expect_line_at_zero(found, found.translation);
  expect_line_at_zero(found, found.rotation);
  EXPECT_NEAR(found.rotation.mean_square, 0.25 / 30, 1e-15);
}

TEST(VelocityCorrelation, OfFreeFlightIsOneAndItsSpectrumALine) {
  expect_free_flight<2>();
  expect_free_flight<3>();
}

/// Velocities of Ornstein and Uhlenbeck: every component forgets at the rate γ, and those of ω at 2γ.
constexpr double rate = 0.2 / interval;

template <int Dim>
MemoryTrajectory<Dim> ornstein_uhlenbeck(std::size_t n, std::size_t frames, std::uint64_t seed) {
  Stream draw(seed, Purpose::tests);
  const auto series = [&](double times) {
    return autoregressive_series(frames, std::exp(-times * rate * interval), draw);
  };
  std::vector<std::vector<double>> velocity, omega;
  for (std::size_t i = 0; i < n; ++i) {
    for (int d = 0; d < Dim; ++d) velocity.push_back(series(1));
    omega.push_back(series(2));
  }
  return moving<Dim>(n, frames, [&](Configuration<Dim>& c, std::size_t k) {
    for (std::size_t i = 0; i < n; ++i) {
      for (int d = 0; d < Dim; ++d) c.velocity[i][d] = 3 * velocity[i * Dim + d][k];
      c.angular_velocity[i] = spin<Dim>(omega[i][k]);
    }
  });
}

double lorentzian(double gamma, double omega) {
  return 2 / pi * gamma / (gamma * gamma + omega * omega);
}

/// Standard deviation of the estimated c^k from n steps (Bartlett 1946, for an autoregressive series).
double bartlett(double c, double k, double n) {
  const double decayed = std::pow(c, 2 * k);
  return std::sqrt(((1 + c * c) * (1 - decayed) / (1 - c * c) - 2 * k * decayed) / n);
}

/// Limits are five standard deviations: 6e-7 for each of about 100 values. All 128 frames are origins. A spectrum of n
/// steps varies by the factor √(Σ w²/n), Σ w² = 3M/4 for Hann's window, twice that at the ends; and the window takes
/// 2 (π/(2γT))² off the peak, the finite interval adds (γΔ)²/12.
template <int Dim>
void expect_exponential(const VelocityCorrelations& found, const VelocityCorrelation& velocity,
                        double gamma, double series) {
  const double c = std::exp(-gamma * interval), frames = 128, m = 63;
  for (std::size_t k = 0; k <= 63; ++k) {
    const double lag = static_cast<double>(k);
    EXPECT_NEAR(velocity.correlation.value[k], std::pow(c, lag),
                5 * bartlett(c, lag, series * (frames - lag)) + 1e-14)
        << "lag " << k;
  }
  EXPECT_NEAR(integral(found, velocity.spectrum.mean), 1, 1e-12);
  ASSERT_EQ(velocity.spectrum.mean.size(), 64u);
  const double bias =
      2 * std::pow(pi / (2 * gamma * m * interval), 2) + gamma * gamma * interval * interval / 12;
  for (std::size_t j = 0; j <= 40; ++j) {
    const double g = lorentzian(gamma, found.frequency[j]);
    const double deviation = g * std::sqrt((j == 0 ? 2 : 1) * 0.75 * m / (series * (frames - m)));
    EXPECT_NEAR(velocity.spectrum.mean[j], g, 5 * deviation + bias * lorentzian(gamma, 0))
        << "frequency " << j;
  }
}

template <int Dim>
void expect_ornstein_uhlenbeck() {
  auto trajectory = ornstein_uhlenbeck<Dim>(2000, 128, 2);
  const VelocityCorrelations found = velocity_correlations(trajectory);
  expect_exponential<Dim>(found, found.translation, rate, 2000. * Dim);
  expect_exponential<Dim>(found, found.rotation, 2 * rate, 2000.);
  // The relative error of n = 512 000 squares or more with correlation c² is √(2 (1 + c²)/(1 − c²)/n) = 0.5 %.
  EXPECT_NEAR(found.translation.mean_square, 9. * Dim, 5 * 0.005 * 9 * Dim);
}

TEST(VelocityCorrelation, OfAnOrnsteinUhlenbeckProcessIsExponentialAndItsSpectrumLorentzian) {
  expect_ornstein_uhlenbeck<2>();
  expect_ornstein_uhlenbeck<3>();
}

// 100 runs; counts within 3.5 binomial standard deviations (4.65), false-alarm rate 0.05 % each. The truth of g is the
// sum over the exact C.
TEST(VelocityCorrelation, ErrorBarsCoverTheTruth) {
  const std::size_t places[] = {1, 4, 20};
  Coverage correlation[3], spectrum[3];
  const double c = std::exp(-rate * interval);
  const auto density = [&](std::size_t j) {
    double sum = 1;
    for (int k = 1; k < 100; ++k)
      sum += 2 * std::pow(std::cos(pi * k / 200), 2) * std::pow(c, k) *
             std::cos(pi * k * static_cast<double>(j) / 100);
    return interval / pi * sum;
  };
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    auto trajectory = ornstein_uhlenbeck<2>(10, 2001, 100 + seed);
    const VelocityCorrelation found = velocity_correlations(trajectory).translation;
    for (std::size_t p = 0; p < 3; ++p) {
      const std::size_t k = places[p];
      correlation[p].count(found.correlation.value[k] - std::pow(c, k), found.correlation.error[k]);
      spectrum[p].count(found.spectrum.mean[k] - density(k), found.spectrum.error[k]);
    }
  }
  for (std::size_t p = 0; p < 3; ++p) {
    SCOPED_TRACE(places[p]);
    expect_binomial(correlation[p].one, 100, 0.6827, 3.5);
    expect_binomial(spectrum[p].one, 100, 0.6827, 3.5);
  }
}

// Three particles fly on, two turn back at every step with twice the speed: C = 1 and (−1)^k, and for all together the
// mean with weights v². Those that turn back have their line at the highest frequency.
TEST(VelocityCorrelation, WeighsParticlesWithTheSquaresOfTheirVelocities) {
  auto trajectory = moving<2>(5, 41, [](Configuration2& c, std::size_t k) {
    for (std::size_t i = 0; i < 5; ++i)
      c.velocity[i] = i % 2 == 0 ? Vec2(1, 0) : Vec2(0, k % 2 == 0 ? 2 : -2);
  });
  const VelocityCorrelations found = velocity_correlations(trajectory, {.memory = 1});
  for (std::size_t k = 0; k < found.lag.size(); ++k)
    EXPECT_NEAR(found.translation.correlation.value[k], (k % 2 == 0 ? 11 : -5) / 11., 1e-14);
  EXPECT_NEAR(found.translation.spectrum.mean.front(), 3. / 11 * 20 * interval / pi, 1e-13);
  EXPECT_NEAR(found.translation.spectrum.mean.back(), 8. / 11 * 20 * interval / pi, 1e-13);
  EXPECT_NEAR(found.translation.mean_square, 11. / 5, 1e-14);
  EXPECT_TRUE(found.rotation.correlation.value.empty()) << "nothing turns";
}

TEST(VelocityCorrelation, OfUnevenTimesHasNoSpectrum) {
  auto even = ornstein_uhlenbeck<2>(20, 9, 3);
  auto uneven = chosen_frames<2>(even, {0, 1, 2, 4, 8});
  const VelocityCorrelations found = velocity_correlations(uneven);
  EXPECT_EQ(found.lag,
            (std::vector<double>{0, interval, 2 * interval, 4 * interval, 8 * interval}));
  EXPECT_EQ(found.origins, (std::vector<std::size_t>{5, 2, 2, 2, 1}));
  EXPECT_TRUE(found.frequency.empty());
  EXPECT_TRUE(found.translation.spectrum.mean.empty());
  double product = 0, square = 0;
  for (std::size_t i = 0; i < 20; ++i) {
    product += even.read(0).velocity[i].dot(even.read(8).velocity[i]);
    square += even.read(0).velocity[i].squaredNorm();
  }
  EXPECT_NEAR(found.translation.correlation.value[4], product / square, 1e-14);
}

TEST(VelocityCorrelation, DoesNotDependOnMemoryAndThreads) {
  auto trajectory = ornstein_uhlenbeck<3>(50, 200, 4);
  const auto one = velocity_correlations(trajectory, {.threads = 1});
  const auto many = velocity_correlations(trajectory, {.memory = 200 * 48 * 7, .threads = 4});
  EXPECT_EQ(one.translation.correlation.value, many.translation.correlation.value);
  EXPECT_EQ(one.rotation.spectrum.error, many.rotation.spectrum.error);
}

}  // namespace
}  // namespace vitrel

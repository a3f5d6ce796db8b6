// The equation of state from event-driven runs: collision rate and collisional virial.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <ostream>
#include <vector>

#include "bench/reference/literature.h"
#include "tests/support/equal_bodies.h"
#include "tests/support/recorded.h"
#include "tests/support/windows.h"

namespace vitrel {
namespace {

struct Rates {
  Estimate collision_rate;   // per particle and time
  Estimate compressibility;  // by the virial
  double freedoms;
  double temperature;
};

/// Runs `blocks` windows of `window` time units after `relaxation`; the windows are long against
/// the collision time, so that their averages are independent.
Rates measure(Configuration2 configuration, double relaxation, double window, int blocks) {
  draw_velocities(configuration, 7, Purpose::velocities, 0, Temperature::relative);
  const Recorder recorder = run_in_windows(configuration, -relaxation, window, blocks);
  const double n = static_cast<double>(configuration.size());
  std::vector<double> rates;
  for (int k = 0; k < blocks; ++k) {
    const auto collisions = recorder.tallies[k + 1].collisions - recorder.tallies[k].collisions;
    rates.push_back(2.0 * static_cast<double>(collisions) / n / window);
  }
  const double freedoms = 2 * n - 2 + static_cast<double>(rotor_count(configuration));
  return {estimate(rates), estimate(virial_compressibilities(recorder, window)), freedoms,
          kinetic_temperature(configuration)};
}

/// Mean |u| of one normalised velocity component at fixed energy over the canonical one: on the
/// energy sphere of f degrees of freedom, √(f/2) Γ(f/2)/Γ((f + 1)/2).
double microcanonical_speed(double f) {
  return std::sqrt(0.5 * f) * std::exp(std::lgamma(0.5 * f) - std::lgamma(0.5 * f + 0.5));
}

// Γ = 4 (Z − 1)/σ √(kT/(π m)) per particle is exact at every density; Z of the infinite system:
// Kolafa & Rottner, Mol. Phys. 104, 3435 (2006).
double compressibility_from_rate(const Rates& rates, double rate) {
  const double diameter = 2;
  return 1 + rate * diameter / 4 * std::sqrt(std::numbers::pi / rates.temperature) /
                 microcanonical_speed(rates.freedoms);
}

struct DiskCase {
  int side;
  double packing_fraction;
};
void PrintTo(const DiskCase& at, std::ostream* out) {
  *out << at.side * at.side << " disks at " << at.packing_fraction;
}

/// Z of N disks in a periodic box over that of infinitely many, to the first order in 1/N: ln Q_N = ln Ξ − βμN −
/// ½ ln(2π N S₀) gives Z_N − Z = φ/(2N) d ln S₀/dφ (Lebowitz & Percus, Phys. Rev. 122, 1675 (1961)), here with
/// S₀ = (1 − φ)³/(1 + φ) of scaled particle theory.
double finite_size_correction(double n, double phi) {
  return -phi / (2 * n) * (3 / (1 - phi) + 1 / (1 + phi));
}

class HardDisks : public testing::TestWithParam<DiskCase> {};

// 3 standard errors, as the table's own error is far smaller: false alarm 0.3 % per case, seed
// fixed. A window is longer than a sound wave takes to cross the box.
TEST_P(HardDisks, CompressibilityFromCollisionRateAndVirial) {
  const DiskCase at = GetParam();
  const Configuration2 start = lattice_of_disks(at.side, at.packing_fraction);
  const Rates rates = measure(start, 40, 40, 40);
  const double z = compressibility_from_rate(rates, rates.collision_rate.mean);
  const double error = (z - 1) * rates.collision_rate.error / rates.collision_rate.mean;
  record("Z", z, error);
  const double expected =
      fluid_pressure(1, at.packing_fraction).z +
      finite_size_correction(static_cast<double>(start.size()), at.packing_fraction);
  EXPECT_LT(error, 1e-3 * z);
  EXPECT_NEAR(z, expected, 3 * error);
  EXPECT_NEAR(rates.compressibility.mean, expected, 3 * rates.compressibility.error);
}

INSTANTIATE_TEST_SUITE_P(KolafaRottner, HardDisks,
                         testing::Values(DiskCase{32, 0.3}, DiskCase{32, 0.5}, DiskCase{32, 0.6},
                                         DiskCase{32, 0.65}, DiskCase{48, 0.3}, DiskCase{48, 0.5},
                                         DiskCase{48, 0.6}, DiskCase{48, 0.65}));

// κ = 2, φ = 0.5 (another 0.1 % allowed).
TEST(HardEllipses, CompressibilityFromTheVirial) {
  const Configuration2 start = square_lattice(20, 0.5, std::numbers::pi / 4, of_aspect_ratio(2));
  const Rates rates = measure(start, 60, 10, 30);
  record("Z", rates.compressibility.mean, rates.compressibility.error);
  EXPECT_LT(rates.compressibility.error, 0.015);
  const FluidPressure table = fluid_pressure(2, 0.5);
  EXPECT_NEAR(rates.compressibility.mean, table.z,
              3 * std::hypot(rates.compressibility.error, table.error) + 0.001 * table.z);
}

struct DiluteCase {
  double aspect_ratio, rate_over_density;
};
void PrintTo(const DiluteCase& at, std::ostream* out) {
  *out << "aspect ratio " << at.aspect_ratio;
}

class DiluteEllipses : public testing::TestWithParam<DiluteCase> {};

// The collision rate per particle and density tends to ν₀ as ρ → 0 (oracle: two quadratures). The
// rate at two densities, extrapolated linearly: 2 Γ(ρ)/ρ − Γ(2ρ)/(2ρ).
TEST_P(DiluteEllipses, CollisionRateTendsToTheKineticOne) {
  const DiluteCase at = GetParam();
  const auto rate_over_density = [&](double packing_fraction) {
    const Configuration2 start =
        square_lattice(16, packing_fraction, 0.3, of_aspect_ratio(at.aspect_ratio));
    const Rates rates = measure(start, 100, 1000, 60);
    const double density = packing_fraction / std::numbers::pi;
    const double scale =
        density * microcanonical_speed(rates.freedoms) * std::sqrt(rates.temperature);
    return Estimate{rates.collision_rate.mean / scale, rates.collision_rate.error / scale};
  };
  const Estimate thin = rate_over_density(0.005);
  const Estimate twice = rate_over_density(0.01);
  const double limit = 2 * thin.mean - twice.mean;
  const double error = std::hypot(2 * thin.error, twice.error);
  record("nu0", limit, error);
  EXPECT_LT(error, 0.01 * at.rate_over_density);
  EXPECT_NEAR(limit, at.rate_over_density, 3 * error);
}

INSTANTIATE_TEST_SUITE_P(KineticTheory, DiluteEllipses,
                         testing::Values(DiluteCase{2, 9.09600672}, DiluteCase{4, 13.53589068},
                                         DiluteCase{6, 16.93629264}));

}  // namespace
}  // namespace vitrel

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "edmd/brownian.h"

namespace vitrel {
namespace {

Configuration2 mixture(std::size_t n) {
  Configuration2 configuration;
  configuration.box = PeriodicBox<2>(Vec2(100, 100));
  configuration.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    configuration.shape[i] = i % 3 == 0 ? Ellipse{1, 1} : Ellipse{2, 0.5};
    configuration.mass[i] = i % 2 ? 1 : 3;
  }
  return configuration;
}

TEST(Velocities, HaveExactlyTheEnergyOfTheirTemperature) {
  Configuration2 c = mixture(60);
  draw_velocities(c, 1, Purpose::velocities, 0, Temperature::total);
  Mechanics sums = mechanics(c);
  EXPECT_LT(sums.momentum.norm(), 1e-13);
  EXPECT_NEAR(sums.translational_energy, 60, 1e-12);
  EXPECT_NEAR(sums.rotational_energy, 0.5 * 40, 1e-12);
  draw_velocities(c, 1, Purpose::velocities, 0, Temperature::relative);
  EXPECT_NEAR(mechanics(c).translational_energy, 59, 1e-12);
}

TEST(Velocities, RoundParticlesDoNotSpin) {
  Configuration2 c = mixture(9);
  draw_velocities(c, 1, Purpose::velocities, 0, Temperature::total);
  EXPECT_EQ(c.angular_velocity[0], 0);
  EXPECT_NE(c.angular_velocity[1], 0);
}

// Per species ½ m⟨v²⟩ = kT (1 − m/M) N/(N − 1) with N kT in all: the mean over many draws.
TEST(Velocities, EquipartitionPerSpecies) {
  Configuration2 c = mixture(10);
  const int draws = 40'000;
  double sum = 0, square = 0;
  for (int k = 0; k < draws; ++k) {
    draw_velocities(c, 5, Purpose::brownian_step, k, Temperature::total);
    const double energy = 0.5 * c.mass[0] * c.velocity[0].squaredNorm();
    sum += energy, square += energy * energy;
  }
  const double mean = sum / draws;
  const double error = std::sqrt((square / draws - mean * mean) / draws);
  EXPECT_NEAR(mean, (1 - 3.0 / 20) * 10 / 9, 4 * error);  // false alarm 6e-5
}

TEST(Velocities, WrongSplitsHoldAllTheEnergy) {
  Configuration2 c = mixture(60);
  set_initial_velocities(c, 1, InitialVelocities::translation, Temperature::total);
  EXPECT_NEAR(mechanics(c).translational_energy, 80, 1e-12);
  EXPECT_EQ(mechanics(c).rotational_energy, 0);
  set_initial_velocities(c, 1, InitialVelocities::rotation, Temperature::total);
  EXPECT_EQ(mechanics(c).translational_energy, 0);
  EXPECT_NEAR(mechanics(c).rotational_energy, 80, 1e-12);
}

TEST(Velocities, AnySplitHoldsAllTheEnergy) {
  Configuration2 c = mixture(60);
  set_initial_velocities(c, 1, InitialVelocities::split, Temperature::total, {.translation = 0.7});
  EXPECT_NEAR(mechanics(c).translational_energy, 0.7 * 80, 1e-12);
  EXPECT_NEAR(mechanics(c).rotational_energy, 0.3 * 80, 1e-12);
}

// The energy of n particles in the plane fluctuates by √(1/n) of itself, here n = 400.
TEST(Velocities, SpeciesHaveTheirOwnTemperatures) {
  Configuration2 c;
  c.resize(1200);
  for (std::size_t i = 0; i < c.size(); ++i) {
    c.shape[i] = {2, 0.5};
    c.species[i] = static_cast<std::int32_t>(i % 3 == 0);
    c.mass[i] = c.species[i] ? 3 : 1;
  }
  c.species_names = {"hot", "cold"};
  set_initial_velocities(c, 1, InitialVelocities::maxwell, Temperature::total,
                         {.temperatures = {2, 0.5}});
  const Mechanics<2> sums = mechanics(c);
  EXPECT_NEAR(sums.translational_energy, 800 * 2 + 400 * 0.5, 1e-9);
  EXPECT_NEAR(sums.rotational_energy, 0.5 * (800 * 2 + 400 * 0.5), 1e-9);
  EXPECT_LT(sums.momentum.norm(), 1e-10);
  double cold = 0;
  for (std::size_t i = 0; i < c.size(); i += 3)
    cold += 0.5 * c.mass[i] * c.velocity[i].squaredNorm() / 400;
  EXPECT_NEAR(cold, 0.5, 4 * 0.5 * std::sqrt(1. / 400));  // false alarm 6e-5
}

TEST(Velocities, DisksCannotHoldTheirEnergyInRotation) {
  Configuration2 c;
  c.resize(4);
  EXPECT_THROW(set_initial_velocities(c, 1, InitialVelocities::rotation, Temperature::total),
               UserError);
}

}  // namespace
}  // namespace vitrel

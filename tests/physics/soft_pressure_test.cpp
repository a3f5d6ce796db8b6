// The pressure of a dilute gas of elastic viscoelastic (Hertz) spheres against its second virial
// coefficient, by a law of contact so soft that hard spheres have a Z − 1 larger by two fifths.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "edmd/soft/restitution_table.h"
#include "edmd/soft/soft_contact.h"
#include "edmd/soft/viscoelastic.h"
#include "tests/support/runs.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;

/// Spheres of radius 1 and mass 1.
const ContactPair pair = contact_pair(1, 1, 1, 1);

/// The potential of the compression ξ, whose force is F = s ξ^(3/2).
double potential(const Viscoelastic& force, double compression) {
  return 0.4 * force.stiffness(pair) * std::pow(compression, 2.5);
}

struct Moments {
  double b2;      ///< 2π ∫ (1 − e^(−U/kT)) r² dr
  double energy;  ///< 2π ∫ U e^(−U/kT) r² dr, times the density ⟨U⟩ per particle
};
Moments moments(const Viscoelastic& force, double temperature) {
  constexpr int steps = 200'000;
  const double h = pair.distance / steps;
  Moments sum{0, 0};
  for (int k = 0; k < steps; ++k) {
    const double r = (k + 0.5) * h, u = potential(force, pair.distance - r);
    const double weight = 2 * pi * r * r * h, boltzmann = std::exp(-u / temperature);
    sum.b2 += weight * (1 - boltzmann);
    sum.energy += weight * u * boltzmann;
  }
  return sum;
}

// The temperature belonging to an energy E/N = 3/2 kT + ρ moments.energy.
double temperature_of(const Viscoelastic& force, double energy, double density) {
  double temperature = energy / 1.5;
  for (int k = 0; k < 20; ++k)
    temperature = (energy - density * moments(force, temperature).energy) / 1.5;
  return temperature;
}

// P V/(N kT*) − 1 with kT* = 2E/(3N). The table's error is 1e-8; early releases, 1 % of the contacts,
// change the virial of a contact by a part of it; fluctuations are M^(−1/2) = 0.3 % for M collisions.
TEST(SoftPressure, FollowsTheSecondVirialCoefficient) {
  const double packing_fraction = 0.001, density = packing_fraction * 3 / (4 * pi);
  const Viscoelastic force{300, 0.3};
  Configuration3 start = cubic_lattice(10, simple_cubic, packing_fraction, Ellipsoid{Vec3::Ones()});
  set_initial_velocities(start, 5, InitialVelocities::maxwell, Temperature::relative);
  const double n = static_cast<double>(start.size());

  DynamicsOptions options;
  const ForceForm form = form_of<Viscoelastic>();
  const RestitutionDomain domain = restitution_domain(force, {&pair, 1}, 1e-3, 12);
  options.engine.soft_contact = std::make_shared<SoftContactOf<Viscoelastic, TabulatedRestitution>>(
      force, TabulatedRestitution(form, RestitutionTable(form, domain, {1e-8}, 2)));
  const double duration = 30'000;
  const RunState3 settled = run_until(start, 2'000, options);
  const RunState3 state = run_until(settled.configuration, duration, options);

  const auto met = static_cast<double>(state.counters.collisions);
  const double energy = mechanics(state.configuration).translational_energy / n;
  const double star = 2 * energy / 3 * n / (n - 1);
  const double kt = temperature_of(force, 1.5 * star, density);
  const double b2 = moments(force, kt).b2;
  const double wanted = kt / star * (1 + b2 * density) - 1;
  const double found = state.counters.virial / (3 * n * star * duration);
  const double hard = 4 * packing_fraction;
  RecordProperty("Z - 1 over the wanted", std::to_string(found / wanted));
  RecordProperty("hard spheres", std::to_string(hard / wanted));
  RecordProperty("collisions", std::to_string(met));
  RecordProperty("early releases", std::to_string(state.counters.early_releases));
  EXPECT_GT(met, 80'000);
  EXPECT_GT(hard / wanted, 1.3);
  EXPECT_NEAR(found / wanted, 1, 0.01);
}

}  // namespace
}  // namespace vitrel

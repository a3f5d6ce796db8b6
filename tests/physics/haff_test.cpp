// Inelastic disks: Haff's cooling law, the energy balance, and the collapse that ends a hard model.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/state/check.h"
#include "tests/support/equal_bodies.h"
#include "tests/support/recorded.h"
#include "tests/support/runs.h"
#include "tests/support/statistics.h"
#include "tests/support/theory.h"

namespace vitrel {
namespace {

constexpr double packing_fraction = 0.05;
constexpr double diameter = 2;

/// The deviation of velocities from Maxwell's in the homogeneous cooling state, a₂ (van Noije & Ernst,
/// Granular Matter 1, 57 (1998), two dimensions): the rate of collisions changes by 1 − a₂/16 and that
/// of cooling by 1 + 3 a₂/16.
double fourth_cumulant(double e) {
  return 16 * (1 - e) * (1 - 2 * e * e) / (57 - 25 * e + 30 * e * e * (1 - e));
}

/// Shear modes per particle that do not cool with the rest.
double slow_modes(double e) {
  const double density = packing_fraction / std::numbers::pi;
  const double g = disk_contact_value(packing_fraction);
  const double free_path = 1 / (2 * std::numbers::sqrt2 * density * diameter * g);
  const double length = 2 * std::numbers::pi * free_path / std::sqrt(1 - e * e);
  return std::numbers::pi / (density * length * length);
}

struct Cooling {
  double inverse_root;       // √(T₀/T) − 1
  double log_per_collision;  // ln(T₀/T) N'/C, with N' = N − 1
  double energy_defect;      // |E₀ − E − dissipated|/E₀
};

/// Cools equilibrated disks from T₀ = 1 for `time`.
Cooling cool(std::uint64_t seed, double restitution, double time) {
  Configuration2 disks = lattice_of_disks(40, packing_fraction);
  draw_velocities(disks, seed, Purpose::velocities, 0, Temperature::relative);
  RunState2 state = begin_run(disks, -60);
  run(state, {}, {{}, 0, nullptr, {}}, {});
  state.configuration.time = 0;

  RunState2 cooling = begin_run(state.configuration, 0);
  const Mechanics before = mechanics(cooling.configuration);
  const double hot = kinetic_temperature(cooling.configuration);
  run(cooling, with_laws(restitution), {{}, time, nullptr, {}}, {});
  const Mechanics after = mechanics(cooling.configuration);
  const double ratio = hot / kinetic_temperature(cooling.configuration);
  const double collisions = static_cast<double>(cooling.counters.collisions);
  return {std::sqrt(ratio) - 1,
          std::log(ratio) * static_cast<double>(disks.size() - 1) / collisions,
          std::abs(before.translational_energy - after.translational_energy -
                   cooling.counters.dissipated) /
              before.translational_energy};
}

// A collision loses ½ μ (1 − e²) u_n², μ = m/2, and ⟨u_n²⟩ = 2 kT/μ over collisions: (1 − e²) kT. With
// Γ/2 collisions per particle and time and E = kT per particle (two dimensions),
//     dT/dt = −½ (1 − e²) Γ T,   Γ = 4 (Z − 1)/σ √(kT/(π m)) ∝ √T,
// so T = T₀/(1 + t/τ)² with 1/τ = ¼ (1 − e²) Γ(T₀), and ln(T₀/T) = (1 − e²) C/N after C collisions.
// Both are tested at t = τ, with 3 standard errors (false alarm 0.3 %).
//
// What is left out: shear modes with wave lengths beyond L_c ≈ 2π l/√(1 − e²), l = 1/(2√2 ρ σ g) the
// mean free path, g = (Z − 1)/(2φ), do not cool with the rest. There are π/(ρ L_c²) of them per particle,
// 0.009 at e = 0.9, and each holds up to ½ T₀: at t = τ, where T = T₀/4, they make T higher by up to
// 1.5 of their number per particle, √(T₀/T) − 1 and ln(T₀/T) lower by no more than that.
class Haff : public testing::TestWithParam<double> {};

TEST_P(Haff, CoolingFollowsTheCollisionRate) {
  const double e = GetParam();
  const double a2 = fourth_cumulant(e);
  const double excess = 2 * packing_fraction * disk_contact_value(packing_fraction);  // Z − 1
  const double rate = 4 * excess / diameter / std::sqrt(std::numbers::pi);
  const double tau = 4 / ((1 - e * e) * rate * (1 + 3. / 16 * a2));
  std::vector<double> roots, logs;
  for (std::uint64_t seed = 1; seed <= 32; ++seed) {
    const Cooling cooled = cool(seed, e, tau);
    roots.push_back(cooled.inverse_root);
    logs.push_back(cooled.log_per_collision);
    EXPECT_LT(cooled.energy_defect, 1e-13);
  }
  const Estimate root = estimate(roots), log = estimate(logs);
  record("root", root.mean, root.error);
  record("log", log.mean, log.error);
  const double slow = 1.5 * slow_modes(e);
  EXPECT_LT(root.error, 0.004);
  EXPECT_LT(root.mean, 1 + 3 * root.error);
  EXPECT_GT(root.mean, 1 - slow - 3 * root.error);
  const double per_collision = (1 - e * e) * (1 + a2 / 4);
  EXPECT_LT(log.error, 0.004 * per_collision);
  EXPECT_LT(log.mean, per_collision + 3 * log.error);
  EXPECT_GT(log.mean, per_collision * (1 - slow) - 3 * log.error);
}

INSTANTIATE_TEST_SUITE_P(Restitution, Haff, testing::Values(0.9, 0.95));

struct Collapse {
  const char* name;
  int side;
  double packing_fraction;
  Ellipse shape;
  double restitution;
};
void PrintTo(const Collapse& at, std::ostream* out) {
  *out << at.name;
}

class InelasticCollapse : public testing::TestWithParam<Collapse> {};

// Infinitely many collisions in a finite time: of a few disks in a row (McNamara & Young, Phys. Rev. E
// 50, R28 (1994)), of two ellipses that roll on each other. The state handed back is hard.
TEST_P(InelasticCollapse, IsReportedAndNotLoopedOn) {
  const Collapse& at = GetParam();
  Configuration2 start =
      square_lattice(at.side, at.packing_fraction, std::numbers::pi / 4, at.shape);
  set_initial_velocities(start, 5, InitialVelocities::maxwell, Temperature::total);
  RunState2 state = begin_run(start, -5);
  run(state, {}, {{}, 0, nullptr, {}}, {});
  const auto cool_on = [&] { run(state, with_laws(at.restitution), {{}, 1e9, nullptr, {}}, {}); };
  EXPECT_THAT(cool_on,
              testing::ThrowsMessage<InvariantError>(testing::HasSubstr("inelastic collapse")));
  EXPECT_TRUE(exact_check(state.configuration).clean());
  EXPECT_LE(state.energy_drift, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, InelasticCollapse,
    testing::Values(Collapse{"a thousand disks", 32, 0.5, {1, 1}, 0.3},
                    Collapse{"dense disks", 8, 0.7, {1, 1}, 0.2},
                    Collapse{"disks that stick", 32, 0.5, {1, 1}, 0},
                    Collapse{"a thousand ellipses", 32, 0.5, of_aspect_ratio(2), 0.3},
                    Collapse{"nearly elastic ellipses", 16, 0.5, of_aspect_ratio(2), 0.9}));

}  // namespace
}  // namespace vitrel

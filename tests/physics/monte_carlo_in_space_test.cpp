// Equations of state in space by Monte Carlo: event chains, the contact function and constant pressure, against the
// literature and against event-driven dynamics.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "mc/compression.h"
#include "mc/event_chain.h"
#include "mc/insertion.h"
#include "mc/lattice.h"
#include "mc/pressure_sampler.h"
#include "mc/swelling.h"
#include "tests/support/chain_pressures.h"
#include "tests/support/equal_bodies.h"
#include "tests/support/hard_spheres.h"
#include "tests/support/visited_states.h"
#include "tests/support/windows.h"

namespace vitrel {
namespace {

/// A fluid that began as a face-centred cubic lattice of spheres.
Configuration3 sphere_fluid(int cells, double packing_fraction) {
  Configuration3 c = cubic_lattice(cells, face_centred_cubic, packing_fraction, {});
  EventChain chains(c, {}, 5);
  sweep_and_tune(chains, 500, 1);
  return c;
}

/// Independent values per estimate; they are averages over longer times if the effort is greater.
constexpr int blocks = 20;

/// How much longer than usual Monte Carlo and motion are compared.
int effort() {
  const char* given = std::getenv("VITREL_SOLIDS_EFFORT");
  return given ? std::stoi(given) : 1;
}

/// A fluid of equal bodies of mass 1.
Configuration3 fluid_of(const Ellipsoid& shape, double packing_fraction) {
  Configuration3 c = equal_bodies<3>(343, shape);
  insert_particles(c, {0.2}, 1, {});
  SwellingState swelling;
  swell(c, {packing_fraction}, 1, swelling, {});
  c.mass.assign(c.size(), 1);
  return c;
}

// The pressure of the fluid by the contacts of chains and by the contact function. Z − 1 of 500 particles differs from
// that of infinitely many by about 1/N = 0.2 %; 3.5 standard errors, a false alarm of 5e-4 each.
TEST(SpheresByMonteCarlo, HaveTheEquationOfState) {
  for (const double phi : {0.3, 0.45}) {
    Configuration3 c = sphere_fluid(5, phi);
    const auto [by_chains, by_contacts] = chain_pressures(c, {400, blocks, 15, 4});
    const double z = hard_sphere_compressibility_factor(phi), finite = 0.002 * (z - 1);
    std::printf("spheres, phi %g: chains %.4f(%.4f), contacts %.4f(%.4f), equation of state %.4f\n",
                phi, by_chains.mean, by_chains.error, by_contacts.mean, by_contacts.error, z);
    EXPECT_LT(by_chains.error, 0.005 * z);
    EXPECT_LT(by_contacts.error, 0.01 * z);
    EXPECT_NEAR(by_chains.mean, z, 3.5 * by_chains.error + finite);
    EXPECT_NEAR(by_contacts.mean, z, 3.5 * by_contacts.error + finite);
  }
}

Estimate by_motion(Configuration3 c, FreeRotation rotation) {
  draw_velocities(c, 7, Purpose::velocities, 0, Temperature::relative);
  const double window = 10. * effort();
  DynamicsOptions options;
  options.engine.rotation = rotation;
  return estimate(virial_compressibilities(run_in_windows(c, -5, window, blocks, options), window));
}

struct FluidOfSolids {
  const char* name;
  Ellipsoid shape;
  double packing_fraction;
};

class SolidsByMonteCarlo : public testing::TestWithParam<FluidOfSolids> {
 protected:
  void record(const std::string& name, const Estimate& z) {
    std::printf("%s, phi %g, %s: Z = %.4f(%.4f)\n", GetParam().name, GetParam().packing_fraction,
                name.c_str(), z.mean, z.error);
    RecordProperty(name, std::to_string(z.mean));
    RecordProperty(name + "_error", std::to_string(z.error));
  }
};

// Three independent roads to one number, which does not depend on how free bodies rotate. 3.5 standard errors of the
// difference, a false alarm of 5e-4 each.
TEST_P(SolidsByMonteCarlo, HaveThePressureOfMotion) {
  const auto& [name, shape, phi] = GetParam();
  Configuration3 c = fluid_of(shape, phi);
  ASSERT_NEAR(packing_fraction(c), phi, 1e-9);
  const auto [mc, contacts] = chain_pressures(c, {400, blocks, 40 * effort(), 4});
  record("monte_carlo", mc);
  record("contact_function", contacts);
  EXPECT_LT(mc.error, 0.005 * mc.mean);
  EXPECT_LT(contacts.error, 0.015 * contacts.mean);
  std::vector<std::pair<const char*, FreeRotation>> rotations{{"motion", FreeRotation::euler}};
  if (shape.is_scalene()) rotations.emplace_back("constant_rotation", FreeRotation::constant);
  for (const auto& [motion, rotation] : rotations) {
    const Estimate ed = by_motion(c, rotation);
    record(motion, ed);
    EXPECT_LT(ed.error, 0.01 * mc.mean);
    EXPECT_NEAR(mc.mean, ed.mean, 3.5 * std::hypot(mc.error, ed.error));
    EXPECT_NEAR(contacts.mean, ed.mean, 3.5 * std::hypot(contacts.error, ed.error));
  }
}

const Ellipsoid scalene{Vec3(1.25, 1, 0.8)};

INSTANTIATE_TEST_SUITE_P(
    Fluids, SolidsByMonteCarlo,
    testing::Values(FluidOfSolids{"spheroids of aspect ratio 3", prolate(3), 0.3},
                    FluidOfSolids{"spheroids of aspect ratio 3", prolate(3), 0.45},
                    FluidOfSolids{"1.25:1:0.8", scalene, 0.3},
                    FluidOfSolids{"1.25:1:0.8", scalene, 0.45}));

// At βP = ρZ the packing fraction is that of the equation of state. 3.5 standard errors from 20 blocks, and half of the
// relative variance of the volume, 1/(N ∂(φZ)/∂φ), by which the mean of 1/V exceeds the inverse of the mean.
TEST(SpheresByMonteCarlo, HaveThePackingFractionOfThePressure) {
  const double phi = 0.3;
  const double density = phi / Ellipsoid{}.volume();
  for (const BoxChange change : {BoxChange::isotropic, BoxChange::anisotropic}) {
    Configuration3 c = sphere_fluid(3, phi);
    PressureSampler sampler(c, density * hard_sphere_compressibility_factor(phi), change, 3);
    sweep_and_tune(sampler, 1000, 20);
    const auto measure = [&] { return std::array{packing_fraction(c)}; };
    const auto means = block_means(
        20, 2500, [&] { sampler.sweep(); }, measure);
    const Estimate found = estimate(means[0]);
    const double variance = hard_sphere_compressibility(phi) / static_cast<double>(c.size());
    std::printf("spheres at constant pressure: phi %.5f(%.5f), equation of state %g\n", found.mean,
                found.error, phi);
    EXPECT_LT(found.error, 0.005 * phi);
    EXPECT_NEAR(found.mean, phi, 3.5 * found.error + variance * phi);
    if (change == BoxChange::isotropic) {
      EXPECT_NEAR(c.box.lengths().maxCoeff(), c.box.lengths().minCoeff(), 1e-9);
    } else {
      EXPECT_GT(c.box.lengths().maxCoeff(), 1.01 * c.box.lengths().minCoeff());
    }
  }
}

// A crystal of ellipsoids, stretched: at constant angles it is the crystal of spheres. Its pressure at 0.6 by local
// moves of bodies that may turn is far from that of the fluid; the crystal stays, hard, when the box breathes.
TEST(CrystalsByMonteCarlo, KeepTheirPlaces) {
  Configuration3 c =
      equal_bodies<3>(256, {}, Vec3::Constant(std::cbrt(256 * Ellipsoid{}.volume() / 0.6)));
  place_on_lattice(c, {Arrangement::face_centred});
  const std::vector<Vec3> sites = c.position;
  const Vec3 lengths = c.box.lengths();
  CompressionState state;
  // Speedy (1998) at φ = 0.6: Z = 15.5.
  compress(c, {.pressure = 15.5 * 0.6 / Ellipsoid{}.volume(), .sweeps = 400}, 1, state, {});
  EXPECT_NEAR(packing_fraction(c), 0.6, 0.02);
  const double spacing = lengths.x() / 4 / std::sqrt(2.0);
  for (std::size_t i = 0; i < c.size(); ++i) {
    Vec3 moved = c.unwrapped(i).cwiseQuotient(c.box.lengths()).cwiseProduct(lengths) - sites[i];
    EXPECT_LT(moved.norm(), 0.5 * spacing);
  }
}

}  // namespace
}  // namespace vitrel

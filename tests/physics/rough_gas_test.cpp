// Rough spheres: equipartition if they are elastic, and the ratio of temperatures of a cooling gas.

#include <gtest/gtest.h>

#include <cmath>

#include "edmd/run.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace vitrel {
namespace {

Configuration3 spheres(int cells, double packing_fraction) {
  return cubic_lattice(cells, simple_cubic, packing_fraction, Ellipsoid{Vec3::Ones()});
}

struct Temperatures {
  double translation = 0, rotation = 0;
  int samples = 0;

  double ratio() const { return rotation / translation; }
};

/// Of three translations of N − 1 particles, whose momentum is 0, and three rotations of N.
class Thermometer : public Observer<3> {
 public:
  void observe(const Frame<3>& frame) override {
    const Mechanics<3> sums = mechanics(frame.configuration);
    const auto n = static_cast<double>(frame.configuration.size());
    // Relative to the present energy, so that no sample of a cooling gas counts more than others.
    const double energy = sums.translational_energy + sums.rotational_energy;
    of.translation += sums.translational_energy / (1.5 * (n - 1)) / energy;
    of.rotation += sums.rotational_energy / (1.5 * n) / energy;
    ++of.samples;
  }

  Temperatures of;
};

Temperatures run_and_measure(Configuration3 start, const ContactLaw& law, double relaxation,
                             double duration, int samples, InitialVelocities velocities) {
  DynamicsOptions options;
  options.engine.laws = law;
  set_initial_velocities(start, 7, velocities, Temperature::relative, {}, contacts(options.engine));
  RunState3 state = begin_run(start, 0);
  Thermometer thermometer;
  std::vector<double> times;
  for (int k = 0; k < samples; ++k) times.push_back(relaxation + k * duration / samples);
  run(state, options, {times, relaxation + duration, &thermometer, {}}, {});
  return thermometer.of;
}

TEST(RoughSpheres, ShareTheirEnergyEvenlyIfElastic) {
  const int cells = 8, samples = 200;
  const double n = cells * cells * cells;
  const Temperatures found =
      run_and_measure(spheres(cells, 0.1), {1, ContactLaw::no_slip, 1}, 40, 400, samples,
                      InitialVelocities::translation);
  // The ratio of a sample fluctuates by √(2/f) of each of the two numbers of degrees of freedom f = 3 N. Rotations relax
  // within a few collisions, of which there are more than three between samples.
  EXPECT_NEAR(found.ratio(), 1, 4 * std::sqrt(4 / (3 * n) / (samples / 4.)));
}

// Huthmann & Zippelius, Phys. Rev. E 56, R6275 (1997): the rates of change of the two temperatures T and R,
//     Ṫ = −A T^(3/2) + B √T R,   Ṙ = B T^(3/2) − C √T R,
// with η = q (1 + β)/(2 q + 2), q = 2/5, A = (1 − e²)/4 + η (1 − η), B = η²/q and C = (η/q)(1 − η/q), lead to the ratio
// R/T = x with B x² + (C − A) x − B = 0.
double ratio_of_cooling_spheres(double e, double beta) {
  const double q = 0.4, eta = q * (1 + beta) / (2 * q + 2);
  const double a = (1 - e * e) / 4 + eta * (1 - eta), b = eta * eta / q,
               c = eta / q * (1 - eta / q);
  return (a - c + std::sqrt((a - c) * (a - c) + 4 * b * b)) / (2 * b);
}

class CoolingRoughSpheres : public testing::TestWithParam<double> {};

TEST_P(CoolingRoughSpheres, HaveTheKnownRatioOfTemperatures) {
  const double e = 0.9, beta = GetParam();
  const Temperatures found =
      run_and_measure(spheres(22, 0.01), {e, ContactLaw::no_slip, beta}, 600, 600, 20,
                      InitialVelocities::maxwell);
  EXPECT_NEAR(found.ratio() / ratio_of_cooling_spheres(e, beta), 1, 0.03) << found.ratio();
}

INSTANTIATE_TEST_SUITE_P(Beta, CoolingRoughSpheres, testing::Values(-0.5, 0., 0.5));

}  // namespace
}  // namespace vitrel

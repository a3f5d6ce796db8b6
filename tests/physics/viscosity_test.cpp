// The viscosity of fluids of low density against kinetic theory.

#include "analysis/dynamics/viscosity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "edmd/run.h"
#include "edmd/sampling.h"
#include "tests/support/equal_bodies.h"
#include "tests/support/recorded.h"
#include "tests/support/theory.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;

/// The Helfand moments of every frame.
template <int Dim>
struct MomentRecorder : Observer<Dim> {
  void observe(const Frame<Dim>& frame) override {
    times.push_back(frame.configuration.time);
    for (std::size_t k = 0; k < moments.size(); ++k)
      moments[k].push_back(frame.tally.helfand_moment[k]);
  }
  std::vector<double> times;
  std::vector<std::vector<double>> moments = std::vector<std::vector<double>>(shear_elements<Dim>);
};

/// η from a run that begins on a lattice; the stress decays in `relaxation_time`.
template <int Dim>
DiffusionCoefficient measured_viscosity(Configuration<Dim> start, double relaxation_time,
                                        double duration) {
  draw_velocities(start, 5, Purpose::velocities, 0, Temperature::relative);
  RunState<Dim> state = begin_run(start, -10 * relaxation_time);
  MomentRecorder<Dim> recorder;
  run(state, {}, {linear_times(0.5 * relaxation_time, duration), duration, &recorder, {}}, {});
  return shear_viscosity(recorder.times, recorder.moments, {start.box.volume(), 1, relaxation_time},
                         {.longest_lag = 0.1})
      .shear;
}

void expect_viscosity(const DiffusionCoefficient& found, double enskog, double theory) {
  record("eta over Enskog", found.value / enskog, found.error / enskog);
  EXPECT_LT(found.error, 0.05 * enskog);
  EXPECT_NEAR(found.value, enskog, theory * enskog + 3 * found.error);
}

// Enskog, with b ρ = 2 φ (gass1971): η = 1.022/(2 σ) √(m kT/π) [1/g + b ρ + 0.8729 (b ρ)² g]. Five mean free times, in
// which the stress decays, are 0.26/(φ g) in the plane for σ = 2. Long-time tails add a few per cent in the plane at
// this density (3 %). 3 standard errors: false alarm 0.3 %.
TEST(Viscosity, DisksAreAsViscousAsEnskogSays) {
  const double phi = 0.1, diameter = 2, g = disk_contact_value(phi), b = 2 * phi;
  const double enskog = 1.022 / (2 * diameter) / std::sqrt(pi) * (1 / g + b + 0.8729 * b * b * g);
  expect_viscosity(measured_viscosity(lattice_of_disks(14, phi), 38, 3e5), enskog, 0.03);
}

// Enskog with g of Carnahan and Starling and b ρ = 4 φ (hansen2013):
// η = 1.016 · 5/(16 σ²) √(m kT/π) [1/g + 0.8 b ρ + 0.761 (b ρ)² g]. 125 spheres are less viscous by some per cent than a large system (3 %).
TEST(Viscosity, SpheresAreAsViscousAsEnskogSays) {
  const double phi = 0.2, diameter = 2, b = 4 * phi;
  const double g = (1 - phi / 2) / std::pow(1 - phi, 3);
  const double enskog = 1.016 * 5 / (16 * diameter * diameter) / std::sqrt(pi) *
                        (1 / g + 0.8 * b + 0.761 * b * b * g);
  const Configuration3 start = cubic_lattice(5, simple_cubic, phi, Ellipsoid{Vec3::Ones()});
  expect_viscosity(measured_viscosity(start, 4, 1e4), enskog, 0.03);
}

}  // namespace
}  // namespace vitrel

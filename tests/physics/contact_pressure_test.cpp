// Two independent roads to one number: the compressibility of ellipses by Monte Carlo (contact
// function) and by event-driven dynamics (collisional virial), and the table's.

#include <gtest/gtest.h>

#include <vector>

#include "bench/reference/literature.h"
#include "mc/contact_pressure.h"
#include "mc/sampler.h"
#include "tests/support/fluids.h"
#include "tests/support/recorded.h"
#include "tests/support/visited_states.h"
#include "tests/support/windows.h"

namespace vitrel {
namespace {

Estimate monte_carlo(Configuration2& c, int blocks, int samples) {
  Sampler sampler(c, 11);
  sweep_and_tune(sampler, 2000, 20);
  std::vector<double> values;
  ContactPressure pressure;
  for (int block = 0; block < blocks; ++block) {
    for (int sample = 0; sample < samples; ++sample) {
      for (int sweep = 0; sweep < 4; ++sweep) {
        sampler.sweep();
        if (sweep % 2 == 1) pressure.add(c);
      }
    }
    values.push_back(pressure.compressibility());
    pressure.clear();
  }
  return estimate(values);
}

Estimate event_driven(Configuration2 c, int blocks, double window) {
  draw_velocities(c, 7, Purpose::velocities, 0, Temperature::relative);
  return estimate(virial_compressibilities(run_in_windows(c, -20, window, blocks), window));
}

// κ = 2, φ = 0.5: Z = 4.492(3), another 0.1 % allowed (oracle: NVT Monte Carlo). 3 standard errors.
TEST(Compressibility, MonteCarloEventDrivenAndTableAgree) {
  Configuration2 c = swollen_fluid(400, 2, 0.5);
  const Estimate mc = monte_carlo(c, 30, 200);
  const Estimate ed = event_driven(c, 40, 10);
  record("monte_carlo", mc.mean, mc.error);
  record("event_driven", ed.mean, ed.error);
  EXPECT_LT(mc.error, 0.02);
  EXPECT_LT(ed.error, 0.015);
  const FluidPressure table = fluid_pressure(2, 0.5);
  EXPECT_NEAR(mc.mean, table.z, 3 * std::hypot(mc.error, table.error) + 0.001 * table.z);
  EXPECT_NEAR(ed.mean, table.z, 3 * std::hypot(ed.error, table.error) + 0.001 * table.z);
  EXPECT_NEAR(mc.mean, ed.mean, 3 * std::hypot(mc.error, ed.error));
}

// Disks in a square box, and in flat ones whose cells and domains are others: two rows of domains, or one.
TEST(Compressibility, MonteCarloOfDisks) {
  struct Case {
    double packing_fraction, box_aspect;
  };
  for (const Case& at : {Case{0.3, 1}, Case{0.5, 1}, Case{0.5, 0.3}, Case{0.5, 0.08}}) {
    Configuration2 c = swollen_fluid(400, 1, at.packing_fraction, at.box_aspect);
    const Estimate mc = monte_carlo(c, 30, 250);
    EXPECT_LT(mc.error, 0.01);
    EXPECT_NEAR(mc.mean, fluid_pressure(1, at.packing_fraction).z, 3 * mc.error)
        << "φ = " << at.packing_fraction << ", L_y/L_x = " << at.box_aspect;
  }
}

}  // namespace
}  // namespace vitrel

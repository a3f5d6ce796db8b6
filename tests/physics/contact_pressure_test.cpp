// Two independent roads to one number: the compressibility of ellipses by Monte Carlo (contact
// function) and by event-driven dynamics (collisional virial), and the table's.

#include <gtest/gtest.h>

#include <vector>

#include "bench/reference/literature.h"
#include "edmd/run.h"
#include "edmd/sampling.h"
#include "mc/contact_pressure.h"
#include "mc/sampler.h"
#include "tests/support/fluids.h"
#include "tests/support/statistics.h"

namespace vitrel {
namespace {

Estimate monte_carlo(Configuration2& c, int blocks, int samples) {
  Sampler sampler(c, 11);
  for (int round = 0; round < 100; ++round) {
    for (int sweep = 0; sweep < 20; ++sweep) sampler.sweep();
    sampler.tune();
  }
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
  RunState2 state = begin_run(c, -20);
  Recorder recorder;
  RunPlan2 plan{linear_times(window, window * blocks), window * blocks, &recorder, {}};
  run(state, {}, plan, {});
  std::vector<double> values;
  for (int k = 0; k < blocks; ++k)
    values.push_back(virial_compressibility(
        recorder.frames[k], recorder.tallies[k + 1].virial - recorder.tallies[k].virial, window));
  return estimate(values);
}

// κ = 2, φ = 0.5: Z = 4.492(3), another 0.1 % allowed (oracle: NVT Monte Carlo). 3 standard errors.
TEST(Compressibility, MonteCarloEventDrivenAndTableAgree) {
  Configuration2 c = swollen_fluid(400, 2, 0.5);
  const Estimate mc = monte_carlo(c, 30, 200);
  const Estimate ed = event_driven(c, 40, 10);
  RecordProperty("monte_carlo", std::to_string(mc.mean) + " +- " + std::to_string(mc.error));
  RecordProperty("event_driven", std::to_string(ed.mean) + " +- " + std::to_string(ed.error));
  std::printf("Z: Monte Carlo %.4f(%.4f), event-driven %.4f(%.4f), table 4.492(3)\n", mc.mean,
              mc.error, ed.mean, ed.error);
  EXPECT_LT(mc.error, 0.02);
  EXPECT_LT(ed.error, 0.015);
  const FluidPressure table = fluid_pressure(2, 0.5);
  EXPECT_NEAR(mc.mean, table.z, 3 * std::hypot(mc.error, table.error) + 0.001 * table.z);
  EXPECT_NEAR(ed.mean, table.z, 3 * std::hypot(ed.error, table.error) + 0.001 * table.z);
  EXPECT_NEAR(mc.mean, ed.mean, 3 * std::hypot(mc.error, ed.error));
}

// Disks in a square box, and in
// flat ones whose cells and domains are others: two rows of domains, or one.
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

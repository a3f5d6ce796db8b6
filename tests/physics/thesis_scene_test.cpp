// The scenes of the thesis, whole: nothing overlaps in any saved frame, and what must be conserved
// is.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/state/check.h"
#include "edmd/run.h"
#include "edmd/sampling.h"
#include "tests/support/equal_bodies.h"

namespace vitrel {
namespace {

void expect_hard_and_conserving(Configuration2 start, double packing_fraction) {
  ASSERT_NEAR(vitrel::packing_fraction(start), packing_fraction, 1e-12);
  set_initial_velocities(start, 1, InitialVelocities::maxwell, Temperature::total);
  RunState2 state = begin_run(start, 0);
  Recorder recorder;
  RunPlan2 plan{linear_times(0.1, 100), 100, &recorder, {}};
  run(state, {}, plan, {});
  EXPECT_EQ(recorder.frames.size(), 1001u);
  EXPECT_EQ(state.counters.correction_moves, 0u);
  EXPECT_LE(state.energy_drift, 1e-12);
  EXPECT_LE(state.largest_momentum, 1e-11);
  for (const Configuration2& frame : recorder.frames)
    ASSERT_TRUE(exact_check(frame).overlaps.empty());
}

TEST(ThesisScene, NewtonianStaysHardAndConserves) {
  expect_hard_and_conserving(square_lattice(10, 0.5, std::numbers::pi / 4, of_aspect_ratio(2)),
                             0.5);
}

// Size ratio 1 : 1.4, aspect ratios 3 and 1.
TEST(ThesisScene, BinaryMixtureStaysHardAndConserves) {
  const Ellipse small = of_aspect_ratio(3);
  expect_hard_and_conserving(square_lattice(10, 0.4, std::numbers::pi / 4,
                                            [&](std::size_t i) {
                                              return (i / 10 + i) % 2 ? Ellipse{1.4, 1.4} : small;
                                            }),
                             0.4);
}

}  // namespace
}  // namespace vitrel

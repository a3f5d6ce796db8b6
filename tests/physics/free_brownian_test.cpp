// Free particles with the Brownian step: displacements in closed form, from the engine through the
// analysis. In n steps of τ_B a particle makes n independent flights with ⟨v²⟩ = 2 kT/m and
// ⟨ω²⟩ = kT/I, exactly so in every step: MSD(n τ_B) = 2 n τ_B² kT/m, MSR(n τ_B) = n τ_B² kT/I.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "analysis/dynamics/displacement.h"
#include "analysis/trajectory.h"
#include "edmd/run.h"
#include "edmd/sampling.h"
#include "tests/support/scenes.h"

namespace vitrel {
namespace {

constexpr double step = 0.1;

/// Sixteen small ellipses so far apart that they do not meet.
std::vector<Configuration2> free_run(std::uint64_t seed, double duration) {
  Configuration2 c = square_lattice(4, 1e-9, 0, [](std::size_t) { return of_aspect_ratio(3); });
  draw_velocities(c, seed, Purpose::velocities, 0, Temperature::total);
  RunState2 state = begin_run(c, 0);
  Recorder recorder;
  DynamicsOptions options;
  options.brownian = true;
  options.brownian_step = step;
  options.seed = seed;
  RunPlan2 plan{linear_times(step, duration), duration, &recorder, {}};
  run(state, options, plan, {});
  EXPECT_EQ(state.counters.collisions, 0u);
  return recorder.frames;
}

double msd(double steps) {
  return 2 * steps * step * step;
}
double msr(double steps) {
  return steps * step * step / of_aspect_ratio(3).inertia_per_mass();
}

// Three standard errors; lags share their frames, so that one false alarm in 0.3 % is about that of one
// lag.
TEST(FreeBrownian, DisplacementsEqualTheClosedForm) {
  MemoryTrajectory2 trajectory(free_run(1, 400));
  const Displacements found = displacements(trajectory);
  const DisplacementGroup& all = found.groups.front();
  for (std::size_t k = 0; k < found.lag.size(); ++k) {
    const double steps = std::round(found.lag[k] / step);
    if (steps > 200) break;
    if (steps == 1) {  // exact in every flight, up to rounding
      EXPECT_NEAR(all.translation.value[k], msd(1), 1e-12);
      EXPECT_NEAR(all.rotation.value[k], msr(1), 1e-12);
      continue;
    }
    ASSERT_GT(all.translation.error[k], 0);
    EXPECT_NEAR(all.translation.value[k], msd(steps), 3 * all.translation.error[k]) << steps;
    EXPECT_NEAR(all.rotation.value[k], msr(steps), 3 * all.rotation.error[k]) << steps;
  }
  EXPECT_LT(all.translation.error[9], 0.05 * all.translation.value[9]);
}

// Over 100 seeds an error bar covers the truth in 68 of 100 cases: between 54 and 82 within three
// binomial deviations (false alarm 0.3 % per lag).
TEST(FreeBrownian, ErrorBarsCoverTheTruthAsOftenAsTheySay) {
  const std::vector<std::size_t> lags{1, 4, 20};  // at lag 1 · τ_B every step's ⟨v²⟩ is exact
  std::vector<int> covered_translation(lags.size()), covered_rotation(lags.size());
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    MemoryTrajectory2 trajectory(free_run(seed, 60));
    const DisplacementGroup all = displacements(trajectory).groups.front();
    for (std::size_t k = 0; k < lags.size(); ++k) {
      const std::size_t at = lags[k] - 1;
      const auto steps = static_cast<double>(lags[k]);
      covered_translation[k] +=
          std::abs(all.translation.value[at] - msd(steps)) <= all.translation.error[at] + 1e-12;
      covered_rotation[k] +=
          std::abs(all.rotation.value[at] - msr(steps)) <= all.rotation.error[at] + 1e-12;
    }
  }
  EXPECT_EQ(covered_translation[0], 100);
  EXPECT_EQ(covered_rotation[0], 100);
  for (std::size_t k = 1; k < lags.size(); ++k) {
    EXPECT_GE(covered_translation[k], 54) << lags[k];
    EXPECT_LE(covered_translation[k], 82) << lags[k];
    EXPECT_GE(covered_rotation[k], 54) << lags[k];
    EXPECT_LE(covered_rotation[k], 82) << lags[k];
  }
}

}  // namespace
}  // namespace vitrel

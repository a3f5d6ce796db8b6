// Free particles with the Brownian step: displacements in closed form, from the engine through the
// analysis. In n steps of τ_B a particle makes n independent flights with ⟨v²⟩ = 2 kT/m and
// ⟨ω²⟩ = kT/I, exactly so in every step: MSD(n τ_B) = 2 n τ_B² kT/m, MSR(n τ_B) = n τ_B² kT/I.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "analysis/dynamics/displacement.h"
#include "analysis/trajectory.h"
#include "tests/support/equal_bodies.h"
#include "tests/support/runs.h"

namespace vitrel {
namespace {

constexpr double step = 0.1;

/// Sixteen small ellipses so far apart that they do not meet.
std::vector<Configuration2> free_run(std::uint64_t seed, double duration) {
  Configuration2 c = square_lattice(4, 1e-9, 0, of_aspect_ratio(3));
  draw_velocities(c, seed, Purpose::velocities, 0, Temperature::total);
  DynamicsOptions options = brownian(step);
  options.seed = seed;
  const Recorder recorder = recorded_run(c, 0, linear_times(step, duration), duration, options);
  EXPECT_EQ(recorder.tallies.back().collisions, 0u);
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
  std::vector<std::array<int, 2>> covered(lags.size());  // of translation and of rotation
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    MemoryTrajectory2 trajectory(free_run(seed, 60));
    const DisplacementGroup all = displacements(trajectory).groups.front();
    for (std::size_t k = 0; k < lags.size(); ++k) {
      const std::size_t at = lags[k] - 1;
      const auto steps = static_cast<double>(lags[k]);
      const auto covers = [&](const Correlation& found, double truth) {
        return std::abs(found.value[at] - truth) <= found.error[at] + 1e-12;
      };
      covered[k][0] += covers(all.translation, msd(steps));
      covered[k][1] += covers(all.rotation, msr(steps));
    }
  }
  for (std::size_t k = 0; k < lags.size(); ++k)
    for (const int count : covered[k]) {
      EXPECT_GE(count, k == 0 ? 100 : 54) << lags[k];
      EXPECT_LE(count, k == 0 ? 100 : 82) << lags[k];
    }
}

}  // namespace
}  // namespace vitrel

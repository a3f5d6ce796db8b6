// The structure of hard spheres at rest in thermal equilibrium against their equation of state.

#include <gtest/gtest.h>

#include <vector>

#include "analysis/structure/pair_correlation.h"
#include "tests/support/hard_spheres.h"
#include "tests/support/recorded.h"
#include "tests/support/runs.h"
#include "tests/support/statistics.h"
#include "tests/support/structure.h"

namespace vitrel {
namespace {

constexpr double phi = 0.3;
constexpr std::size_t stretches = 20, frames_each = 60;

/// g(2+) = (Z − 1)/(4 φ).
double contact_value() {
  return (hard_sphere_compressibility_factor(phi) - 1) / (4 * phi);
}

/// A Newtonian run of 864 spheres of radius 1 from a melted lattice.
const std::vector<Configuration3>& frames() {
  static const std::vector<Configuration3> recorded = [] {
    Configuration3 moving = cubic_lattice(6, face_centred_cubic, phi, {});
    draw_velocities(moving, 3, Purpose::velocities, 0, Temperature::relative);
    const double interval = 3, end = interval * (stretches * frames_each - 1);
    return recorded_run(moving, -50, linear_times(interval, end), end).frames;
  }();
  return recorded;
}

/// One value from every stretch of the run: measure(first frame, frame after the last).
template <class Measure>
Estimate over_stretches(Measure&& measure) {
  std::vector<double> values;
  for (std::size_t stretch = 0; stretch < stretches; ++stretch)
    values.push_back(measure(stretch * frames_each, (stretch + 1) * frames_each));
  return estimate(values);
}

// S₀ + S₂ q² + S₄ q⁴ up to 2q = 2, the shells weighted by their wave vectors. Three standard errors: false
// alarm 0.3 %, seed fixed.
TEST(HardSpheres, StructureFactorAtSmallWaveNumbersIsTheCompressibility) {
  const ScatteringShells<3> shells(frames().front().box.lengths(), {1, 0.05});
  const Estimate zero = over_stretches([&](std::size_t begin, std::size_t end) {
    return structure_factor_at_zero(shells, frames(), begin, end);
  });
  record("S(0)", zero.mean, zero.error);
  EXPECT_LT(zero.error, 0.02 * zero.mean);
  EXPECT_NEAR(zero.mean, hard_sphere_compressibility(phi), 3 * zero.error);
}

// A parabola of r − 2 through the bins up to r = 2.2.
TEST(HardSpheres, PairCorrelationAtContactIsThatOfTheEquationOfState) {
  const Estimate contact = over_stretches([](std::size_t begin, std::size_t end) {
    std::vector<double> gap, mean;
    for (std::size_t k = begin; k < end; ++k) {
      const PairCorrelation pairs = pair_correlation(frames()[k], {2.2, 0.01});
      gap.clear();
      mean.resize(20, 0);
      for (std::size_t bin = 200; bin < 220; ++bin) {
        gap.push_back(pairs.distance[bin] - 2);
        mean[bin - 200] += pairs.g[bin] / static_cast<double>(end - begin);
        EXPECT_EQ(pairs.g[bin - 200], 0);
      }
    }
    return value_at_zero(gap, mean, std::vector<double>(20, 1), 2);
  });
  EXPECT_LT(contact.error, 0.005 * contact.mean);
  EXPECT_NEAR(contact.mean, contact_value(), 3 * contact.error);
}

}  // namespace
}  // namespace vitrel

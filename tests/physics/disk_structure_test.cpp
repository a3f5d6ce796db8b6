// The structure factor of hard disks at small q against their compressibility.

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/equal_bodies.h"
#include "tests/support/runs.h"
#include "tests/support/statistics.h"
#include "tests/support/structure.h"

namespace vitrel {
namespace {

/// ∂ρ/∂(βP) = 1/(1 + Σ n B_n ρ^{n−1}), to the seventh virial coefficient (Clisby & McCoy, J. Stat.
/// Phys. 122, 15 (2006)). At φ = 0.2 the terms fall by about 0.25 each: those left out make 0.05 %.
double compressibility(double packing_fraction) {
  const double x = 2 * packing_fraction;
  const double coefficients[] = {1,          0.782004437912, 0.532231807025,
                                 0.33355604, 0.1988425,      0.1148728};  // B_n/B_2^{n−1}
  double sum = 1, power = 1;
  for (int n = 2; n <= 7; ++n) {
    power *= x;
    sum += n * coefficients[n - 2] * power;
  }
  return 1 / sum;
}

// S(q → 0) = ρ kT κ_T. Fixed N is no matter at q ≠ 0 but for O(1/N). 20 independent stretches of 25
// frames, three standard errors: false alarm 0.3 %, seed fixed.
TEST(HardDiskStructure, StructureFactorAtSmallWaveNumbersIsTheCompressibility) {
  const double packing_fraction = 0.2;
  Configuration2 start = lattice_of_disks(32, packing_fraction);
  const ScatteringShells shells(start.box.lengths(), {1, 0.05});
  std::vector<double> values;
  draw_velocities(start, 3, Purpose::velocities, 0, Temperature::relative);
  const Recorder recorder = recorded_run(start, -200, linear_times(4, 2000), 2000);
  for (std::size_t begin = 0; begin < 500; begin += 25)
    values.push_back(structure_factor_at_zero(shells, recorder.frames, begin, begin + 25));
  const Estimate zero = estimate(values);
  EXPECT_LT(zero.error, 0.01 * zero.mean);
  EXPECT_NEAR(zero.mean, compressibility(packing_fraction), 3 * zero.error);
}

}  // namespace
}  // namespace vitrel

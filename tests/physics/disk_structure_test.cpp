// The structure factor of hard disks at small q against their compressibility.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "analysis/structure/structure_factor.h"
#include "edmd/run.h"
#include "edmd/sampling.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

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

/// S₀ of the S₀ + S₂ q² + S₄ q⁴ that fits the shells best, each weighted by its wave vectors: their S
/// have nearly equal errors, as S varies little below q = 1.
double value_at_zero(const std::vector<double>& q, const std::vector<double>& s,
                     const std::vector<double>& modes) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < q.size(); ++k) {
    if (modes[k] == 0) continue;
    const Eigen::Vector3d powers(1, q[k] * q[k], std::pow(q[k], 4));
    normal += modes[k] * powers * powers.transpose();
    right += modes[k] * s[k] * powers;
  }
  return normal.ldlt().solve(right)[0];
}

// S(q → 0) = ρ kT κ_T. Fixed N is no matter at q ≠ 0 but for O(1/N). 20 independent stretches of 25
// frames, three standard errors: false alarm 0.3 %, seed fixed.
TEST(HardDiskStructure, StructureFactorAtSmallWaveNumbersIsTheCompressibility) {
  const double packing_fraction = 0.2;
  const Configuration2 start = square_lattice(32, packing_fraction, 0, [](std::size_t) {
    return Ellipse{1, 1};
  });
  const ScatteringShells shells(start.box.lengths(), {1, 0.05});
  std::vector<double> values;
  Configuration2 moving = start;
  draw_velocities(moving, 3, Purpose::velocities, 0, Temperature::relative);
  RunState2 state = begin_run(moving, -200);
  Recorder recorder;
  run(state, {}, RunPlan2{linear_times(4, 2000), 2000, &recorder, {}}, {});
  for (std::size_t stretch = 0; stretch < 20; ++stretch) {
    std::vector<double> mean;
    StructureFactor s;
    for (std::size_t k = 0; k < 25; ++k) {
      s = shells.structure_factor(recorder.frames[25 * stretch + k]);
      mean.resize(s.total.size(), 0);
      for (std::size_t shell = 0; shell < mean.size(); ++shell) mean[shell] += s.total[shell] / 25;
    }
    values.push_back(value_at_zero(s.q, mean, s.modes));
  }
  const Estimate zero = estimate(values);
  EXPECT_LT(zero.error, 0.01 * zero.mean);
  EXPECT_NEAR(zero.mean, compressibility(packing_fraction), 3 * zero.error);
}

}  // namespace
}  // namespace vitrel

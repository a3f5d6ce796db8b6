// The structure of hard spheres at rest in thermal equilibrium against their equation of state.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "analysis/structure/pair_correlation.h"
#include "analysis/structure/structure_factor.h"
#include "edmd/run.h"
#include "edmd/sampling.h"
#include "tests/support/hard_spheres.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

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
    RunState3 state = begin_run(moving, -50);
    FrameRecorder<3> recorder;
    const double interval = 3, end = interval * (stretches * frames_each - 1);
    run(state, {}, RunPlan3{linear_times(interval, end), end, &recorder, {}}, {});
    return recorder.frames;
  }();
  return recorded;
}

/// c₀ of the Σ c_n x^n, n = 0 … degree, that fits best.
double value_at_zero(const std::vector<double>& x, const std::vector<double>& y,
                     const std::vector<double>& weight, int degree) {
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(degree + 1, degree + 1);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(degree + 1);
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (weight[k] == 0) continue;
    Eigen::VectorXd powers(degree + 1);
    for (int n = 0; n <= degree; ++n) powers[n] = std::pow(x[k], n);
    normal += weight[k] * powers * powers.transpose();
    right += weight[k] * y[k] * powers;
  }
  return normal.ldlt().solve(right)[0];
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
    std::vector<double> mean, squares;
    StructureFactor s;
    for (std::size_t k = begin; k < end; ++k) {
      s = shells.structure_factor(frames()[k]);
      mean.resize(s.total.size(), 0);
      for (std::size_t shell = 0; shell < mean.size(); ++shell)
        mean[shell] += s.total[shell] / static_cast<double>(end - begin);
    }
    for (const double q : s.q) squares.push_back(q * q);
    return value_at_zero(squares, mean, s.modes, 2);
  });
  RecordProperty("S(0)", std::to_string(zero.mean) + " +- " + std::to_string(zero.error));
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

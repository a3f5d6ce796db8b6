// Free spheres and spheroids with the Brownian step, from the engine through the analysis: displacements and
// orientations in closed form, compared at several lags at once.
//
// In every step all velocities are drawn anew with exactly the energies 3N/2 and N kT of translation and
// rotation. ⟨v²⟩ = 3 kT/m and ⟨ω²⟩ = 2 kT/I⊥ are exact, steps are independent and have no direction:
// MSD(n τ_B) = 3 n τ_B² kT/m, MSR(n τ_B) = 2 n τ_B² kT/I⊥. In a step the axis u turns by α about a random
// axis across it, so P_l(n τ_B) = ⟨P_l(cos α)⟩ⁿ. The 2N components of ω are a random point on a sphere,
// hence α² = 2N b τ_B² kT/I⊥ with b distributed as (N − 1)(1 − b)^(N − 2).

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>
#include <vector>

#include "analysis/dynamics/displacement.h"
#include "tests/support/equal_bodies.h"
#include "tests/support/runs.h"

namespace vitrel {
namespace {

constexpr double step = 0.1;
constexpr int side = 3, bodies = side * side * side;
constexpr std::size_t runs = 300;
constexpr std::size_t lags[] = {2, 5, 12, 30};

/// 27 small bodies so far apart that they do not meet.
Displacements free_run(const Ellipsoid& shape, std::uint64_t seed) {
  Configuration3 c = cubic_lattice(side, 1e-12, shape, seed);
  draw_velocities(c, seed, Purpose::velocities, 0, Temperature::total);
  DynamicsOptions options = brownian(step);
  options.seed = seed;
  constexpr double duration = 6;
  FrameRecorder<3> recorder = recorded_run(c, 0, linear_times(step, duration), duration, options);
  EXPECT_EQ(recorder.tallies.back().collisions, 0u);
  MemoryTrajectory3 trajectory(std::move(recorder.frames));
  return displacements(trajectory);
}

/// ⟨P_l(cos α)⟩ of a step, by the trapezoidal rule in √b, which takes away the root in α.
double step_average(unsigned l, double inertia) {
  constexpr int nodes = 20'000;
  double sum = 0;
  for (int k = 1; k < nodes; ++k) {
    const double root = static_cast<double>(k) / nodes, b = root * root;
    const double alpha = std::sqrt(2 * bodies / inertia) * step * root;
    sum += std::legendre(l, std::cos(alpha)) * (bodies - 1) * std::pow(1 - b, bodies - 2) * 2 *
           root / nodes;
  }
  return sum;
}

/// Hotelling's test that the rows, independent of each other, have these means: the probability of a larger
/// deviation by chance.
double probability(const Eigen::MatrixXd& rows, const Eigen::VectorXd& expected) {
  const auto n = static_cast<double>(rows.rows()), p = static_cast<double>(rows.cols());
  const Eigen::RowVectorXd mean = rows.colwise().mean();
  const Eigen::MatrixXd away = rows.rowwise() - mean;
  const Eigen::MatrixXd covariance = away.transpose() * away / (n - 1);
  const Eigen::VectorXd deviation = mean.transpose() - expected;
  const double t_squared = n * deviation.dot(covariance.ldlt().solve(deviation));
  const boost::math::fisher_f distribution(p, n - p);
  return boost::math::cdf(complement(distribution, (n - p) / (p * (n - 1)) * t_squared));
}

/// What a run gives at the lags: MSD, MSR, P₁ and P₂ (of spheres the MSD only).
void append(std::vector<double>& row, const DisplacementGroup& all, std::size_t lag) {
  row.push_back(all.translation.value[lag - 1]);
  if (all.rotors == 0) return;
  row.push_back(all.rotation.value[lag - 1]);
  row.push_back(all.orientation[0].value[lag - 1]);
  row.push_back(all.orientation[1].value[lag - 1]);
}

std::vector<double> closed_forms(const Ellipsoid& shape, std::size_t lag) {
  const auto n = static_cast<double>(lag);
  std::vector<double> forms{3 * n * step * step};
  if (shape.is_round()) return forms;
  const double inertia = shape.inertia_per_mass()[0];
  forms.push_back(2 * n * step * step / inertia);
  forms.push_back(std::pow(step_average(1, inertia), n));
  forms.push_back(std::pow(step_average(2, inertia), n));
  return forms;
}

class FreeSolids : public testing::TestWithParam<Vec3> {};

TEST_P(FreeSolids, MoveAndTurnAsTheClosedFormsSay) {
  const Ellipsoid shape{GetParam()};
  std::vector<double> expected;
  for (const std::size_t lag : lags)
    for (const double value : closed_forms(shape, lag)) expected.push_back(value);
  const auto width = static_cast<Eigen::Index>(expected.size());
  Eigen::MatrixXd rows(runs, width);
  for (std::size_t k = 0; k < runs; ++k) {
    const Displacements found = free_run(shape, k + 1);
    ASSERT_TRUE(found.unknown_turns.empty());
    std::vector<double> row;
    for (const std::size_t lag : lags) append(row, found.groups.front(), lag);
    rows.row(static_cast<Eigen::Index>(k)) = Eigen::Map<Eigen::RowVectorXd>(row.data(), width);
  }
  // False-alarm rate 1 per mille; the seeds are the first ones.
  EXPECT_GT(probability(rows, Eigen::Map<Eigen::VectorXd>(expected.data(), width)), 1e-3);
  // The test sees an error of one per cent of everything.
  EXPECT_LT(probability(rows, 1.01 * Eigen::Map<Eigen::VectorXd>(expected.data(), width)), 1e-3);
}

std::string name_of(const testing::TestParamInfo<Vec3>& parameter) {
  const char* names[] = {"Spheres", "Prolates", "Oblates"};
  return names[parameter.index];
}

INSTANTIATE_TEST_SUITE_P(Bodies, FreeSolids,
                         testing::Values(Vec3(1, 1, 1), prolate(2).semi_axes,
                                         Vec3(std::cbrt(4.0), std::cbrt(4.0), std::cbrt(1 / 16.0))),
                         name_of);

}  // namespace
}  // namespace vitrel

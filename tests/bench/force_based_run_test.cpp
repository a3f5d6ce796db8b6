#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "bench/baselines/clusterwise_run.h"
#include "bench/baselines/force_based_run.h"
#include "edmd/soft/viscoelastic.h"
#include "tests/support/runs.h"
#include "tests/support/soft_particles.h"

namespace vitrel {
namespace {

constexpr double end = 1;

Configuration3 gas() {
  Configuration3 c = cubic_lattice(6, simple_cubic, 0.02, Ellipsoid{Vec3::Constant(0.1)});
  set_in_motion(c, 3);
  return c;
}

/// The same of three sizes, as disks.
Configuration2 gas_of_disks() {
  Configuration2 c = square_lattice(14, 0.05, 0, [](std::size_t i) {
    const double radius = std::array{0.1, 0.08, 0.05}[i % 3];
    return Ellipse{radius, radius};
  });
  set_in_motion(c, 4);
  return c;
}

DynamicsOptions soft(const Viscoelastic& force) {
  DynamicsOptions options;
  options.engine.soft_contact = integrated_contact(force);
  return options;
}

Configuration3 force_based(const Viscoelastic& force, std::uint64_t steps) {
  bench::ForceBasedRun<3, Viscoelastic> run(gas(), force);
  run.advance(end, steps);
  return run.state();
}

/// Distances of particles in two states in ascending order, those in contact left out.
template <int Dim>
std::vector<double> differences(const Configuration<Dim>& one, const Configuration<Dim>& two) {
  std::set<std::size_t> in_contact;
  for (const Release<Dim>& release : one.releases) in_contact.insert(release.particle);
  std::vector<double> values;
  for (std::size_t i = 0; i < one.size(); ++i)
    if (!in_contact.contains(i)) values.push_back((one.unwrapped(i) - two.unwrapped(i)).norm());
  std::ranges::sort(values);
  return values;
}

double quantile(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

// In a thin gas few contacts meet a third particle; all others end as the force has it. The difference is that
// of the force-based run: with the step h it falls as h², with damping, which begins like √t, as h^(3/2). The
// classical rule, with about the same loss, is off by a particle's radius and more.
TEST(ForceBasedRun, HasTheTrajectoriesOfTheMatrixOfRestitution) {
  for (const double dissipative_time : {0.0, 2e-4}) {
    SCOPED_TRACE(dissipative_time);
    const Viscoelastic force{1e8, 0.4, dissipative_time};
    const RunState3 state = run_until(gas(), end, soft(force));
    const Configuration3 coarse = force_based(force, 20'000), fine = force_based(force, 40'000);
    const auto of_coarse = differences(state.configuration, coarse);
    const auto of_fine = differences(state.configuration, fine);
    const DynamicsOptions hard = with_laws(dissipative_time > 0 ? 0.9 : 1);
    const auto of_hard = differences(run_until(gas(), end, hard).configuration, fine);
    EXPECT_GT(state.counters.collisions, 150u);
    const double of_half_the_step = std::pow(0.5, dissipative_time > 0 ? 1.5 : 2);
    for (const double share : {0.5, 0.7})
      EXPECT_NEAR(quantile(of_fine, share) / quantile(of_coarse, share), of_half_the_step, 0.17);
    EXPECT_LT(quantile(of_fine, 0.5), 1e-4);
    EXPECT_LT(quantile(of_fine, 0.9), 1e-2);
    EXPECT_GT(quantile(of_hard, 0.5), 0.1);
  }
}

template <int Dim>
void expect_trajectories_of_the_reference(const Configuration<Dim>& start) {
  const Viscoelastic force{1e8, 0.4, 2e-4};
  const RunState<Dim> state = run_until(start, end, soft(force));
  EXPECT_GT(state.counters.collisions, start.size() / 3);
  bench::ClusterwiseRun<Dim, Viscoelastic> run(start, force, 1e-13, 2e-4);
  run.advance(end);
  const auto off = differences(state.configuration, run.state());
  EXPECT_LT(quantile(off, 0.5), 1e-9);
  EXPECT_LT(quantile(off, 0.8), 1e-6);
}

// But for contacts of three the event-driven run is exact, and so is the reference.
TEST(ClusterwiseRun, HasTheTrajectoriesOfTheMatrixOfRestitution) {
  expect_trajectories_of_the_reference(gas());
}
TEST(ClusterwiseRun, HasThemForDisksOfUnlikeSize) {
  expect_trajectories_of_the_reference(gas_of_disks());
}

}  // namespace
}  // namespace vitrel

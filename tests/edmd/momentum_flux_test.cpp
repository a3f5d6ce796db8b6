#include "edmd/momentum_flux.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/conserved.h"
#include "tests/support/equal_bodies.h"
#include "tests/support/motion.h"
#include "tests/support/runs.h"

namespace vitrel {
namespace {

template <int Dim>
ShearElements first_moments(const Configuration<Dim>& c) {
  ShearElements sums{};
  for (std::size_t i = 0; i < c.size(); ++i)
    for (std::size_t k = 0; k < shear_elements<Dim>; ++k)
      sums[k] += c.mass[i] * shear_element<Dim>(k, c.velocity[i], c.unwrapped(i));
  return sums;
}

/// If nothing meets its images, ΔG_ab = Δ Σ m (v_a r_b + v_b r_a)/2, whatever the contacts.
template <int Dim>
void expect_change_of_first_moments(const Configuration<Dim>& scene) {
  const Configuration<Dim> start = in_an_open_box(scene);
  for (const ContactLaw& law : {ContactLaw{}, ContactLaw{0.9, 0.7, 0.3}}) {
    const RunState<Dim> end = run_until(start, 10, with_laws(law));
    EXPECT_GT(end.counters.collisions, 20u);
    const ShearElements before = first_moments(start), after = first_moments(end.configuration);
    for (std::size_t k = 0; k < shear_elements<Dim>; ++k) {
      EXPECT_GT(std::abs(after[k] - before[k]), 1e-3);
      EXPECT_NEAR(end.counters.helfand_moment[k], after[k] - before[k], 1e-9);
    }
    for (std::size_t k = shear_elements<Dim>; k < 3; ++k)
      EXPECT_EQ(end.counters.helfand_moment[k], 0);
  }
}

TEST(MomentumFlux, IsTheChangeOfFirstMomentsInAnOpenBox) {
  const auto plane = [](auto shape) {
    expect_change_of_first_moments(moving(square_lattice(10, 0.3, 0.8, shape)));
  };
  const auto space = [](auto shape) {
    expect_change_of_first_moments(moving(cubic_lattice(5, 0.1, shape)));
  };
  plane([](std::size_t i) { return i % 2 ? Ellipse{1, 1} : Ellipse{2, 2}; });
  plane([](std::size_t i) { return of_aspect_ratio(i % 2 ? 2 : 1); });
  space(Ellipsoid{Vec3::Ones()});
  space([](std::size_t i) { return i % 2 ? prolate(2) : oblate(2); });
  space(Ellipsoid{{1.6, 1, 0.7}});
}

// Rounding grows with every collision, so the time is short.
TEST(MomentumFlux, DoesNotDependOnWhereTheBoundariesAre) {
  const Configuration3 start =
      moving(cubic_lattice(4, 0.1, [](std::size_t i) { return i % 2 ? prolate(2) : oblate(2); }));
  Configuration3 shifted = start;
  for (Vec3& position : shifted.position) position += 0.37 * start.box.lengths();
  const RunState3 one = run_until(start, 5), other = run_until(shifted, 5);
  EXPECT_EQ(one.counters.collisions, other.counters.collisions);
  EXPECT_GT(one.counters.collisions, 50u);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(one.counters.helfand_moment[k], other.counters.helfand_moment[k], 1e-6);
}

/// Adds up Σ m v_x v_y of the frames, which held since the frame before where nothing collides.
struct FreeFlux : Observer<2> {
  void observe(const Frame<2>& frame) override {
    const Configuration2& now = frame.configuration;
    double flux = 0;
    for (std::size_t i = 0; i < now.size(); ++i) flux += now.mass[i] * now.velocity[i].prod();
    moment += flux * (now.time - time);
    time = now.time;
    EXPECT_NEAR(frame.tally.helfand_moment[0], moment, 1e-11);
  }
  double time = 0, moment = 0;
};

// Brownian particles do not meet here: velocities are drawn anew at times 1, 2 …, just after the frames of these
// times.
TEST(MomentumFlux, FollowsTheVelocitiesThatAreDrawn) {
  const Configuration2 start = moving(lattice_of_disks(2, 1e-9));
  FreeFlux flux;
  RunState2 state = begin_run(start, 0);
  run(state, brownian(1), {linear_times(0.25, 20), 20, &flux, {}}, {});
  EXPECT_EQ(state.counters.collisions, 0u);
  EXPECT_GT(std::abs(flux.moment), 0.1);
}

}  // namespace
}  // namespace vitrel

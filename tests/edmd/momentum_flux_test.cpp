#include "edmd/momentum_flux.h"

#include <gtest/gtest.h>

#include <cmath>

#include "edmd/run.h"
#include "edmd/sampling.h"
#include "tests/support/motion.h"
#include "tests/support/scenes.h"
#include "tests/support/solids.h"

namespace vitrel {
namespace {

template <int Dim>
RunState<Dim> run_until(const Configuration<Dim>& start, double end, const ContactLaw& law) {
  RunState<Dim> state = begin_run(start, 0);
  DynamicsOptions options;
  options.engine.laws = law;
  run(state, options, {{}, end, nullptr, {}}, {});
  return state;
}

template <int Dim>
ShearElements first_moments(const Configuration<Dim>& c) {
  ShearElements sums{};
  for (std::size_t i = 0; i < c.size(); ++i)
    for (std::size_t k = 0; k < shear_elements<Dim>; ++k)
      sums[k] += c.mass[i] * shear_element<Dim>(k, c.velocity[i], c.unwrapped(i));
  return sums;
}

/// In a box so wide that nothing meets its images ΔG_ab = Δ Σ m (v_a r_b + v_b r_a)/2, whatever the contacts.
template <int Dim>
void expect_change_of_first_moments(Configuration<Dim> start, const ContactLaw& law) {
  start.box = PeriodicBox<Dim>(start.box.lengths() * 40);
  for (std::size_t i = 0; i < start.size(); ++i) start.velocity[i] -= 0.3 * start.position[i];
  const RunState<Dim> end = run_until(start, 10, law);
  EXPECT_GT(end.counters.collisions, 20u);
  const ShearElements before = first_moments(start), after = first_moments(end.configuration);
  for (std::size_t k = 0; k < shear_elements<Dim>; ++k) {
    EXPECT_GT(std::abs(after[k] - before[k]), 1e-3);
    EXPECT_NEAR(end.counters.helfand_moment[k], after[k] - before[k], 1e-9);
  }
  for (std::size_t k = shear_elements<Dim>; k < 3; ++k)
    EXPECT_EQ(end.counters.helfand_moment[k], 0);
}

template <int Dim>
void expect_of_all_laws(const Configuration<Dim>& start) {
  for (const ContactLaw& law : {ContactLaw{}, ContactLaw{0.9, 0.7, 0.3}})
    expect_change_of_first_moments(start, law);
}

TEST(MomentumFlux, IsTheChangeOfFirstMomentsInAnOpenBox) {
  const auto plane = [](auto shape) { return moving(square_lattice(10, 0.3, 0.8, shape)); };
  const auto space = [](auto shape) { return moving(cubic_lattice(5, 0.1, shape)); };
  expect_of_all_laws(plane([](std::size_t i) { return i % 2 ? Ellipse{1, 1} : Ellipse{2, 2}; }));
  expect_of_all_laws(plane([](std::size_t i) { return of_aspect_ratio(i % 2 ? 2 : 1); }));
  expect_of_all_laws(space([](std::size_t) { return Ellipsoid{Vec3::Ones()}; }));
  expect_of_all_laws(space([](std::size_t i) { return i % 2 ? prolate(2) : oblate(2); }));
  expect_of_all_laws(space([](std::size_t) { return Ellipsoid{{1.6, 1, 0.7}}; }));
}

// Rounding grows with every collision, so the time is short.
TEST(MomentumFlux, DoesNotDependOnWhereTheBoundariesAre) {
  const Configuration3 start =
      moving(cubic_lattice(4, 0.1, [](std::size_t i) { return i % 2 ? prolate(2) : oblate(2); }));
  Configuration3 shifted = start;
  for (Vec3& position : shifted.position) position += 0.37 * start.box.lengths();
  const RunState3 one = run_until(start, 5, {}), other = run_until(shifted, 5, {});
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
  const Configuration2 start = moving(square_lattice(2, 1e-9, 0, [](std::size_t) {
    return Ellipse{1, 1};
  }));
  DynamicsOptions options;
  options.brownian = true;
  options.brownian_step = 1;
  FreeFlux flux;
  RunState2 state = begin_run(start, 0);
  run(state, options, {linear_times(0.25, 20), 20, &flux, {}}, {});
  EXPECT_EQ(state.counters.collisions, 0u);
  EXPECT_GT(std::abs(flux.moment), 0.1);
}

}  // namespace
}  // namespace vitrel

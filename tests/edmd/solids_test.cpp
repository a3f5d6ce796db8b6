// The engine in three dimensions.

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "core/geometry/free_flight.h"
#include "core/state/check.h"
#include "edmd/growth.h"
#include "edmd/instances/instances.h"
#include "tests/support/conserved.h"
#include "tests/support/equal_bodies.h"
#include "tests/support/runs.h"
#include "tests/support/same_motion.h"
#include "tests/support/same_state.h"

namespace vitrel {
namespace {

Ellipsoid ball(double radius) {
  return {Vec3::Constant(radius)};
}

Configuration3 spheres() {
  return moving(cubic_lattice(5, 0.3, [](std::size_t i) { return ball(i % 3 ? 1 : 1.1); }));
}
Configuration3 spheroids() {
  return moving(
      cubic_lattice(5, 0.15, [](std::size_t i) { return i % 2 ? prolate(2) : oblate(2); }));
}
Configuration3 scalene() {
  return moving(cubic_lattice(5, 0.15, Ellipsoid{{1.25, 1, 0.8}}));
}

// ---- The law of collision ----

struct TwoBodies {
  MovingBody<3> one, two;
  ContactGeometry<3> contact;

  Conserved<3> sums() const { return {one, two}; }
  double speed() const { return approach_speed(one.motion, two.motion, contact); }
  Impact collide(double restitution) {
    return vitrel::collide(one.motion, one.inertia, two.motion, two.inertia, contact, restitution);
  }
};

TwoBodies random_contact(Stream& draw, double growth) {
  TwoBodies b;
  const Ellipsoid shape1 = random_ellipsoid(draw, 4), shape2 = random_ellipsoid(draw, 4);
  b.one.pose = {3 * random_direction(draw), random_orientation(draw)};
  b.two.pose = {3 * random_direction(draw), random_orientation(draw)};
  b.one.inertia = in_space(inertia_of(shape1, 1.3), b.one.pose, 1);
  b.two.inertia = in_space(inertia_of(shape2, 0.7), b.two.pose, 1);
  b.one.motion = {random_direction(draw), random_direction(draw)};
  b.two.motion = {random_direction(draw), random_direction(draw)};
  const Vec3 point = random_direction(draw);
  const Vec3 n = random_direction(draw);
  b.contact = {n, (point - b.one.pose.position).cross(n), (point - b.two.pose.position).cross(n),
               growth};
  return b;
}

TEST(CollisionOfSolids, ConservesMomentumAngularMomentumAndEnergy) {
  Stream draw(1, Purpose::tests);
  for (int k = 0; k < 100; ++k) {
    TwoBodies b = random_contact(draw, 0);
    const Conserved<3> before = b.sums();
    const double speed = b.speed();
    b.collide(1);
    EXPECT_NEAR((b.sums().momentum - before.momentum).norm(), 0, 1e-13);
    EXPECT_NEAR((b.sums().angular_momentum - before.angular_momentum).norm(), 0, 1e-12);
    EXPECT_NEAR(b.sums().energy, before.energy, 1e-12);
    EXPECT_NEAR(b.speed(), -speed, 1e-12);
  }
}

TEST(CollisionOfSolids, TheImpulseDoesTheWorkOfGrowthAndRestitution) {
  Stream draw(2, Purpose::tests);
  for (int k = 0; k < 100; ++k) {
    const double growth = draw.uniform(0, 1), restitution = draw.uniform(0, 1);
    TwoBodies b = random_contact(draw, growth);
    const double before = b.sums().energy, speed = b.speed();
    const double impulse = b.collide(restitution).impulse;
    const double gained = impulse * (growth - 0.5 * speed * (1 - restitution));
    EXPECT_NEAR(b.sums().energy - before, gained, 1e-12);
  }
}

TEST(CollisionOfSolids, WithTheOwnImageReversesTheApproach) {
  Stream draw(3, Purpose::tests);
  for (int k = 0; k < 100; ++k) {
    const double growth = draw.uniform(0, 1);
    const TwoBodies b = random_contact(draw, growth);
    Motion3 motion = b.one.motion;
    const double speed = approach_speed(motion, motion, b.contact);
    collide_with_own_image(motion, b.one.inertia, b.contact, 0.7);
    EXPECT_EQ(motion.velocity, b.one.motion.velocity);
    EXPECT_NEAR(approach_speed(motion, motion, b.contact), -0.7 * speed, 1e-12);
  }
}

// ---- Models ----

TEST(ModelsOfSolids, SpheresMoveAsRoundEllipsoids) {
  expect_same_motion(spheres(), *make_sphere_engine({}), *make_ellipsoid_engine({}));
}

TEST(ModelsOfSolids, SpheresMoveAsThoseThatDoNotGrow) {
  expect_same_motion(spheres(), *make_sphere_engine({}), *make_growing_sphere_engine({}));
}

TEST(ModelsOfSolids, SpheresWithCellsMoveAsThoseWithLists) {
  EngineOptions cells, lists;
  cells.neighbors = NeighborSearch::cells;
  lists.neighbors = NeighborSearch::lists;
  expect_same_motion(spheres(), *make_sphere_engine(cells), *make_sphere_engine(lists));
}

TEST(ModelsOfSolids, EllipsoidsMoveAsThoseThatDoNotGrow) {
  expect_same_motion(spheroids(), *make_ellipsoid_engine({}), *make_growing_ellipsoid_engine({}));
  expect_same_motion(scalene(), *make_ellipsoid_engine({}), *make_growing_ellipsoid_engine({}));
}

// Bodies whose moments are equal tumble about a constant angular velocity.
TEST(ModelsOfSolids, SpheroidsMoveAsThoseThatCouldTumble) {
  expect_same_motion(spheroids(), *make_ellipsoid_engine({}), *make_tumbling_ellipsoid_engine({}));
}

TEST(ModelsOfSolids, GrowingSpheresMoveAsGrowingRoundEllipsoids) {
  EngineOptions growing;
  growing.growth_rate = 0.02;
  expect_same_motion(spheres(), *make_growing_sphere_engine(growing),
                     *make_growing_ellipsoid_engine(growing));
}

TEST(ModelsOfSolids, TheSimplestThatHoldsIsMade) {
  EngineOptions growing;
  growing.growth_rate = 0.01;
  EngineOptions constant;
  constant.rotation = FreeRotation::constant;
  const auto made = [](const Configuration3& scene, const EngineOptions& options) {
    return make_engine(scene, options)->description();
  };
  EXPECT_EQ(made(spheres(), {}), make_sphere_engine({})->description());
  EXPECT_EQ(made(spheroids(), {}), make_ellipsoid_engine({})->description());
  EXPECT_EQ(made(scalene(), {}), make_tumbling_ellipsoid_engine({})->description());
  EXPECT_EQ(made(scalene(), constant), make_ellipsoid_engine({})->description());
  EXPECT_EQ(made(spheres(), growing), make_growing_sphere_engine(growing)->description());
  EXPECT_EQ(made(spheroids(), growing), make_growing_ellipsoid_engine(growing)->description());
}

// ---- Runs ----

TEST(SolidsInMotion, StayHardAndConserveEnergyAndMomentum) {
  for (const Configuration3& start : {spheres(), spheroids(), scalene()}) {
    const RunState3 end = run_until(start, 20);
    EXPECT_GT(end.counters.collisions, 5 * start.size());
    EXPECT_TRUE(exact_check(end.configuration).clean());
    EXPECT_LT(end.energy_drift, 1e-12);
    EXPECT_LT(end.largest_momentum, 1e-11);
    EXPECT_EQ(end.counters.correction_moves, 0u);
  }
}

// The angular momentum of all about the origin is conserved by flight and collisions; with constant angular velocities it
// is not.
TEST(SolidsInMotion, ConserveAngularMomentumIfTheyTumble) {
  const Configuration3 start = in_an_open_box(moving(cubic_lattice(3, 0.03, [](std::size_t i) {
    return i % 3 ? Ellipsoid{{2, 1, 0.5}} : prolate(2);
  })));
  const Vec3 before = angular_momentum(start);
  const RunState3 end = run_until(start, 15);
  EXPECT_GT(end.counters.collisions, 20u);
  EXPECT_LT((angular_momentum(end.configuration) - before).norm(), 1e-11);
  DynamicsOptions constant;
  constant.engine.rotation = FreeRotation::constant;
  EXPECT_GT((angular_momentum(run_until(start, 15, constant).configuration) - before).norm(), 0.1);
}

TEST(SolidsInMotion, SpheroidsNeverSpinAboutTheirAxes) {
  const RunState3 end = run_until(spheroids(), 20);
  const Configuration3& c = end.configuration;
  for (std::size_t i = 0; i < c.size(); ++i) {
    const Vec3 axis = c.orientation[i] * Vec3::Unit(c.shape[i].symmetry_axis());
    EXPECT_NEAR(axis.dot(c.angular_velocity[i]), 0, 1e-11);
  }
}

// All energy put into translation goes over into rotation: 3 (N − 1) to 2 N or 3 N degrees of freedom.
TEST(SolidsInMotion, ShareTheirEnergyEvenly) {
  struct Case {
    Ellipsoid shape;
    double rotations;
  };
  for (const Case& of : {Case{prolate(2), 2}, Case{oblate(2), 2}, Case{{{1.4, 1, 0.7}}, 3}}) {
    Configuration3 start = cubic_lattice(6, 0.1, of.shape);
    set_initial_velocities(start, 5, InitialVelocities::translation, Temperature::relative);
    double rotation = 0, translation = 0;
    for (const Configuration3& frame : recorded_run(start, -60, linear_times(1, 99), 100).frames) {
      rotation += mechanics(frame).rotational_energy;
      translation += mechanics(frame).translational_energy;
    }
    const double n = static_cast<double>(start.size());
    const double wanted = of.rotations * n / (3 * (n - 1));
    // Fluctuations of the ratio per sample: √(2/f) of some 600 degrees of freedom each; samples hardly
    // depend on each other.
    EXPECT_NEAR(rotation / translation, wanted, 4 * wanted * std::sqrt(4 / (3 * n) / 60));
  }
}

// A rod longer than the box meets other images of another, and its own.
TEST(SolidsInMotion, StayHardInABoxShorterThanAParticle) {
  Configuration3 start = cubic_lattice(2, 0.01, prolate(10));
  GrowthOptions options;
  options.growth_rate = 0.1;
  options.packing_fraction = 0.25;
  // From small: the lattice leaves no room for the whole rods.
  start.box = PeriodicBox<3>(start.box.lengths() * 4);
  for (Vec3& r : start.position) r *= 4;
  GrowthState state;
  const StageReport report = grow(start, options, state, {});
  EXPECT_EQ(report.end, StageEnd::reached) << report.reason;
  EXPECT_NEAR(packing_fraction(start), 0.25, 1e-12);
  EXPECT_LT(start.box.lengths()[0], 2 * start.shape[0].circumradius());
  EXPECT_TRUE(exact_check(start).clean());
  const RunState3 end = run_until(moving(start, 3), 20);
  EXPECT_TRUE(exact_check(end.configuration).clean());
  EXPECT_LT(end.energy_drift, 1e-12);
}

TEST(SolidsInMotion, GoOnBitByBitFromABlockEnd) {
  const Configuration3 start = spheroids();
  constexpr double end = 100;
  std::optional<RunState3> half;
  RunPlan3 plan{{}, end, nullptr, [&](const RunState3& state) {
                  if (!half) half = state;
                }};
  RunState3 whole = begin_run(start, 0.);
  run(whole, {}, plan, {});
  ASSERT_TRUE(half && half->configuration.time < end);
  run(*half, {}, plan, {});
  EXPECT_EQ(half->counters.collisions, whole.counters.collisions);
  expect_same_state(half->configuration, whole.configuration);
}

// Free Brownian spheres: MSD(n τ_B) = 3 n τ_B² kT/m, and the collisions of dilute ones change little.
TEST(SolidsInMotion, DiffuseFreely) {
  const Configuration3 start = moving(cubic_lattice(10, 1e-6, ball(1)));
  const RunState3 end = run_until(start, 20, brownian(0.1));
  double sum = 0;
  for (std::size_t i = 0; i < start.size(); ++i)
    sum += (end.configuration.unwrapped(i) - start.unwrapped(i)).squaredNorm();
  const double n = static_cast<double>(start.size()), wanted = 3 * 200 * 0.01;
  EXPECT_NEAR(sum / n, wanted, 4 * wanted * std::sqrt(2 / (3 * n)));
}

// ---- Growth ----

TEST(GrowthOfSolids, ReachesThePackingFractionReproducibly) {
  GrowthOptions options;
  options.growth_rate = 0.05;
  options.packing_fraction = 0.5;
  for (const Ellipsoid& shape : {ball(1), prolate(2), oblate(2), Ellipsoid{{1.25, 1, 0.8}}}) {
    Configuration3 one = cubic_lattice(4, 0.05, shape), two = one;
    GrowthState state1, state2;
    EXPECT_EQ(grow(one, options, state1, {}).end, StageEnd::reached);
    EXPECT_EQ(grow(two, options, state2, {}).end, StageEnd::reached);
    EXPECT_NEAR(packing_fraction(one), 0.5, 1e-12);
    EXPECT_TRUE(exact_check(one).clean());
    expect_same_state(one, two);
    EXPECT_EQ(state1.counters.collisions, state2.counters.collisions);
  }
}

// Fast growth jams spheres at random: between the loose and the close packing.
TEST(GrowthOfSolids, JamsSpheresAtRandom) {
  GrowthOptions options;
  options.growth_rate = 0.03;
  options.reduced_pressure = 1e6;
  Configuration3 c = cubic_lattice(6, 0.02, ball(1));
  GrowthState state;
  EXPECT_EQ(grow(c, options, state, {}).end, StageEnd::reached);
  EXPECT_GT(packing_fraction(c), 0.62);
  EXPECT_LT(packing_fraction(c), 0.66);
  EXPECT_TRUE(exact_check(c).clean());
}

}  // namespace
}  // namespace vitrel

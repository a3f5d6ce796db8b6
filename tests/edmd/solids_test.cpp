// The engine in three dimensions.

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "core/geometry/free_flight.h"
#include "core/state/check.h"
#include "edmd/collision_rule.h"
#include "edmd/growth.h"
#include "edmd/instances/instances.h"
#include "edmd/run.h"
#include "tests/support/motion.h"
#include "tests/support/solids.h"

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
  return moving(cubic_lattice(5, 0.15, [](std::size_t) { return Ellipsoid{{1.25, 1, 0.8}}; }));
}

// ---- The law of collision ----

struct TwoBodies {
  Motion3 one, two;
  Inertia<3> inertia1, inertia2;
  Pose3 pose1, pose2;
  Vec3 point;
  ContactGeometry<3> contact;

  Vec3 momentum() const {
    return one.velocity / inertia1.inverse_mass + two.velocity / inertia2.inverse_mass;
  }
  Vec3 angular_momentum() const {
    const auto of = [](const Motion3& m, const Inertia<3>& i, const Pose3& p) -> Vec3 {
      return p.position.cross(m.velocity) / i.inverse_mass +
             i.inverse_moment.inverse() * m.angular_velocity;
    };
    return of(one, inertia1, pose1) + of(two, inertia2, pose2);
  }
  double energy() const {
    const auto of = [](const Motion3& m, const Inertia<3>& i) {
      return 0.5 * m.velocity.squaredNorm() / i.inverse_mass +
             0.5 * m.angular_velocity.dot(i.inverse_moment.inverse() * m.angular_velocity);
    };
    return of(one, inertia1) + of(two, inertia2);
  }
};

TwoBodies random_contact(Stream& draw, double growth) {
  TwoBodies b;
  const Ellipsoid shape1 = random_ellipsoid(draw, 4), shape2 = random_ellipsoid(draw, 4);
  b.pose1 = {3 * random_direction(draw), random_orientation(draw)};
  b.pose2 = {3 * random_direction(draw), random_orientation(draw)};
  b.inertia1 = in_space(inertia_of(shape1, 1.3), b.pose1, 1);
  b.inertia2 = in_space(inertia_of(shape2, 0.7), b.pose2, 1);
  b.one = {random_direction(draw), random_direction(draw)};
  b.two = {random_direction(draw), random_direction(draw)};
  b.point = random_direction(draw);
  const Vec3 n = random_direction(draw);
  b.contact = {n, (b.point - b.pose1.position).cross(n), (b.point - b.pose2.position).cross(n),
               growth};
  return b;
}

TEST(CollisionOfSolids, ConservesMomentumAngularMomentumAndEnergy) {
  Stream draw(1, Purpose::tests);
  for (int k = 0; k < 100; ++k) {
    TwoBodies b = random_contact(draw, 0);
    const TwoBodies before = b;
    const double speed = approach_speed(b.one, b.two, b.contact);
    collide(b.one, b.inertia1, b.two, b.inertia2, b.contact, 1);
    EXPECT_NEAR((b.momentum() - before.momentum()).norm(), 0, 1e-13);
    EXPECT_NEAR((b.angular_momentum() - before.angular_momentum()).norm(), 0, 1e-12);
    EXPECT_NEAR(b.energy(), before.energy(), 1e-12);
    EXPECT_NEAR(approach_speed(b.one, b.two, b.contact), -speed, 1e-12);
  }
}

TEST(CollisionOfSolids, TheImpulseDoesTheWorkOfGrowthAndRestitution) {
  Stream draw(2, Purpose::tests);
  for (int k = 0; k < 100; ++k) {
    const double growth = draw.uniform(0, 1), restitution = draw.uniform(0, 1);
    TwoBodies b = random_contact(draw, growth);
    const double before = b.energy(), speed = approach_speed(b.one, b.two, b.contact);
    const double impulse =
        collide(b.one, b.inertia1, b.two, b.inertia2, b.contact, restitution).impulse;
    EXPECT_NEAR(b.energy() - before, impulse * (growth - 0.5 * speed * (1 - restitution)), 1e-12);
  }
}

TEST(CollisionOfSolids, WithTheOwnImageReversesTheApproach) {
  Stream draw(3, Purpose::tests);
  for (int k = 0; k < 100; ++k) {
    const double growth = draw.uniform(0, 1);
    TwoBodies b = random_contact(draw, growth);
    const Vec3 velocity = b.one.velocity;
    const double speed = approach_speed(b.one, b.one, b.contact);
    collide_with_own_image(b.one, b.inertia1, b.contact, 0.7);
    EXPECT_EQ(b.one.velocity, velocity);
    EXPECT_NEAR(approach_speed(b.one, b.one, b.contact), -0.7 * speed, 1e-12);
  }
}

// ---- Models ----

// As for ellipses (engine_models_test.cpp).
void expect_same_motion(const Configuration3& start, Engine3& simple, Engine3& general) {
  RunCounters of_simple, of_general;
  Configuration3 one = start, two = start;
  simple.load(one);
  general.load(two);
  const double wanted = 5.0 * static_cast<double>(start.size());
  for (double until = 0.02; static_cast<double>(of_simple.collisions) < wanted; until += 0.02) {
    advance(simple, one, until, of_simple);
    advance(general, two, until, of_general);
    ASSERT_EQ(of_simple.collisions, of_general.collisions) << "up to " << until;
    ASSERT_LT(difference(one, two), 1e-5) << "at " << until;
  }
  EXPECT_NEAR(of_general.virial, of_simple.virial, 1e-6 * of_simple.virial);
}

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
  EXPECT_EQ(make_engine(spheres(), {})->description(), make_sphere_engine({})->description());
  EXPECT_EQ(make_engine(spheroids(), {})->description(), make_ellipsoid_engine({})->description());
  EngineOptions constant;
  constant.rotation = FreeRotation::constant;
  EXPECT_EQ(make_engine(scalene(), {})->description(),
            make_tumbling_ellipsoid_engine({})->description());
  EXPECT_EQ(make_engine(scalene(), constant)->description(),
            make_ellipsoid_engine({})->description());
  EXPECT_EQ(make_engine(spheres(), growing)->description(),
            make_growing_sphere_engine(growing)->description());
  EXPECT_EQ(make_engine(spheroids(), growing)->description(),
            make_growing_ellipsoid_engine(growing)->description());
}

// ---- Runs ----

RunState3 run_for(const Configuration3& start, double duration,
                  const DynamicsOptions& options = {}) {
  RunState3 state = begin_run(start, 0.);
  run(state, options, {{}, duration, nullptr, {}}, {});
  return state;
}

TEST(SolidsInMotion, StayHardAndConserveEnergyAndMomentum) {
  for (const Configuration3& start : {spheres(), spheroids(), scalene()}) {
    const RunState3 end = run_for(start, 20);
    EXPECT_GT(end.counters.collisions, 5 * start.size());
    EXPECT_TRUE(exact_check(end.configuration).clean());
    EXPECT_LT(end.energy_drift, 1e-12);
    EXPECT_LT(end.largest_momentum, 1e-11);
    EXPECT_EQ(end.counters.correction_moves, 0u);
  }
}

// In a box so wide that nothing meets its images, the angular momentum of all about the origin is conserved by flight
// and collisions; with constant angular velocities it is not.
TEST(SolidsInMotion, ConserveAngularMomentumIfTheyTumble) {
  Configuration3 start = moving(cubic_lattice(3, 0.03, [](std::size_t i) {
    return i % 3 ? Ellipsoid{{2, 1, 0.5}} : prolate(2);
  }));
  start.box = PeriodicBox<3>(start.box.lengths() * 40);
  for (std::size_t i = 0; i < start.size(); ++i) start.velocity[i] -= 0.3 * start.position[i];
  const auto angular_momentum = [](const Configuration3& c) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < c.size(); ++i) {
      const Quaternion& q = c.orientation[i];
      const Vec3 spin = q * c.inertia(i).cwiseProduct(q.conjugate() * c.angular_velocity[i]);
      sum += c.mass[i] * c.position[i].cross(c.velocity[i]) + spin;
    }
    return sum;
  };
  const Vec3 before = angular_momentum(start);
  const RunState3 end = run_for(start, 15);
  EXPECT_GT(end.counters.collisions, 20u);
  EXPECT_LT((angular_momentum(end.configuration) - before).norm(), 1e-11);
  DynamicsOptions constant;
  constant.engine.rotation = FreeRotation::constant;
  EXPECT_GT((angular_momentum(run_for(start, 15, constant).configuration) - before).norm(), 0.1);
}

TEST(SolidsInMotion, SpheroidsNeverSpinAboutTheirAxes) {
  const RunState3 end = run_for(spheroids(), 20);
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
    Configuration3 start = cubic_lattice(6, 0.1, [&](std::size_t) { return of.shape; });
    set_initial_velocities(start, 5, InitialVelocities::translation, Temperature::relative);
    RunState3 state = begin_run(start, -60.);
    double rotation = 0, translation = 0;
    struct Sum : Observer<3> {
      double &rotation, &translation;
      Sum(double& r, double& t) : rotation(r), translation(t) {}
      void observe(const Frame<3>& frame) override {
        const auto sums = mechanics(frame.configuration);
        rotation += sums.rotational_energy;
        translation += sums.translational_energy;
      }
    } sum(rotation, translation);
    run(state, {}, {linear_times(1, 99), 100, &sum, {}}, {});
    const double n = static_cast<double>(start.size());
    const double wanted = of.rotations * n / (3 * (n - 1));
    // Fluctuations of the ratio per sample: √(2/f) of some 600 degrees of freedom each; samples hardly
    // depend on each other.
    EXPECT_NEAR(rotation / translation, wanted, 4 * wanted * std::sqrt(4 / (3 * n) / 60));
  }
}

// A rod longer than the box meets other images of another, and its own.
TEST(SolidsInMotion, StayHardInABoxShorterThanAParticle) {
  Configuration3 start = cubic_lattice(2, 0.01, [](std::size_t) { return prolate(10); });
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
  const RunState3 end = run_for(moving(start, 3), 20);
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
  for (std::size_t i = 0; i < start.size(); ++i) {
    EXPECT_EQ(half->configuration.position[i], whole.configuration.position[i]);
    EXPECT_EQ(half->configuration.orientation[i].coeffs(),
              whole.configuration.orientation[i].coeffs());
  }
}

// Free Brownian spheres: MSD(n τ_B) = 3 n τ_B² kT/m, and the collisions of dilute ones change little.
TEST(SolidsInMotion, DiffuseFreely) {
  Configuration3 start = moving(cubic_lattice(10, 1e-6, [](std::size_t) { return ball(1); }));
  DynamicsOptions options;
  options.brownian = true;
  options.brownian_step = 0.1;
  const RunState3 end = run_for(start, 20, options);
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
    Configuration3 one = cubic_lattice(4, 0.05, [&](std::size_t) { return shape; }), two = one;
    GrowthState state1, state2;
    EXPECT_EQ(grow(one, options, state1, {}).end, StageEnd::reached);
    EXPECT_EQ(grow(two, options, state2, {}).end, StageEnd::reached);
    EXPECT_NEAR(packing_fraction(one), 0.5, 1e-12);
    EXPECT_TRUE(exact_check(one).clean());
    EXPECT_EQ(one.position, two.position);
    EXPECT_EQ(state1.counters.collisions, state2.counters.collisions);
  }
}

// Fast growth jams spheres at random: between the loose and the close packing.
TEST(GrowthOfSolids, JamsSpheresAtRandom) {
  GrowthOptions options;
  options.growth_rate = 0.03;
  options.reduced_pressure = 1e6;
  Configuration3 c = cubic_lattice(6, 0.02, [](std::size_t) { return ball(1); });
  GrowthState state;
  EXPECT_EQ(grow(c, options, state, {}).end, StageEnd::reached);
  EXPECT_GT(packing_fraction(c), 0.62);
  EXPECT_LT(packing_fraction(c), 0.66);
  EXPECT_TRUE(exact_check(c).clean());
}

}  // namespace
}  // namespace vitrel

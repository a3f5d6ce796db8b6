#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "core/io/checkpoint.h"
#include "core/random/stream.h"
#include "core/state/check.h"
#include "edmd/soft/linear_dashpot.h"
#include "edmd/soft/viscoelastic.h"
#include "tests/support/conserved.h"
#include "tests/support/runs.h"
#include "tests/support/same_state.h"
#include "tests/support/soft_particles.h"

namespace vitrel {
namespace {

template <ContactForce Force>
DynamicsOptions soft(const Force& force, EarlyRelease early_release = EarlyRelease::alone) {
  DynamicsOptions options;
  options.engine.soft_contact = integrated_contact(force);
  options.engine.early_release = early_release;
  return options;
}

/// Particles of these radii in a wide box.
template <int Dim>
Configuration<Dim> few(const std::vector<double>& radii, const std::vector<Vec<Dim>>& positions,
                       const std::vector<Vec<Dim>>& velocities) {
  Configuration<Dim> c;
  c.resize(radii.size());
  c.box = PeriodicBox<Dim>(Vec<Dim>::Constant(20));
  c.position = positions;
  c.velocity = velocities;
  for (std::size_t i = 0; i < c.size(); ++i) {
    c.shape[i] = round_shape<Dim>(radii[i]);
    c.mass[i] = sphere_mass(radii[i]);
  }
  return c;
}

template <int Dim>
Vec<Dim> vector(double x, double y) {
  Vec<Dim> v = Vec<Dim>::Zero();
  v[0] = x;
  v[1] = y;
  return v;
}

/// The state at the end, in which nothing overlaps that should not.
template <int Dim>
RunState<Dim> checked_run(const Configuration<Dim>& start, double end,
                          const DynamicsOptions& options) {
  RunState<Dim> state = run_until(start, end, options);
  EXPECT_TRUE(exact_check(state.configuration).clean());
  return state;
}

template <int Dim>
double energy(const Configuration<Dim>& c) {
  return mechanics(c).translational_energy;
}

/// The equations of motion as they stand, from first contact on: fixed steps of Runge and Kutta's.
template <int Dim, class Force>
void integrate(Configuration<Dim>& c, const Force& force, double duration, int steps) {
  const double radius1 = c.shape[0].circumradius(), radius2 = c.shape[1].circumradius();
  const ContactPair pair = contact_pair(radius1, c.mass[0], radius2, c.mass[1]);
  using State = std::array<Vec<Dim>, 4>;
  const auto slope = [&](const State& x) {
    const Vec<Dim> d = x[1] - x[0];
    const double r = d.norm(), compression = pair.distance - r;
    const double rate = -d.dot(x[3] - x[2]) / r;
    constexpr double rounding = 1e-13;  // at the start
    double push = 0;
    if (compression > -rounding)
      push = std::max(0.0, force.force(std::max(compression, 0.0), rate, pair));
    const Vec<Dim> f = push / r * d;
    return State{x[2], x[3], -f / c.mass[0], f / c.mass[1]};
  };
  const auto plus = [](State x, double h, const State& s) {
    for (std::size_t k = 0; k < 4; ++k) x[k] += h * s[k];
    return x;
  };
  State x{c.position[0], c.position[1], c.velocity[0], c.velocity[1]};
  const double h = duration / steps;
  for (int step = 0; step < steps; ++step) {
    const State a = slope(x), b = slope(plus(x, h / 2, a)), p = slope(plus(x, h / 2, b)),
                q = slope(plus(x, h, p));
    x = plus(plus(plus(plus(x, h / 6, a), h / 3, b), h / 3, p), h / 6, q);
  }
  c.position = {x[0], x[1]};
  c.velocity = {x[2], x[3]};
}

/// Two particles that come together at an eccentricity, `time` before contact.
template <int Dim>
Configuration<Dim> colliding_pair(double radius1, double radius2, double speed, double eccentricity,
                                  double time) {
  const double distance = radius1 + radius2;
  const Vec<Dim> d =
      distance * vector<Dim>(eccentricity, std::sqrt(1 - eccentricity * eccentricity));
  const Vec<Dim> v1 = vector<Dim>(speed / 4, speed / 2), v2 = vector<Dim>(speed / 4, -speed / 2);
  return few<Dim>({radius1, radius2}, {-0.5 * d - time * v1, 0.5 * d - time * v2}, {v1, v2});
}

template <int Dim, ContactForce Force>
void expect_integrated_trajectory(const Force& force, double radius1, double radius2,
                                  double duration) {
  const double approach = 0.01;
  const Configuration<Dim> start = colliding_pair<Dim>(radius1, radius2, 5, 0.3, approach);
  const RunState<Dim> state = checked_run(start, approach + duration, soft(force));
  EXPECT_EQ(state.counters.collisions, 1u);
  EXPECT_TRUE(state.configuration.releases.empty());
  Configuration<Dim> direct = colliding_pair<Dim>(radius1, radius2, 5, 0.3, 0);
  integrate(direct, force, duration, 400'000);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT((state.configuration.unwrapped(i) - direct.position[i]).norm(), 1e-8);
    EXPECT_LT((state.configuration.velocity[i] - direct.velocity[i]).norm(), 1e-8);
  }
  EXPECT_NEAR(energy(state.configuration) + state.counters.dissipated, energy(start),
              1e-13 * energy(start));
}

// Figure 6 of mueller2013 and beyond: unlike radii, damped, viscoelastic, disks.
TEST(SoftPair, FliesOnAsIntegrated) {
  expect_integrated_trajectory<3>(LinearDashpot{2000}, 0.1, 0.1, 0.1);
  expect_integrated_trajectory<2>(LinearDashpot{2000}, 0.1, 0.1, 0.1);
  expect_integrated_trajectory<3>(LinearDashpot{2000, 30}, 0.1, 0.1, 0.1);
  expect_integrated_trajectory<3>(LinearDashpot{2000, 30}, 0.1, 0.17, 0.2);
  expect_integrated_trajectory<2>(Viscoelastic{1e6, 0.4, 1e-3}, 0.12, 0.1, 0.1);
}

// In contact a particle moves with the centre of mass, and counts with what it will be.
TEST(SoftPair, IsHandedOutInTheMiddleOfItsContact) {
  const Configuration2 start = colliding_pair<2>(0.1, 0.1, 5, 0.3, 0.01);
  const RunState2 state = run_until(start, 0.05, soft(LinearDashpot{2000, 30}));
  const Configuration2& c = state.configuration;
  ASSERT_EQ(c.releases.size(), 2u);
  EXPECT_EQ(c.releases[0].partner, 1u);
  EXPECT_EQ(c.releases[1].partner, 0u);
  EXPECT_EQ(c.releases[0].time, c.releases[1].time);
  EXPECT_EQ(c.velocity[0], c.velocity[1]);
  EXPECT_NEAR(energy(c) + state.counters.dissipated, energy(start), 1e-13 * energy(start));
  ASSERT_EQ(c.close_pairs.size(), 1u);
  EXPECT_TRUE(exact_check(c).clean());
  // The check knows this pair, and how close it may be.
  Configuration2 closer = c;
  closer.close_pairs[0].distance *= 1 + 1e-9;
  EXPECT_EQ(exact_check(closer).overlaps.size(), 1u);
  closer.close_pairs.clear();
  EXPECT_EQ(exact_check(closer).overlaps.size(), 1u);
}

/// The pair of figure 6 about to touch at the origin, and a third particle at rest. The pair will turn by
/// 1.72 rad in the 0.073 s of its contact; its second particle will then be at (0.09, −0.04).
Configuration2 pair_and_third(const Vec2& third) {
  const double eccentricity = 0.3, time = 0.001;
  const Vec2 d = 0.2 * Vec2(eccentricity, std::sqrt(1 - eccentricity * eccentricity));
  const Vec2 v1(1.25, 2.5), v2(1.25, -2.5);
  return few<2>({0.1, 0.1, 0.1}, {-0.5 * d - time * v1, 0.5 * d - time * v2, third},
                {v1, v2, Vec2::Zero()});
}

TEST(SoftException, NoRoomToTurnIsAHardCollision) {
  const Configuration2 start = pair_and_third({0.24, -0.02});
  const RunState2 state = checked_run(start, 0.0011, soft(LinearDashpot{2000}));
  EXPECT_EQ(state.counters.collisions, 1u);
  EXPECT_EQ(state.counters.blocked_rotations, 1u);
  const Vec2 n(0.3, std::sqrt(0.91));
  const Vec2 exchanged = 5 * n.y() * n;
  EXPECT_LT((state.configuration.velocity[0] - start.velocity[0] + exchanged).norm(), 1e-12);
  EXPECT_LT((state.configuration.velocity[1] - start.velocity[1] - exchanged).norm(), 1e-12);
  EXPECT_TRUE(state.configuration.releases.empty());
}

// With damping the hard collision has the same loss along the normal.
TEST(SoftException, TheHardCollisionHasTheSoftRestitution) {
  const Configuration2 start = pair_and_third({0.24, -0.02});
  const LinearDashpot force{2000, 30};
  const RunState2 state = run_until(start, 0.0011, soft(force));
  ASSERT_EQ(state.counters.blocked_rotations, 1u);
  const Vec2 n(0.3, std::sqrt(0.91));
  const double approach = 5 * n.y(), across = 5 * n.x();
  const ContactPair pair = contact_pair(0.1, start.mass[0], 0.1, start.mass[1]);
  const Restitution restitution =
      integrate_contact<LinearDashpot>(scaled_impact(force, pair, approach, across));
  const Vec2 v = state.configuration.velocity[1] - state.configuration.velocity[0];
  EXPECT_NEAR(v.dot(n), -restitution.rate * approach, 1e-9);
  EXPECT_NEAR(std::abs(cross(n, v)), across, 1e-12);
}

struct Interrupted {
  RunState2 state;
  double lost_momentum, lost_angular_momentum, lost_energy;  ///< relative
};

Interrupted interrupted_pair(EarlyRelease early_release) {
  const Configuration2 start = pair_and_third({0.33, -0.02});
  const RunState2 state = run_until(start, 0.5, soft(LinearDashpot{2000}, early_release));
  const Configuration2& c = state.configuration;
  EXPECT_TRUE(c.releases.empty());
  EXPECT_EQ(state.counters.early_releases, 1u);
  EXPECT_EQ(state.counters.collisions, 2u);
  EXPECT_EQ(state.counters.blocked_rotations, 0u);
  return {
      state,
      (mechanics(c).momentum - mechanics(start).momentum).norm() / mechanics(start).momentum.norm(),
      std::abs(angular_momentum(c) / angular_momentum(start) - 1),
      std::abs(energy(c) / energy(start) - 1)};
}

// The third particle comes after some 0.03 of the 0.073 s.
TEST(SoftException, APairThatIsHitIsReleased) {
  const Interrupted alone = interrupted_pair(EarlyRelease::alone);
  EXPECT_LT(alone.lost_momentum, 1e-14);
  EXPECT_LT(alone.lost_energy, 1e-14);
  EXPECT_GT(alone.lost_angular_momentum, 1e-3);
  const Interrupted together = interrupted_pair(EarlyRelease::together);
  EXPECT_LT(together.lost_momentum, 1e-14);
  EXPECT_LT(together.lost_energy, 1e-14);
  EXPECT_LT(together.lost_angular_momentum, 1e-13);
}

// A hot cluster in free space, which flies apart: only lone releases cost angular momentum, and little of it.
TEST(SoftException, OnlyLoneReleasesCostAngularMomentum) {
  std::vector<Vec2> positions, velocities;
  Stream draw(6, Purpose::tests);
  for (int k = 0; k < 64; ++k) {
    const int row = k / 8;
    positions.push_back({0.23 * (k % 8 - 3.5), 0.23 * (row - 3.5)});
    velocities.push_back({draw.normal(), draw.normal()});
  }
  const Configuration2 start = few<2>(std::vector<double>(64, 0.1), positions, velocities);
  double scale = 0;  // Σ m |r × v|
  for (std::size_t i = 0; i < start.size(); ++i)
    scale += start.mass[i] * std::abs(cross(start.position[i], start.velocity[i]));
  for (const EarlyRelease early : {EarlyRelease::alone, EarlyRelease::together}) {
    const RunState2 state = run_until(start, 2, soft(Viscoelastic{1e8, 0.4}, early));
    const Configuration2& c = state.configuration;
    EXPECT_TRUE(c.releases.empty());
    EXPECT_GT(state.counters.early_releases, 5u);
    EXPECT_GT(state.counters.blocked_rotations, 0u);
    const double lost = std::abs(angular_momentum(c) - angular_momentum(start)) / scale;
    if (early == EarlyRelease::alone)
      EXPECT_GT(lost, 1e-6);
    else
      EXPECT_LT(lost, 1e-14 * static_cast<double>(state.counters.collisions));
    EXPECT_LT(lost, 0.02);
    EXPECT_NEAR(energy(c) / energy(start), 1, 1e-13);
  }
}

// One of two particles just out of a damped contact, and still close, is driven back by a third.
TEST(SoftPair, MeetsAgainIfTurnedBackWhileClose) {
  Configuration2 start =
      few<2>({0.1, 0.1, 0.1}, {{0, 0}, {0.1999, 0}, {0.4, 0.01}}, {{0, 0}, {0.01, 0}, {-5, 0}});
  start.close_pairs = {{{0, 1, Shift<2>::Zero()}, 0.1998}};
  ASSERT_TRUE(exact_check(start).clean());
  const DynamicsOptions options = soft(LinearDashpot{1e8, 100});
  const RunState2 state = run_until(start, 0.01, options);
  EXPECT_GE(state.counters.collisions, 2u);
  EXPECT_LT(state.configuration.velocity[0].x(), -2);
  EXPECT_TRUE(state.configuration.close_pairs.empty());
  EXPECT_TRUE(exact_check(state.configuration).clean());
  EXPECT_NEAR((mechanics(state.configuration).momentum - mechanics(start).momentum).norm(), 0,
              1e-12);
  // Without this history the state is none of soft particles.
  start.close_pairs.clear();
  start.velocity[1].x() = -0.01;
  EXPECT_THROW(run_until(start, 0.01, options), InvariantError);
}

/// A gas of two sizes in three dimensions.
Configuration3 gas(int cells, double packing_fraction) {
  Configuration3 c =
      cubic_lattice(cells, simple_cubic, packing_fraction, Ellipsoid{Vec3::Constant(0.1)});
  for (std::size_t i = 0; i < c.size(); i += 3) c.shape[i] = round_shape<3>(0.07);
  set_in_motion(c, 8);
  const Vec3 drift = mechanics(c).momentum / static_cast<double>(c.size());
  for (std::size_t i = 0; i < c.size(); ++i) c.velocity[i] -= drift / c.mass[i];
  return c;
}

struct Watched {
  RunState3 state;
  std::size_t blocks = 0, releases = 0, close_pairs = 0;
};

/// Checks the end of every block, that of the run among them.
Watched watched_run(const Configuration3& start, double end, const DynamicsOptions& options) {
  Watched watched{begin_run(start, 0)};
  RunPlan3 plan;
  plan.end_time = end;
  plan.at_block_end = [&](const RunState3& state) {
    ++watched.blocks;
    watched.releases += state.configuration.releases.size();
    watched.close_pairs += state.configuration.close_pairs.size();
    EXPECT_TRUE(exact_check(state.configuration).clean());
  };
  run(watched.state, options, plan, {});
  plan.at_block_end(watched.state);
  return watched;
}

TEST(SoftGas, ElasticKeepsItsEnergyAndNoUnintendedOverlap) {
  const Configuration3 start = gas(8, 0.1);
  for (const EarlyRelease early : {EarlyRelease::alone, EarlyRelease::together}) {
    const Watched watched = watched_run(start, 16, soft(Viscoelastic{1e8, 0.4}, early));
    const RunState3& state = watched.state;
    EXPECT_GT(state.counters.collisions, 20'000u);
    EXPECT_GT(watched.blocks, 2u);
    EXPECT_GT(watched.releases, 0u);
    EXPECT_EQ(watched.close_pairs, 0u);
    EXPECT_GT(state.counters.blocked_rotations, 0u);
    EXPECT_GT(state.counters.early_releases, 0u);
    EXPECT_NEAR(energy(state.configuration) / energy(start), 1, 1e-12);
    EXPECT_LT(state.energy_drift, 1e-12);
    EXPECT_LT(state.largest_momentum, 1e-11 * std::sqrt(energy(start)));
  }
}

TEST(SoftGas, DampedCoolsAndNoUnintendedOverlap) {
  const Configuration3 start = gas(10, 0.1);
  const Watched watched = watched_run(start, 8, soft(Viscoelastic{1e8, 0.4, 1e-4}));
  const RunState3& state = watched.state;
  EXPECT_GT(state.counters.collisions, 5'000u);
  EXPECT_GT(watched.close_pairs, 0u);
  EXPECT_LT(energy(state.configuration), 0.7 * energy(start));
  EXPECT_LT(state.energy_drift, 1e-12);
}

// Hard and with the linear dashpot's one coefficient of restitution, the gas is that of the hard engine: event by
// event at first, in its means later.
TEST(SoftGas, HardLimitIsTheHardEngine) {
  const Configuration3 start = gas(8, 0.1);
  for (const double damping : {0.0, 0.1}) {
    const double stiffness = 1e16;
    const double restitution = damping == 0 ? 1 : 0.8587581018;
    // c_dis depends on the pair's mass: one mass.
    Configuration3 c = start;
    c.mass.assign(c.size(), 1);
    const DynamicsOptions options =
        soft(LinearDashpot{stiffness, damping * std::sqrt(0.5 * stiffness)});
    const DynamicsOptions hard = with_laws(restitution);
    const RunState3 soft_short = run_until(c, 0.2, options), hard_short = run_until(c, 0.2, hard);
    EXPECT_GT(hard_short.counters.collisions, c.size() / 8);
    EXPECT_EQ(soft_short.counters.collisions, hard_short.counters.collisions);
    for (std::size_t i = 0; i < c.size(); ++i)
      EXPECT_LT(
          (soft_short.configuration.unwrapped(i) - hard_short.configuration.unwrapped(i)).norm(),
          1e-5);
    // The ratio of the energies of two gases that have cooled scatters by 0.7/√N (measured).
    Configuration3 many = damping == 0 ? c : gas(14, 0.1);
    many.mass.assign(many.size(), 1);
    const RunState3 soft_long = run_until(many, 8, options), hard_long = run_until(many, 8, hard);
    const auto met = static_cast<double>(hard_long.counters.collisions);
    EXPECT_GT(met, 3000);
    EXPECT_NEAR(static_cast<double>(soft_long.counters.collisions), met, 4 * std::sqrt(2 * met));
    EXPECT_NEAR(soft_long.counters.virial / hard_long.counters.virial, 1, 6 / std::sqrt(met));
    EXPECT_NEAR(energy(soft_long.configuration) / energy(hard_long.configuration), 1,
                damping == 0 ? 1e-12 : 0.05);
  }
}

/// Disks of unit mass on a square lattice, every second one of radius 1.
Configuration2 disks(int side, double packing_fraction, std::uint64_t seed, double radius = 1) {
  Configuration2 c = square_lattice(side, packing_fraction, 0, [&](std::size_t i) {
    return round_shape<2>(i % 2 == 0 ? 1 : radius);
  });
  Stream draw(seed, Purpose::tests);
  for (Vec2& velocity : c.velocity) velocity = {draw.normal(), draw.normal()};
  c.mass.assign(c.size(), 1);
  return c;
}

/// So soft that they are in contact half of the time.
Configuration2 soft_disks() {
  return disks(12, 0.3, 9, 0.7);
}

/// The same, by way of a checkpoint's file.
Configuration2 kept(const Configuration2& configuration) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / "soft_dynamics.checkpoint";
  Checkpoint checkpoint;
  checkpoint.configuration = configuration;
  save_checkpoint(file, checkpoint);
  return std::get<Configuration2>(load_checkpoint(file).checkpoint.configuration);
}

TEST(SoftGas, ContinuesBitByBit) {
  const DynamicsOptions options = soft(LinearDashpot{200, 0.1});
  RunState2 whole = begin_run(soft_disks(), 0);
  std::vector<RunState2> interruptions;
  RunPlan2 plan;
  plan.end_time = 240;
  plan.at_block_end = [&](const RunState2& state) { interruptions.push_back(state); };
  run(whole, options, plan, {});
  plan.at_block_end = nullptr;
  ASSERT_GE(interruptions.size(), 2u);
  std::size_t releases = 0, close_pairs = 0;
  for (RunState2& state : interruptions) {
    releases += state.configuration.releases.size();
    close_pairs += state.configuration.close_pairs.size();
    EXPECT_TRUE(exact_check(state.configuration).clean());
    state.configuration = kept(state.configuration);
    run(state, options, plan, {});
    expect_same_state(state.configuration, whole.configuration);
    EXPECT_EQ(state.counters.collisions, whole.counters.collisions);
    EXPECT_EQ(state.counters.early_releases, whole.counters.early_releases);
    EXPECT_EQ(state.counters.dissipated, whole.counters.dissipated);
  }
  EXPECT_GT(releases, 0u);
  EXPECT_GT(close_pairs, 0u);
}

// New velocities replace those of after a contact, too.
TEST(SoftGas, RedrawnVelocitiesEndContacts) {
  DynamicsOptions options = brownian(0.1);
  options.engine.soft_contact = integrated_contact(LinearDashpot{200, 1});
  const RunState2 state = checked_run(soft_disks(), 10, options);
  EXPECT_GT(state.counters.collisions, 100u);
  EXPECT_LT(state.energy_drift, 1e-12);
}

// Contacts that leave a four-hundredth of the speed, some of them without room: clusters lose all of it, down
// to the rounding of velocities, but nobody meets for ever.
TEST(SoftGas, NearlyPlasticItsClustersComeToAnEnd) {
  for (const double packing_fraction : {0.05, 0.1})
    for (const std::uint64_t seed : {1, 2, 3}) {
      const Configuration2 start = disks(8, packing_fraction, seed);
      const RunState2 state = checked_run(start, 1000, soft(LinearDashpot{200, 200}));
      EXPECT_GT(state.counters.blocked_rotations, 0u);
      EXPECT_LT(energy(state.configuration), 0.2 * energy(start));
      EXPECT_LT(state.energy_drift, 1e-9);
    }
}

// Without room to rotate, they collide as hard particles, which would collapse: what follows within the duration of a
// contact is elastic.
TEST(SoftGas, DenseAndStronglyDampedItRunsOn) {
  for (const double damping : {20., 200.}) {
    const Configuration2 start = disks(8, 0.6, 9);
    const RunState2 state = checked_run(start, 1000, soft(LinearDashpot{200, damping}));
    EXPECT_GT(state.counters.short_flights, 0u);
    EXPECT_GT(state.counters.spared, 0);
    EXPECT_LT(energy(state.configuration), 0.5 * energy(start));
    EXPECT_LT(state.energy_drift, 1e-9);
  }
}

// Elastic contacts lose nothing that the contact-time model could spare.
TEST(SoftGas, ElasticItHasNoShortFlights) {
  const RunState2 state = run_until(disks(8, 0.6, 9), 10, soft(LinearDashpot{200}));
  EXPECT_GT(state.counters.blocked_rotations, 0u);
  EXPECT_EQ(state.counters.spared, 0);
}

// A pair that touches and approaches by less than its velocities are exact to.
TEST(SoftPair, PassesIfItHardlyApproaches) {
  const double drift = 1e-17;
  const Configuration2 start =
      few<2>({0.1, 0.1}, {{0, 0}, {0.2, 0}}, {{1 + drift, 1}, {1 - drift, -1}});
  const RunState2 state = checked_run(start, 1, soft(LinearDashpot{2000}));
  EXPECT_EQ(state.counters.collisions, 0u);
  EXPECT_LT((state.configuration.velocity[0] - start.velocity[0]).norm(), 1e-11);
}

// In a box hardly longer than two diameters a pair meets itself through its images, which turn with it.
TEST(SoftGas, InASmallBoxImagesOfThePartnerFindRoom) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Configuration3 c = few<3>({1, 1, 1}, {{-1.1, 0, 0}, {1.1, 0, 0}, {0, 1.9, 0.2}}, {});
    c.box = PeriodicBox<3>(Vec3(4.5, 3.9, 3.7));
    c.mass = {1, 1, 1};
    Stream draw(seed, Purpose::tests);
    for (int i = 0; i < 3; ++i) c.velocity.push_back({draw.normal(), draw.normal(), draw.normal()});
    ASSERT_TRUE(exact_check(c).clean());
    const RunState3 state = checked_run(c, 200, soft(LinearDashpot{100}));
    EXPECT_GT(state.counters.collisions, 100u);
    EXPECT_GT(state.counters.blocked_rotations, 0u);
  }
}

TEST(SoftParticles, AreRound) {
  Configuration2 c = soft_disks();
  c.shape[3] = of_aspect_ratio(2);
  EXPECT_THROW(make_engine(c, soft(LinearDashpot{200}).engine), UserError);
}

}  // namespace
}  // namespace vitrel

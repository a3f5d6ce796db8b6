// Runs with rough and inelastic contacts, driven ones, and those that the contact-time model keeps going.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/state/check.h"
#include "edmd/brownian.h"
#include "edmd/run.h"
#include "tests/support/motion.h"
#include "tests/support/scenes.h"
#include "tests/support/solids.h"

namespace vitrel {
namespace {

DynamicsOptions with(const ContactLaws& laws, double contact_duration = 0) {
  DynamicsOptions options;
  options.engine.laws = laws;
  options.engine.contact_duration = contact_duration;
  return options;
}

template <int Dim>
RunState<Dim> run_until(const Configuration<Dim>& start, double end,
                        const DynamicsOptions& options) {
  RunState<Dim> state = begin_run(start, 0);
  run(state, options, {{}, end, nullptr, {}}, {});
  return state;
}

Configuration2 disks(double packing_fraction = 0.3) {
  return moving(square_lattice(10, packing_fraction, 0, [](std::size_t) { return Ellipse{1, 1}; }));
}
Configuration2 ellipses() {
  return moving(square_lattice(10, 0.3, 0.8, [](std::size_t i) {
    return i % 3 ? of_aspect_ratio(2) : Ellipse{1, 1};
  }));
}
Configuration3 solids(const std::function<Ellipsoid(std::size_t)>& shape) {
  return moving(cubic_lattice(5, 0.1, shape));
}
Configuration3 spheres() {
  return solids([](std::size_t) { return Ellipsoid{Vec3::Ones()}; });
}
Configuration3 spheroids() {
  return solids([](std::size_t i) { return i % 3 ? prolate(2) : Ellipsoid{Vec3::Ones()}; });
}
Configuration3 all_kinds() {
  return solids([](std::size_t i) { return i % 2 ? Ellipsoid{{1.6, 1, 0.7}} : oblate(2); });
}

/// Energy has no source but what the contact-time model counts, which is little, and that is a drift of the energy.
template <int Dim>
void expect_balanced(const RunState<Dim>& end) {
  const auto sums = mechanics(end.configuration);
  const double energy = sums.translational_energy + sums.rotational_energy;
  EXPECT_NEAR(energy + end.counters.dissipated - end.counters.added, end.flight_energy,
              1e-10 * end.flight_energy);
  EXPECT_GE(end.counters.dissipated, 0);
  EXPECT_GE(end.counters.added, 0);
  EXPECT_LT(end.counters.added, 1e-5 * end.flight_energy);
  EXPECT_GE(end.energy_drift, end.counters.added / end.flight_energy - 1e-10);
}

template <int Dim>
double spin_of_round_particles(const Configuration<Dim>& c) {
  double sum = 0;
  for (std::size_t i = 0; i < c.size(); ++i)
    if (c.shape[i].is_round()) {
      if constexpr (Dim == 2)
        sum += std::abs(c.angular_velocity[i]);
      else
        sum += c.angular_velocity[i].norm();
    }
  return sum;
}

template <int Dim>
void expect_conserving(const Configuration<Dim>& start, const ContactLaw& law) {
  const RunState<Dim> end = run_until(start, 5, with(law));
  EXPECT_GT(end.counters.collisions, start.size());
  EXPECT_LT(end.energy_drift, 1e-12);
  EXPECT_LT(end.largest_momentum, 1e-11);
  EXPECT_TRUE(exact_check(end.configuration).clean());
  if (rotor_count(start) < start.size()) {
    EXPECT_GT(spin_of_round_particles(end.configuration), 1);
  }
}

TEST(RoughDynamics, ConservesWhatItShould) {
  for (const ContactLaw& law :
       {ContactLaw{1, ContactLaw::no_slip, 1}, ContactLaw{0.9, 0.3, 0.4}, ContactLaw{0.8, 2, -0.5},
        ContactLaw{NormalRestitution::viscoelastic(0.8, 1), 0.5, 0}}) {
    expect_conserving(disks(), law);
    expect_conserving(ellipses(), law);
    expect_conserving(spheres(), law);
    expect_conserving(spheroids(), law);
    expect_conserving(all_kinds(), law);
  }
}

// In a box so wide that nothing meets its images: of spheroids, which spin about their axes, the stored angular
// velocity is L/I⊥.
template <int Dim>
void expect_conserved_angular_momentum(Configuration<Dim> start) {
  start.box = PeriodicBox<Dim>(start.box.lengths() * 40);
  for (std::size_t i = 0; i < start.size(); ++i) start.velocity[i] -= 0.3 * start.position[i];
  const auto angular_momentum = [](const Configuration<Dim>& c) {
    AngularVelocity<Dim> sum = 0 * c.angular_velocity[0];
    for (std::size_t i = 0; i < c.size(); ++i) {
      sum += c.mass[i] * cross(c.position[i], c.velocity[i]);
      if constexpr (Dim == 2)
        sum += c.inertia(i) * c.angular_velocity[i];
      else
        sum += c.orientation[i] *
               c.inertia(i).cwiseProduct(c.orientation[i].conjugate() * c.angular_velocity[i]);
    }
    return sum;
  };
  const RunState<Dim> end = run_until(start, 10, with(ContactLaw{0.9, 0.7, 0.3}));
  EXPECT_GT(end.counters.collisions, 20u);
  const AngularVelocity<Dim> change = angular_momentum(end.configuration) - angular_momentum(start);
  if constexpr (Dim == 2)
    EXPECT_NEAR(change, 0, 1e-10);
  else
    EXPECT_LT(change.norm(), 1e-10);
}

TEST(RoughDynamics, ConservesAngularMomentum) {
  expect_conserved_angular_momentum(disks());
  expect_conserved_angular_momentum(ellipses());
  expect_conserved_angular_momentum(spheres());
  expect_conserved_angular_momentum(spheroids());
  expect_conserved_angular_momentum(all_kinds());
}

// The angle of a disk between two collisions is that of its spin.
TEST(RoughDynamics, RoundParticlesTurnAsTheySpin) {
  const DynamicsOptions options = with(ContactLaw{1, ContactLaw::no_slip, 1});
  const double step = 1e-4;
  const Configuration2 one = run_until(disks(), 5, options).configuration,
                       two = run_until(disks(), 5 + step, options).configuration;
  const Configuration3 three = run_until(spheres(), 5, options).configuration,
                       four = run_until(spheres(), 5 + step, options).configuration;
  std::size_t same = 0;
  for (std::size_t i = 0; i < one.size(); ++i)
    if (one.angular_velocity[i] == two.angular_velocity[i]) {
      EXPECT_NEAR(two.angle[i] - one.angle[i], step * one.angular_velocity[i], 1e-12);
      ++same;
    }
  for (std::size_t i = 0; i < three.size(); ++i)
    if (three.angular_velocity[i] == four.angular_velocity[i]) {
      EXPECT_NEAR(three.orientation[i].angularDistance(four.orientation[i]),
                  step * three.angular_velocity[i].norm(), 1e-9);
      ++same;
    }
  EXPECT_GT(same, 200u);
}

// Without friction all is as with the smooth law, to the last bit, whatever else the law says.
TEST(RoughDynamics, WithoutFrictionIsBitIdentical) {
  EXPECT_EQ(difference(run_until(disks(), 5, with(0.9)).configuration,
                       run_until(disks(), 5, with(ContactLaw{0.9, 0, 0.7})).configuration),
            0);
  EXPECT_EQ(difference(run_until(spheroids(), 5, {}).configuration,
                       run_until(spheroids(), 5, with(ContactLaw{1, 3, -1})).configuration),
            0);
}

TEST(RoughDynamics, PairsOfSpeciesHaveTheirOwnLaws) {
  Configuration2 c = disks();
  c.species_names = {"A", "B"};
  ContactLaws laws(2, {});
  laws.set(0, 1, {0.5, 1, 0});
  EXPECT_EQ(run_until(c, 5, with(laws)).counters.dissipated, 0);
  c.species[7] = 1;
  const RunState2 end = run_until(c, 5, with(laws));
  EXPECT_GT(end.counters.dissipated, 0);
  EXPECT_LT(end.energy_drift, 1e-12);
  for (std::size_t i = 0; i < c.size(); ++i)
    if (i != 7 && end.configuration.angular_velocity[i] != 0) {
      EXPECT_NE(end.configuration.angular_velocity[7], 0);
    }
}

// Two disks meet head-on, and again off the centre.
TEST(RoughDynamics, PlasticCollisionsLeaveNoNormalSpeed) {
  Configuration2 c;
  c.resize(2);
  c.box = PeriodicBox<2>(Vec2(20, 20));
  c.species_names = {"A"};
  for (const double offset : {0., 0.5}) {
    c.position = {Vec2(-2, 0), Vec2(2, offset)};
    c.velocity = {Vec2(1, 0), Vec2(-1, 0)};
    const RunState2 end = run_until(c, 2, with(0.0));
    EXPECT_LE(end.counters.collisions, 2u);
    const Vec2 v = end.configuration.velocity[1] - end.configuration.velocity[0];
    EXPECT_NEAR(v.norm(), 2 * offset / 2, 1e-9);
    EXPECT_NEAR(end.counters.dissipated, 1 - v.squaredNorm() / 4, 1e-9);
  }
}

// A gas that collapses stops, and says what goes on from there; with the contact-time model it does, and all its energy
// is accounted for.
TEST(ContactTimeModel, GoesOnWhereRunsStop) {
  const Configuration2 start = ellipses();
  try {
    run_until(start, 20, with(0.3));
    FAIL() << "no collapse";
  } catch (const InvariantError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("dynamics.contact_duration"));
  }
  for (const double friction : {0., 0.5}) {
    const RunState2 end = run_until(start, 20, with(ContactLaw{0.3, friction, 0}, 1e-4));
    EXPECT_GT(end.counters.short_flights, 10u);
    EXPECT_GT(end.counters.spared, 0);
    expect_balanced(end);
    EXPECT_TRUE(exact_check(end.configuration).clean());
  }
}

// Clusters without any normal speed: surfaces that turn towards each other touch again and again.
template <int Dim>
void expect_to_stay_hard(const Configuration<Dim>& start) {
  for (const double contact_duration : {1e-7, 1e-5, 0.1, 10.})
    for (const double friction : {0., 0.5}) {
      SCOPED_TRACE(testing::Message() << "t_c = " << contact_duration << ", friction " << friction);
      const RunState<Dim> end =
          run_until(start, 6, with(ContactLaw{0., friction, 0}, contact_duration));
      expect_balanced(end);
      EXPECT_TRUE(exact_check(end.configuration).clean());
    }
}

TEST(ContactTimeModel, KeepsPlasticParticlesOfAllShapesHard) {
  expect_to_stay_hard(disks(0.5));
  expect_to_stay_hard(ellipses());
  expect_to_stay_hard(spheres());
  expect_to_stay_hard(spheroids());
  expect_to_stay_hard(all_kinds());
}

// The law leaves an elastic gas alone, however long contacts would take.
template <int Dim>
void expect_nothing_of_elastic(const Configuration<Dim>& start) {
  const RunState<Dim> without = run_until(start, 10, {});
  for (const double contact_duration : {1e-3, 0.3, 3.}) {
    const RunState<Dim> end = run_until(start, 10, with(1, contact_duration));
    EXPECT_EQ(difference(end.configuration, without.configuration), 0);
    EXPECT_LT(end.energy_drift, 1e-12);
  }
}

TEST(ContactTimeModel, DoesNothingToElasticParticles) {
  expect_nothing_of_elastic(disks());
  expect_nothing_of_elastic(ellipses());
  expect_nothing_of_elastic(spheres());
  expect_nothing_of_elastic(spheroids());
  expect_nothing_of_elastic(all_kinds());
}

TEST(ContactTimeModel, DoesNothingToAThinGasOfRareCollisions) {
  const Configuration2 start = disks(0.02);
  const RunState2 with_it = run_until(start, 5, with(0.9, 1e-9));
  EXPECT_EQ(with_it.counters.short_flights, 0u);
  EXPECT_EQ(difference(with_it.configuration, run_until(start, 5, with(0.9)).configuration), 0);
}

// Every step begins at kT = 1 again, whatever the collisions of the one before have taken.
TEST(BrownianSteps, KeepAnInelasticGasHot) {
  DynamicsOptions options = with(ContactLaw{0.5, 0.3, 0}, 1e-5);
  options.brownian = true;
  options.brownian_step = 0.5;
  const RunState2 end = run_until(ellipses(), 20, options);
  EXPECT_LE(end.energy_drift, end.counters.added / 150 + 1e-12);
  EXPECT_LT(end.counters.added, 1e-5 * 150);
  EXPECT_GT(end.counters.dissipated, 0);
  const Mechanics<2> sums = mechanics(end.configuration);
  EXPECT_NEAR(sums.translational_energy, 100, 1e-9);  // of the draw at the end
  EXPECT_NEAR(sums.rotational_energy, 50, 1e-9);
  EXPECT_TRUE(exact_check(end.configuration).clean());
}

TEST(Driving, KicksConserveMomentumAndSupplyThePower) {
  Configuration3 c = spheroids();
  for (std::size_t i = 0; i < c.size(); ++i) c.mass[i] = 1 + static_cast<double>(i % 4);
  const Vec3 momentum = mechanics(c).momentum;
  const Driving driving{.interval = 0.5, .power = 3};
  double supplied = 0, squares = 0;
  constexpr int kicks = 2000;
  for (int step = 1; step <= kicks; ++step) {
    Configuration3 kicked = c;
    kick(kicked, driving, 5, static_cast<std::uint64_t>(step));
    EXPECT_LT((mechanics(kicked).momentum - momentum).norm(), 1e-11);
    EXPECT_EQ(kicked.angular_velocity[3], c.angular_velocity[3]);
    const double gain = mechanics(kicked).translational_energy - mechanics(c).translational_energy;
    supplied += gain / kicks;
    squares += gain * gain / kicks;
  }
  const double wanted = 1.5 * static_cast<double>(c.size());
  EXPECT_NEAR(supplied, wanted, 4 * std::sqrt((squares - supplied * supplied) / kicks));
}

TEST(Driving, DoesNotDependOnTheNumberOfThreads) {
  Configuration2 one = disks(), two = one;
  kick(one, {}, 1, 3, 1);
  kick(two, {}, 1, 3, 2);
  EXPECT_EQ(difference(one, two), 0);
}

TEST(Driving, KeepsAnInelasticGasHot) {
  DynamicsOptions options = with(0.8);
  options.driving = Driving{.interval = 0.02, .power = 0.5};
  const RunState2 end = run_until(disks(), 200, options);
  EXPECT_EQ(end.velocity_steps, 10000u);
  EXPECT_LT(end.energy_drift, 1e-12);
  EXPECT_LT(end.largest_momentum, 1e-10);
  EXPECT_NEAR(end.counters.supplied / (0.5 * 200 * 100), 1, 0.1);
  const Mechanics<2> sums = mechanics(end.configuration);
  EXPECT_NEAR(
      sums.translational_energy,
      mechanics(disks()).translational_energy + end.counters.supplied - end.counters.dissipated,
      1e-8);
}

}  // namespace
}  // namespace vitrel

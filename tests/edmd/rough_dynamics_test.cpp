// Runs with rough and inelastic contacts, driven ones, and those that the contact-time model keeps going.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/state/check.h"
#include "tests/support/conserved.h"
#include "tests/support/equal_bodies.h"
#include "tests/support/motion.h"
#include "tests/support/runs.h"

namespace vitrel {
namespace {

Configuration2 disks(double packing_fraction = 0.3) {
  return moving(lattice_of_disks(10, packing_fraction));
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
  return moving(cubic_lattice(5, 0.1, Ellipsoid{}));
}
Configuration3 spheroids() {
  return solids([](std::size_t i) { return i % 3 ? prolate(2) : Ellipsoid{Vec3::Ones()}; });
}
Configuration3 all_kinds() {
  return solids([](std::size_t i) { return i % 2 ? Ellipsoid{{1.6, 1, 0.7}} : oblate(2); });
}

/// check(state) of every kind of particles.
template <class Check>
void for_all_kinds(const Check& check, double fraction_of_disks = 0.3) {
  check(disks(fraction_of_disks));
  check(ellipses());
  check(spheres());
  check(spheroids());
  check(all_kinds());
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
    if (c.shape[i].is_round()) sum += magnitude(c.angular_velocity[i]);
  return sum;
}

TEST(RoughDynamics, ConservesWhatItShould) {
  for (const ContactLaw& law :
       {ContactLaw{1, ContactLaw::no_slip, 1}, ContactLaw{0.9, 0.3, 0.4}, ContactLaw{0.8, 2, -0.5},
        ContactLaw{NormalRestitution::viscoelastic(0.8, 1), 0.5, 0}})
    for_all_kinds([&](const auto& start) {
      const auto end = run_until(start, 5, with_laws(law));
      EXPECT_GT(end.counters.collisions, start.size());
      EXPECT_LT(end.energy_drift, 1e-12);
      EXPECT_LT(end.largest_momentum, 1e-11);
      EXPECT_TRUE(exact_check(end.configuration).clean());
      if (rotor_count(start) < start.size()) {
        EXPECT_GT(spin_of_round_particles(end.configuration), 1);
      }
    });
}

// Of spheroids, which spin about their axes, the stored angular velocity is L/I⊥.
TEST(RoughDynamics, ConservesAngularMomentum) {
  for_all_kinds([]<int Dim>(const Configuration<Dim>& scene) {
    const Configuration<Dim> start = in_an_open_box(scene);
    const RunState<Dim> end = run_until(start, 10, with_laws(ContactLaw{0.9, 0.7, 0.3}));
    EXPECT_GT(end.counters.collisions, 20u);
    const AngularVelocity<Dim> change =
        angular_momentum(end.configuration) - angular_momentum(start);
    EXPECT_LT(magnitude(change), 1e-10);
  });
}

// The angle of a disk between two collisions is that of its spin.
TEST(RoughDynamics, RoundParticlesTurnAsTheySpin) {
  const DynamicsOptions options = with_laws(ContactLaw{1, ContactLaw::no_slip, 1});
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
  EXPECT_EQ(difference(run_until(disks(), 5, with_laws(0.9)).configuration,
                       run_until(disks(), 5, with_laws(ContactLaw{0.9, 0, 0.7})).configuration),
            0);
  EXPECT_EQ(difference(run_until(spheroids(), 5, {}).configuration,
                       run_until(spheroids(), 5, with_laws(ContactLaw{1, 3, -1})).configuration),
            0);
}

TEST(RoughDynamics, PairsOfSpeciesHaveTheirOwnLaws) {
  Configuration2 c = disks();
  c.species_names = {"A", "B"};
  ContactLaws laws(2, {});
  laws.set(0, 1, {0.5, 1, 0});
  EXPECT_EQ(run_until(c, 5, with_laws(laws)).counters.dissipated, 0);
  c.species[7] = 1;
  const RunState2 end = run_until(c, 5, with_laws(laws));
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
    const RunState2 end = run_until(c, 2, with_laws(0.0));
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
  const auto says = testing::HasSubstr("dynamics.contact_duration");
  EXPECT_THAT([&] { run_until(start, 20, with_laws(0.3)); },
              testing::ThrowsMessage<InvariantError>(says));
  for (const double friction : {0., 0.5}) {
    const RunState2 end = run_until(start, 20, with_laws(ContactLaw{0.3, friction, 0}, 1e-4));
    EXPECT_GT(end.counters.short_flights, 10u);
    EXPECT_GT(end.counters.spared, 0);
    expect_balanced(end);
    EXPECT_TRUE(exact_check(end.configuration).clean());
  }
}

// Clusters without any normal speed: surfaces that turn towards each other touch again and again.
TEST(ContactTimeModel, KeepsPlasticParticlesOfAllShapesHard) {
  const auto expect_hard = [](const auto& start) {
    for (const double duration : {1e-7, 1e-5, 0.1, 10.})
      for (const double friction : {0., 0.5}) {
        SCOPED_TRACE(testing::Message() << "t_c = " << duration << ", friction " << friction);
        const auto end = run_until(start, 6, with_laws(ContactLaw{0., friction, 0}, duration));
        expect_balanced(end);
        EXPECT_TRUE(exact_check(end.configuration).clean());
      }
  };
  for_all_kinds(expect_hard, 0.5);
}

// The law leaves an elastic gas alone, however long contacts would take.
TEST(ContactTimeModel, DoesNothingToElasticParticles) {
  for_all_kinds([](const auto& start) {
    const auto without = run_until(start, 10);
    for (const double contact_duration : {1e-3, 0.3, 3.}) {
      const auto end = run_until(start, 10, with_laws(1, contact_duration));
      EXPECT_EQ(difference(end.configuration, without.configuration), 0);
      EXPECT_LT(end.energy_drift, 1e-12);
    }
  });
}

TEST(ContactTimeModel, DoesNothingToAThinGasOfRareCollisions) {
  const Configuration2 start = disks(0.02);
  const RunState2 with_it = run_until(start, 5, with_laws(0.9, 1e-9));
  EXPECT_EQ(with_it.counters.short_flights, 0u);
  EXPECT_EQ(difference(with_it.configuration, run_until(start, 5, with_laws(0.9)).configuration),
            0);
}

// Every step begins at kT = 1 again, whatever the collisions of the one before have taken.
TEST(BrownianSteps, KeepAnInelasticGasHot) {
  DynamicsOptions options = with_laws(ContactLaw{0.5, 0.3, 0}, 1e-5);
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
  DynamicsOptions options = with_laws(0.8);
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

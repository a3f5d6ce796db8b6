#include <gtest/gtest.h>

#include <cmath>

#include "core/contact/first_contact.h"
#include "core/geometry/free_flight.h"
#include "core/random/stream.h"
#include "tests/support/conserved.h"

namespace vitrel {
namespace {

struct TwoBodies {
  Flight<Ellipse> one, two;
  double mass1 = 1, mass2 = 1;

  Inertia<2> inertia1() const { return inertia_of(one.body, mass1); }
  Inertia<2> inertia2() const { return inertia_of(two.body, mass2); }

  // Flies to the first contact and applies the rule; false without a contact.
  bool collide_first(double restitution, double* impulse = nullptr, double* speed = nullptr) {
    const Prediction2 touch = first_contact(one, two, 1e6, 1e-14);
    if (touch.outcome != Outcome::contact) return false;
    one.pose = advanced(one.pose, one.motion, touch.time);
    two.pose = advanced(two.pose, two.motion, touch.time);
    const ContactGeometry<2> contact{touch.normal,
                                     cross(touch.point - one.pose.position, touch.normal),
                                     cross(touch.point - two.pose.position, touch.normal)};
    if (speed) *speed = approach_speed(one.motion, two.motion, contact);
    const double j =
        collide(one.motion, inertia1(), two.motion, inertia2(), contact, restitution).impulse;
    if (impulse) *impulse = j;
    return true;
  }

  Conserved<2> sums() const {
    return {{one.pose, one.motion, inertia1()}, {two.pose, two.motion, inertia2()}};
  }
};

// Velocities after the two reference collisions, in extended precision.
TEST(CollisionRule, FirstReferenceCollision) {
  TwoBodies pair{{{2, 1}, {{0, 0}, 0}, {{0, 0}, 0}},
                 {{2, 1}, {{6, 0.5}, std::numbers::pi / 2}, {{-1, 0}, 0.7}}};
  ASSERT_TRUE(pair.collide_first(1));
  EXPECT_NEAR(pair.one.motion.velocity.x(), -0.830888702768, 1e-12);
  EXPECT_NEAR(pair.one.motion.velocity.y(), -0.491480450439, 1e-12);
  EXPECT_NEAR(pair.one.motion.angular_velocity, -0.565559813742, 1e-12);
  EXPECT_NEAR(pair.two.motion.angular_velocity, 0.092073395872, 1e-12);
}

TEST(CollisionRule, SecondReferenceCollision) {
  TwoBodies pair{{{2, 1}, {{0, 0}, 0.3}, {{0.2, -0.1}, 1.5}},
                 {{2, 1}, {{3, 2.5}, -0.4}, {{-0.5, -0.6}, -0.8}}};
  ASSERT_TRUE(pair.collide_first(1));
  EXPECT_NEAR(pair.one.motion.angular_velocity, 0.413749903818, 1e-12);
  EXPECT_NEAR(pair.two.motion.angular_velocity, 0.570551815786, 1e-12);
}

TEST(CollisionRule, ConservesWhatItShould) {
  Stream draw(9, Purpose::tests);
  int collisions = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    TwoBodies pair{{{draw.uniform(1, 3), draw.uniform(0.3, 1)},
                    {{0, 0}, draw.uniform(0, 7)},
                    {{draw.normal(), draw.normal()}, draw.normal()}},
                   {{draw.uniform(1, 3), draw.uniform(0.3, 1)},
                    {{7, 0}, draw.uniform(0, 7)},
                    {{draw.normal() - 2, draw.normal()}, draw.normal()}},
                   draw.uniform(0.5, 4),
                   draw.uniform(0.5, 4)};
    const double restitution = trial % 2 ? 1 : draw.uniform(0, 1);
    const Conserved<2> before = pair.sums();
    double impulse = 0, speed = 0;
    if (!pair.collide_first(restitution, &impulse, &speed)) continue;
    ++collisions;
    EXPECT_GT(speed, 0);
    const Conserved<2> after = pair.sums();
    EXPECT_LT((after.momentum - before.momentum).norm(), 1e-13);
    EXPECT_NEAR(after.angular_momentum, before.angular_momentum, 1e-11);
    EXPECT_NEAR(after.energy, before.energy - 0.5 * impulse * speed * (1 - restitution), 1e-12);
  }
  EXPECT_GT(collisions, 1000);
}

// A lone ellipse in a box shorter than its length: its tips meet those of its images. Energy stays,
// the spin turns round.
TEST(CollisionRule, OwnImageReversesTheSpin) {
  Motion2 motion{{0.3, 0.1}, 2};
  const Inertia<2> inertia = inertia_of({2, 1}, 1);
  const ContactGeometry<2> contact{{1, 0}, 0.4, -0.4};
  const double impulse = collide_with_own_image(motion, inertia, contact, 1).impulse;
  EXPECT_EQ(motion.angular_velocity, -2);
  EXPECT_EQ(motion.velocity, Vec2(0.3, 0.1));
  // The general rule for the spin: both sides' impulses act on the one body.
  EXPECT_NEAR(2 - impulse * inertia.inverse_moment * (contact.arm1 - contact.arm2), -2, 1e-14);
}

TEST(CollisionRule, CorrectionMoveSeparatesAndKeepsMomentumAndEnergy) {
  Motion2 one{{1, 0.5}, 0.3}, two{{-1, 2}, -0.4};
  const Inertia<2> light{1, 1}, heavy{0.5, 0.2};
  const Vec2 d(0.6, -0.8);
  const Vec2 momentum = one.velocity + 2 * two.velocity;
  const double energy = one.velocity.squaredNorm() + 2 * two.velocity.squaredNorm();
  separate(one, light, two, heavy, d);
  EXPECT_GT(d.dot(two.velocity - one.velocity), 0);
  EXPECT_LT((one.velocity + 2 * two.velocity - momentum).norm(), 1e-14);
  EXPECT_NEAR(one.velocity.squaredNorm() + 2 * two.velocity.squaredNorm(), energy, 1e-14);
  EXPECT_EQ(one.angular_velocity, 0.3);
}

}  // namespace
}  // namespace vitrel

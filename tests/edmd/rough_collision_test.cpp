#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/contact/contact_queries.h"
#include "core/random/stream.h"
#include "core/state/configuration.h"
#include "tests/support/conserved.h"

namespace vitrel {
namespace {

template <int Dim>
struct BodyInContact {
  ParticleShape<Dim> shape;
  double mass;
  Pose<Dim> pose;
  Motion<Dim> motion;

  Inertia<Dim> inertia() const { return in_space(full_inertia_of(shape, mass), pose, 1); }
};

Vec2 unit_vector(Stream& draw, std::integral_constant<int, 2>) {
  const double angle = draw.uniform(0, 2 * std::numbers::pi);
  return {std::cos(angle), std::sin(angle)};
}
Vec3 unit_vector(Stream& draw, std::integral_constant<int, 3>) {
  return Vec3{draw.normal(), draw.normal(), draw.normal()}.normalized();
}

/// One in four is round, and every other ellipsoid a spheroid.
void draw_body(BodyInContact<2>& body, Stream& draw) {
  const double b = draw.uniform(0.2, 2);
  body.shape = {b * (draw.below(4) == 0 ? 1 : draw.uniform(1, 6)), b};
  body.pose.angle = draw.uniform(0, 7);
  body.motion = {{draw.normal(), draw.normal()}, 2 * draw.normal()};
}
void draw_body(BodyInContact<3>& body, Stream& draw) {
  Vec3 axes{draw.uniform(0.2, 2), draw.uniform(0.2, 2), draw.uniform(0.2, 2)};
  if (draw.below(2) == 0) axes[1] = axes[0];
  if (draw.below(4) == 0) axes.setConstant(axes[0]);
  body.shape = {axes};
  body.pose.orientation =
      Quaternion{draw.normal(), draw.normal(), draw.normal(), draw.normal()}.normalized();
  body.motion = {{draw.normal(), draw.normal(), draw.normal()},
                 2 * Vec3{draw.normal(), draw.normal(), draw.normal()}};
}

template <int Dim>
struct TouchingPair {
  BodyInContact<Dim> one, two;
  RoughContact<Dim> contact;

  /// At a random point of both surfaces, and approaching.
  explicit TouchingPair(Stream& draw) {
    for (BodyInContact<Dim>* body : {&one, &two}) {
      draw_body(*body, draw);
      body->mass = draw.uniform(0.2, 5);
      body->pose.position = Vec<Dim>::Zero();
    }
    contact.normal = unit_vector(draw, std::integral_constant<int, Dim>{});
    contact.arm1 = surface_point(one.shape, one.pose, contact.normal);
    contact.arm2 = surface_point(two.shape, two.pose, -contact.normal);
    two.pose.position = contact.arm1 - contact.arm2;
    if (speed() < 0) std::swap(one.motion, two.motion);
    if (speed() < 0) one.motion.velocity += (1 - speed()) * contact.normal;
  }

  Vec<Dim> surface_velocity(const BodyInContact<Dim>& body, const Vec<Dim>& arm) const {
    if constexpr (Dim == 2)
      return body.motion.velocity + body.motion.angular_velocity * perpendicular(arm);
    else
      return body.motion.velocity + body.motion.angular_velocity.cross(arm);
  }
  Vec<Dim> slip() const {
    return surface_velocity(one, contact.arm1) - surface_velocity(two, contact.arm2);
  }
  double speed() const { return slip().dot(contact.normal); }

  Conserved<Dim> sums() const {
    return {{one.pose, one.motion, one.inertia()}, {two.pose, two.motion, two.inertia()}};
  }

  RoughImpact<Dim> collide(const ContactLaw& law) {
    return collide_rough(one.motion, one.inertia(), two.motion, two.inertia(), contact,
                         law.restitution(speed()), law);
  }
};

ContactLaw random_law(Stream& draw) {
  const double friction = draw.below(4) == 0 ? ContactLaw::no_slip : std::exp(draw.uniform(-5, 3));
  return {draw.below(8) == 0 ? 0 : draw.uniform(0, 1), friction, draw.uniform(-1, 1)};
}

/// The two parts of the energy of the relative motion at the contact, from the impulse that takes the normal part away,
/// and from that which takes all of it away; each found by letting the bodies collide.
template <int Dim>
struct ContactEnergies {
  double along, across;

  explicit ContactEnergies(const TouchingPair<Dim>& pair) {
    TouchingPair<Dim> plastic = pair, sticking = pair;
    plastic.collide({0.0, 0, 0});
    sticking.collide({0.0, ContactLaw::no_slip, 0});
    along = pair.sums().energy - plastic.sums().energy;
    across = plastic.sums().energy - sticking.sums().energy;
  }
};

template <class Dimension>
class RoughCollision : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(RoughCollision, Dimensions);

TYPED_TEST(RoughCollision, NeverCreatesEnergy) {
  constexpr int Dim = TypeParam::value;
  constexpr std::uint64_t impacts = 5'000'000;
  Stream draw(31, Purpose::tests, Dim);
  std::uint64_t stuck = 0, slid = 0;
  for (std::uint64_t k = 0; k < impacts; ++k) {
    TouchingPair<Dim> pair(draw);
    const TouchingPair<Dim> before = pair;
    const ContactLaw law = random_law(draw);
    const double speed = before.speed(), e = law.restitution(speed);
    const RoughImpact<Dim> result = pair.collide(law);
    const Conserved<Dim> now = pair.sums(), then = before.sums();
    // Long bodies amplify the rounding of their motion by the square of their aspect ratio.
    const double rounding = 1e-13 * (1 + then.energy);
    ASSERT_LE(now.energy, then.energy + rounding);
    ASSERT_NEAR(now.energy, then.energy - result.dissipated, 10 * rounding);
    ASSERT_LT((now.momentum - then.momentum).norm(), rounding);
    ASSERT_LT(magnitude(now.angular_momentum - then.angular_momentum), 30 * rounding);
    ASSERT_NEAR(pair.speed(), -e * speed, 30 * rounding);
    // Coulomb's cone.
    const double pressing = -result.impulse.dot(before.contact.normal);
    const double sliding = (result.impulse + pressing * before.contact.normal).norm();
    ASSERT_GE(pressing, -rounding);
    if (law.friction < ContactLaw::no_slip) {
      ASSERT_LE(sliding, law.friction * pressing + rounding);
      ++(sliding > 0.999999 * law.friction * pressing ? slid : stuck);
    }
  }
  EXPECT_GT(stuck, impacts / 20);
  EXPECT_GT(slid, impacts / 20);
}

// E' = e² E_n + (1 − κ)² E_t with κ = 1 + β where the contact sticks.
TYPED_TEST(RoughCollision, SplitsTheEnergy) {
  constexpr int Dim = TypeParam::value;
  Stream draw(32, Purpose::tests, Dim);
  int compared = 0;
  for (int k = 0; k < 20000; ++k) {
    TouchingPair<Dim> pair(draw);
    const TouchingPair<Dim> before = pair;
    const ContactEnergies<Dim> energies(before);
    const double e = draw.uniform(0, 1), beta = draw.uniform(-1, 1);
    const ContactLaw law{e, ContactLaw::no_slip, beta};
    // Without friction nothing is left out of the tangential motion, with β = 0 everything.
    TouchingPair<Dim> all_lost = before;
    all_lost.collide({0.0, ContactLaw::no_slip, 0});
    if (all_lost.slip().norm() > 1e-10) continue;  // the cone
    const RoughImpact<Dim> result = pair.collide(law);
    const double lost = (1 - e * e) * energies.along + (1 - beta * beta) * energies.across;
    const double energy = before.sums().energy;
    if (std::abs(result.dissipated - lost) > 1e-9 * energy) {
      // The impulse had to be lowered since it would have pulled.
      EXPECT_NEAR(-result.impulse.dot(before.contact.normal), 0, 1e-12 * (1 + energy));
      continue;
    }
    ++compared;
    EXPECT_NEAR(pair.sums().energy, energy - lost, 1e-12 * (1 + energy));
  }
  EXPECT_GT(compared, 10000);
}

TYPED_TEST(RoughCollision, WithoutFrictionIsTheSmoothOne) {
  constexpr int Dim = TypeParam::value;
  Stream draw(33, Purpose::tests, Dim);
  for (int k = 0; k < 2000; ++k) {
    TouchingPair<Dim> rough(draw);
    BodyInContact<Dim> one = rough.one, two = rough.two;
    const double e = draw.uniform(0, 1);
    const Vec<Dim>& n = rough.contact.normal;
    const ContactGeometry<Dim> contact{n, cross(rough.contact.arm1, n),
                                       cross(rough.contact.arm2, n)};
    collide(one.motion, one.inertia(), two.motion, two.inertia(), contact, e);
    rough.collide(k % 2 ? ContactLaw{e, 0, 0.5} : ContactLaw{e, 1, -1});
    EXPECT_LT((rough.one.motion.velocity - one.motion.velocity).norm(), 1e-12);
    EXPECT_LT((rough.two.motion.velocity - two.motion.velocity).norm(), 1e-12);
    EXPECT_LT(magnitude(rough.one.motion.angular_velocity - one.motion.angular_velocity), 1e-12);
    EXPECT_LT(magnitude(rough.two.motion.angular_velocity - two.motion.angular_velocity), 1e-12);
  }
}

// Walton and Braun: of two equal round bodies with q = I/(m R²), the tangential velocity of the surfaces becomes −β times
// itself where they stick, and otherwise μ (1 + e) (1 + 1/q) u_n smaller.
TYPED_TEST(RoughCollision, OfRoundBodiesIsThatOfWaltonAndBraun) {
  constexpr int Dim = TypeParam::value;
  Stream draw(34, Purpose::tests, Dim);
  const double q = Dim == 2 ? 0.5 : 0.4;
  int stuck = 0;
  for (int k = 0; k < 2000; ++k) {
    TouchingPair<Dim> pair(draw);
    const double radius = draw.uniform(0.3, 3);
    for (BodyInContact<Dim>* body : {&pair.one, &pair.two}) {
      body->shape = round_shape<Dim>(radius);
      body->mass = 1.7;
    }
    const Vec<Dim>& n = pair.contact.normal;
    pair.contact.arm1 = radius * n;
    pair.contact.arm2 = -radius * n;
    const double u = pair.speed();
    if (u <= 0) continue;
    const Vec<Dim> across = pair.slip() - u * n;
    const ContactLaw law{draw.uniform(0, 1), draw.uniform(0.05, 1), draw.uniform(-1, 1)};
    const double e = law.restitution(u);
    const double sliding = law.friction * (1 + e) * (1 + 1 / q) * u;
    pair.collide(law);
    const double factor = std::max(-law.tangential_restitution, 1 - sliding / across.norm());
    stuck += factor == -law.tangential_restitution;
    EXPECT_LT((pair.slip() - factor * across + e * u * n).norm(), 1e-12);
  }
  EXPECT_GT(stuck, 100);
  EXPECT_LT(stuck, 1900);
}

}  // namespace
}  // namespace vitrel

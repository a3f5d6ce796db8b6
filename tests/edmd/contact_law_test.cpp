#include "edmd/contact_law.h"

#include <gtest/gtest.h>

#include <cmath>

#include "edmd/soft/restitution.h"
#include "edmd/soft/viscoelastic.h"

namespace vitrel {
namespace {

TEST(NormalRestitution, IsConstant) {
  const NormalRestitution e = 0.7;
  EXPECT_EQ(e(1e-9), 0.7);
  EXPECT_EQ(e(1e9), 0.7);
  EXPECT_TRUE(e.is_constant());
  EXPECT_FALSE(e.is_elastic());
  EXPECT_TRUE(NormalRestitution().is_elastic());
}

TEST(NormalRestitution, IsLinearBetweenSpeeds) {
  const auto e = NormalRestitution::tabulated({1, 2, 4}, {0.9, 0.7, 0.5});
  EXPECT_EQ(e(0), 0.9);
  EXPECT_EQ(e(1), 0.9);
  EXPECT_NEAR(e(1.25), 0.85, 1e-15);
  EXPECT_NEAR(e(3), 0.6, 1e-15);
  EXPECT_EQ(e(4), 0.5);
  EXPECT_EQ(e(100), 0.5);
  EXPECT_FALSE(e.is_elastic());
  EXPECT_TRUE(NormalRestitution::tabulated({1, 2}, {1, 1}).is_elastic());
}

// The coefficient of restitution of spheres of this material, from the integrated head-on impact.
double integrated(const Viscoelastic& material, double speed) {
  const ContactPair pair = contact_pair(1e6, 1, 1e6, 1);  // flat: nothing passes through
  return -integrate_contact<Viscoelastic>(scaled_impact(material, pair, speed, 0)).rate;
}

TEST(NormalRestitution, OfViscoelasticSpheresIsThatOfTheirContact) {
  const Viscoelastic material{1e3, 0.3, 1e-3};
  for (const double given : {0.01, 1., 30.}) {
    const auto e = NormalRestitution::viscoelastic(integrated(material, given), given);
    for (const double speed : {1e-6, 0.003, 0.5, 1., 7., 400.})
      EXPECT_NEAR(e(speed), integrated(material, speed), 2e-9) << given << ' ' << speed;
  }
}

// Schwager and Pöschel 1998, for weak dissipation: 1 − e = C₁ a u^(1/5) − C₂ a² u^(2/5) …, C₂ = 3 C₁²/5.
TEST(NormalRestitution, OfViscoelasticSpheresHasTheKnownExpansion) {
  const auto e = NormalRestitution::viscoelastic(0.99, 1);
  const auto expanded = [](double x) { return x - 0.6 * x * x; };
  const double x = (1 - std::sqrt(1 - 4 * 0.6 * 0.01)) / 1.2;  // of e = 0.99
  for (const double speed : {1e-5, 0.01, 1., 10.})
    EXPECT_NEAR((1 - e(speed)) / expanded(x * std::pow(speed, 0.2)), 1, 1e-3) << speed;
}

TEST(ContactLaws, AreSymmetric) {
  ContactLaws laws(2, {0.5});
  laws.set(1, 0, {1, 0.3, 0.2});
  EXPECT_EQ(laws.of(0, 1).friction, 0.3);
  EXPECT_EQ(laws.of(1, 0).friction, 0.3);
  EXPECT_EQ(laws.of(1, 1).restitution(1), 0.5);
  EXPECT_TRUE(laws.are_rough());
  EXPECT_TRUE(laws.are_inelastic());
  EXPECT_FALSE(laws.are_the_same());
  EXPECT_FALSE(ContactLaws().are_rough());
  EXPECT_FALSE(ContactLaws().are_inelastic());
}

}  // namespace
}  // namespace vitrel

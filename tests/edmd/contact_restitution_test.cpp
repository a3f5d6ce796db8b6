#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random/stream.h"
#include "edmd/soft/contact_integration.h"
#include "edmd/soft/linear_dashpot.h"
#include "edmd/soft/viscoelastic.h"
#include "tests/support/plain_contact.h"
#include "tests/support/soft_particles.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;

double tangent_of(double eccentricity) {
  return eccentricity / std::sqrt(1 - eccentricity * eccentricity);
}

ScaledImpact impact(double distance, double eccentricity, double damping) {
  return {distance, distance * tangent_of(eccentricity), damping};
}

void expect_relative(double value, double expected, double tolerance) {
  EXPECT_NEAR(value, expected, tolerance * std::abs(expected));
}

// Head-on and hard: the distance does not matter.
constexpr ScaledImpact head_on(double damping) {
  return {1e6, 0, damping};
}

template <class Force>
class EveryForce : public testing::Test {};
using Forces = testing::Types<LinearDashpot, Viscoelastic>;
TYPED_TEST_SUITE(EveryForce, Forces);

// Schwager & Pöschel 2007: the coefficient of restitution with the premature end, c_dis = 2β/ω₀.
double linear_dashpot_restitution(double damping) {
  const double beta = damping / 2, omega = std::sqrt(std::abs(1 - beta * beta));
  if (beta < std::numbers::sqrt2 / 2)
    return std::exp(-beta / omega *
                    (pi - std::atan(2 * beta * omega / (omega * omega - beta * beta))));
  if (beta < 1)
    return std::exp(-beta / omega * std::atan(2 * beta * omega / (beta * beta - omega * omega)));
  if (beta == 1) return std::exp(-2);
  return std::exp(-beta / omega * 2 * std::log(beta + omega));  // (β + ω)(β − ω) = 1
}

TEST(LinearDashpotRestitution, HeadOnIsTheClosedForm) {
  for (const double damping : {1e-6, 0.1, 0.5, 1.0, 1.4, 1.45, 1.9, 2.0, 2.1, 5.0, 50.0, 1000.0}) {
    SCOPED_TRACE(damping);
    const Restitution found = integrate_contact<LinearDashpot>(head_on(damping));
    expect_relative(found.rate, -linear_dashpot_restitution(damping), 1e-12);
    EXPECT_EQ(found.angle, 0);
    EXPECT_NEAR(1 - found.distance, damping * linear_dashpot_restitution(damping) / 1e6, 1e-15);
  }
  expect_relative(integrate_contact<LinearDashpot>(head_on(0.1)).duration, 3.045360022, 1e-9);
  expect_relative(integrate_contact<LinearDashpot>(head_on(1)).duration, 2.418399152, 1e-9);
  expect_relative(integrate_contact<LinearDashpot>(head_on(2)).duration, 2, 1e-12);
}

TEST(ViscoelasticRestitution, HeadOn) {
  expect_relative(integrate_contact<Viscoelastic>(head_on(0.1)).rate, -0.892858876, 1e-9);
  expect_relative(integrate_contact<Viscoelastic>(head_on(1)).rate, -0.393930603, 1e-9);
  // Elastic: τ = 2∫dξ/√(1 − (4/5) ξ^(5/2)) = 2 (5/4)^(2/5) (2/5) B(2/5, 1/2).
  const double duration = 0.8 * std::pow(1.25, 0.4) * std::beta(0.4, 0.5);
  EXPECT_NEAR(duration, 3.2180654597, 1e-10);
  expect_relative(integrate_contact<Viscoelastic>(head_on(0)).duration, duration, 1e-12);
}

template <class Force>
void expect_coefficients(const ScaledImpact& of, const Restitution& expected, double tolerance) {
  const Restitution found = integrate_contact<Force>(of);
  EXPECT_NEAR(found.distance, expected.distance, tolerance);
  EXPECT_NEAR(found.angle, expected.angle, tolerance);
  EXPECT_NEAR(found.duration, expected.duration, tolerance);
  EXPECT_NEAR(found.rate, expected.rate, tolerance);
}

// The values are those of an independent integration, to the digits given.
TEST(Restitution, ObliqueReferenceValues) {
  expect_coefficients<LinearDashpot>(impact(10, 0.5, 0.2),
                                     {0.985005066, 0.185758530, 2.861236631, -0.749746697}, 6e-10);
  expect_coefficients<Viscoelastic>(impact(10, 0.5, 0.2),
                                    {0.983858836, 0.200069121, 3.026685354, -0.807058208}, 6e-10);
}

// Figure 6 of the source in SI units.
TEST(Restitution, TheSourcesPairOfSpheres) {
  const double speed = 5, eccentricity = 0.3;
  const ContactPair pair = contact_pair(0.1, sphere_mass(0.1), 0.1, sphere_mass(0.1));
  const LinearDashpot force{2000};
  const double normal_speed = speed * std::sqrt(1 - eccentricity * eccentricity);
  const ScaledImpact scaled = scaled_impact(force, pair, normal_speed, speed * eccentricity);
  EXPECT_NEAR(scaled.distance, 1.2135915965, 1e-10);
  EXPECT_NEAR(scaled.angular_momentum, 0.3816569006, 1e-10);
  EXPECT_EQ(scaled.damping, 0);
  expect_coefficients<LinearDashpot>(scaled, {1, 1.7243731112, 2.1182452973, -1}, 6e-11);
  EXPECT_NEAR(
      integrate_contact<LinearDashpot>(scaled).duration * force.scales(normal_speed, pair).time,
      0.07318852, 5e-9);
}

TYPED_TEST(EveryForce, ScalesMakeTheForceDimensionless) {
  const ContactPair pair = contact_pair(0.002, 3e-5, 0.005, 4e-4);
  const TypeParam force = [] {
    if constexpr (std::is_same_v<TypeParam, LinearDashpot>)
      return LinearDashpot{3000, 0.2};
    else
      return Viscoelastic{2e8, 0.3, 1e-4};
  }();
  const double speed = 0.7;
  const ContactScales scales = force.scales(speed, pair);
  expect_relative(scales.length / scales.time, speed, 1e-14);
  for (const double s : {0.1, 0.9, 1.3})
    for (const double rate : {-1.0, 0.0, 0.6}) {
      const double scaled = TypeParam::profile(s) * (TypeParam::elastic(s) + scales.damping * rate);
      expect_relative(force.force(s * s * scales.length, rate * speed, pair) *
                          std::pow(scales.time, 2) / (pair.mass * scales.length),
                      scaled, 1e-12);
      expect_relative((TypeParam::elastic(s * 1.001) - TypeParam::elastic(s * 0.999)) / (0.002 * s),
                      TypeParam::elastic_slope(s), 1e-5);
      expect_relative(TypeParam::elastic_inverse(TypeParam::elastic(s)), s, 1e-15);
    }
  const ContactScales faster = force.scales(10 * speed, pair);
  expect_relative(scales.length / faster.length, std::pow(10, -2 * TypeParam::length_exponent),
                  1e-12);
  expect_relative(faster.damping / scales.damping,
                  std::pow(scales.length / faster.length, -TypeParam::damping_exponent), 1e-12);
}

TYPED_TEST(EveryForce, AgreesWithAnIndependentIntegration) {
  Stream draw(4, Purpose::tests);
  for (int trial = 0; trial < 20; ++trial) {
    const double distance = std::exp(draw.uniform(1, 7)), eccentricity = draw.uniform(0.01, 0.95);
    const ScaledImpact of = impact(distance, eccentricity, std::exp(draw.uniform(-4, 2)));
    SCOPED_TRACE(testing::Message() << "l = " << of.distance << ", c_φ = " << of.angular_momentum
                                    << ", c_dis = " << of.damping);
    const Restitution found = integrate_contact<TypeParam>(of);
    const Restitution expected = PlainContact<TypeParam>(of)();
    expect_relative(found.distance, expected.distance, 1e-13);
    expect_relative(found.angle, expected.angle, 1e-12);
    expect_relative(found.duration, expected.duration, 1e-12);
    expect_relative(found.rate, expected.rate, 1e-12);
  }
}

// E(l − r) = c_dis r' at the end, whatever the damping.
TYPED_TEST(EveryForce, EndsWhereTheForceVanishes) {
  for (const double damping : {1e-12, 1e-4, 0.3, 1.0, 3.0, 100.0})
    for (const double distance : {0.3, 2.5, 40.0})
      for (const double eccentricity : {0.01, 0.6, 0.99}) {
        const Restitution end =
            integrate_contact<TypeParam>(impact(distance, eccentricity, damping));
        EXPECT_NEAR(distance * (1 - end.distance), -damping * end.rate, 1e-12)
            << distance << ' ' << eccentricity << ' ' << damping;
        EXPECT_LT(end.rate, 0);
      }
}

// Damping so strong that E + c_dis u is lost in the rounding of u: hard and head-on the linear dashpot
// has τ = (1/ω) artanh(2βω/(ω² + β²)) = ln((β + ω)/(β − ω))/(2ω).
TEST(Restitution, RefusesWhatIsNoNumber) {
  EXPECT_THROW(integrate_contact<LinearDashpot>({std::nan(""), 1, 0}), InvariantError);
}

TEST(LinearDashpotRestitution, DurationUnderStrongDamping) {
  for (const double damping : {10.0, 1e3, 1e5}) {
    const double beta = damping / 2, omega = std::sqrt(beta * beta - 1);
    const double duration = std::log(std::pow(beta + omega, 2)) / omega;
    expect_relative(integrate_contact<LinearDashpot>(head_on(damping)).duration, duration, 1e-12);
  }
}

// Next to nothing is lost: the general way through the integration conserves energy and takes as long as
// the elastic one, whose ε_r and ε_ṙ are not taken from it.
TYPED_TEST(EveryForce, ElasticContactsConserveEnergy) {
  Stream draw(5, Purpose::tests);
  for (int trial = 0; trial < 200; ++trial) {
    const double distance = std::exp(draw.uniform(-2, 14));
    ScaledImpact of = impact(distance, draw.uniform(0.01, 0.99), 1e-30);
    const Restitution nearly = integrate_contact<TypeParam>(of);
    EXPECT_NEAR(nearly.rate, -1, 1e-13);
    EXPECT_NEAR(nearly.distance, 1, 1e-14);
    of.damping = 0;
    const Restitution elastic = integrate_contact<TypeParam>(of);
    EXPECT_EQ(elastic.distance, 1);
    EXPECT_EQ(elastic.rate, -1);
    expect_relative(elastic.duration, nearly.duration, 1e-13);
    expect_relative(elastic.angle, nearly.angle, 1e-13);
  }
}

// The line of centres does not turn: ε_φ l/c_φ = ε_t/l up to ξ/l, and ε_ṙ as head-on.
TYPED_TEST(EveryForce, HardLimit) {
  for (const double damping : {0.0, 0.5}) {
    const double head_on_rate = integrate_contact<TypeParam>(head_on(damping)).rate;
    for (const double distance : {1e4, 1e6}) {
      const Restitution found = integrate_contact<TypeParam>(impact(distance, 0.6, damping));
      expect_relative(found.angle, 0.75 * found.duration / distance, 2 / distance);
      EXPECT_NEAR(found.rate, head_on_rate, 1 / distance);
    }
  }
}

// A grazing pair hardly feels the force: it flies straight through the corner of 2 (π/2 − asin e).
TYPED_TEST(EveryForce, GrazingIsAFlightPast) {
  const double eccentricity = 0.999999;
  const Restitution found = integrate_contact<TypeParam>(impact(2, eccentricity, 0));
  expect_relative(found.angle, 2 * std::acos(eccentricity), 1e-4);
}

// Soft particles fly through each other, the nearer to the centre the straighter. Where the force is finite at
// r = 0, an impact parameter b deflects by some b ln(1/b).
TYPED_TEST(EveryForce, SoftAndHeadOnIsALimit) {
  for (const double distance : {0.3, 0.9, 1.5, 4.0}) {
    const Restitution head = integrate_contact<TypeParam>({distance, 0, 0.01});
    const Restitution near = integrate_contact<TypeParam>({distance, 1e-9 * distance, 0.01});
    EXPECT_EQ(head.angle, distance < 1 ? pi : 0);
    EXPECT_NEAR(near.angle, head.angle, 1e-6);
    EXPECT_NEAR(near.rate, head.rate, 1e-9);
    EXPECT_NEAR(near.duration, head.duration, 1e-8);
  }
}

// A further force takes one type: Hertz's, with a damping ∝ ξ^(1/4) that makes the coefficient of restitution
// the same at all speeds (Tsuji, Tanaka & Ishida 1992). In ζ = (4/5)^(1/2) ξ^(5/4) and dt' = (5/4)^(1/2) ξ^(1/4) dt
// it is the linear dashpot with c_dis (4/5)^(1/2): with x' = dx/dt', ζ' = ξ̇ and ζ'' = −ζ − c_dis (4/5)^(1/2) ζ'.
struct Tsuji {
  static constexpr std::string_view name = "tsuji";
  static constexpr double length_exponent = 0.4;
  static constexpr double damping_exponent = 0;
  double stiffness, damping;

  double force(double compression, double rate, const ContactPair&) const {
    return stiffness * std::pow(compression, 1.5) + damping * std::pow(compression, 0.25) * rate;
  }
  ContactScales scales(double speed, const ContactPair& pair) const {
    const double time = std::pow(stiffness / pair.mass, -0.4) * std::pow(speed, -0.2);
    return {time, speed * time, damping / std::sqrt(stiffness * pair.mass)};
  }
  static double profile(double s) { return std::sqrt(std::abs(s)); }
  static double elastic(double s) { return s * s * std::sqrt(std::abs(s)); }
  static double elastic_slope(double s) { return 2.5 * s * std::sqrt(std::abs(s)); }
  static double elastic_inverse(double elastic) { return std::pow(elastic, 0.4); }
};
static_assert(ContactForce<Tsuji>);

TEST(FurtherForce, HasOneCoefficientAtAllSpeeds) {
  const ContactPair pair = contact_pair(0.01, 1e-3, 0.01, 1e-3);
  const Tsuji force{1e9, 200};
  for (const double speed : {1e-4, 1.0}) {
    const ScaledImpact scaled = scaled_impact(force, pair, speed, 0);
    const double expected = linear_dashpot_restitution(scaled.damping * std::sqrt(0.8));
    expect_relative(integrate_contact<Tsuji>(scaled).rate, -expected, 1e-9);
    EXPECT_GT(scaled.damping, 0.1);
  }
}

}  // namespace
}  // namespace vitrel

// The predictor of the engine against the reference.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bench/methods/collision_case.h"
#include "bench/surveys/true_contact.h"
#include "core/contact/first_contact.h"
#include "core/geometry/free_flight.h"
#include "core/random/stream.h"
#include "core/tolerances.h"

namespace vitrel {
namespace {

using Truth = bench::TrueContact::Outcome;

bench::TrueContact true_first_contact(const Flight<Ellipse>& one, const Flight<Ellipse>& two,
                                      double horizon) {
  return bench::true_first_contact(bench::of_constant_size(one), bench::of_constant_size(two),
                                   horizon);
}

struct Pair {
  Flight<Ellipse> one, two;
  double contact_gap() const { return tolerance::contact_gap(one.body.a + two.body.a); }
};

Ellipse random_ellipse(Stream& draw, double largest_aspect_ratio, double size_ratio) {
  const double b = std::pow(size_ratio, draw.uniform(-0.5, 0.5));
  return {b * std::pow(largest_aspect_ratio, draw.uniform()), b};
}

Motion2 random_motion(Stream& draw) {
  return {{draw.normal(), draw.normal()}, 2 * draw.normal()};
}

Pair random_pair(Stream& draw, double largest_aspect_ratio, double size_ratio) {
  const Ellipse e1 = random_ellipse(draw, largest_aspect_ratio, size_ratio);
  const Ellipse e2 = random_ellipse(draw, largest_aspect_ratio, size_ratio);
  const double distance = draw.uniform(0.2, 1.2) * (e1.a + e2.a);
  const double angle = draw.uniform(0, 2 * std::numbers::pi);
  return {{e1, {{0, 0}, draw.uniform(0, 7)}, random_motion(draw)},
          {e2,
           {distance * Vec2(std::cos(angle), std::sin(angle)), draw.uniform(0, 7)},
           random_motion(draw)}};
}

// The scene of the thesis's appendix B.1 (reference value in extended precision).
TEST(TrueFirstContact, SceneOfAppendixB1) {
  const Flight<Ellipse> one{{1, 0.5}, {{0, 0}, 0}, {{0, 0}, 0}};
  const Flight<Ellipse> two{{1, 0.5}, {{1, 1}, 0}, {{-1, 0}, std::numbers::pi}};
  const auto truth = true_first_contact(one, two, 2);
  ASSERT_EQ(truth.outcome, Truth::contact);
  EXPECT_NEAR(static_cast<double>(truth.time), 0.08472238582199765, 1e-16);
}

TEST(TrueFirstContact, DisksInClosedForm) {
  const Flight<Ellipse> one{{1, 1}, {{0, 0}, 0}, {{0.5, 0}, 0}};
  const Flight<Ellipse> two{{2, 2}, {{7, 1}, 0}, {{-1.5, 0}, 3}};
  const auto truth = true_first_contact(one, two, 10);
  ASSERT_EQ(truth.outcome, Truth::contact);
  EXPECT_NEAR(static_cast<double>(truth.time), (7 - std::sqrt(8.0)) / 2, 1e-15);
}

// A gap of 1e-9 at the closest approach is a miss, an overlap of 1e-9 a hit.
TEST(TrueFirstContact, TellsAGrazeFromAMiss) {
  for (const double gap : {1e-9, -1e-9}) {
    const Flight<Ellipse> one{{2, 1}, {{0, 0}, 0}, {{0, 0}, 0}};
    const Flight<Ellipse> two{{2, 1}, {{-5, 2 + gap}, 0}, {{1, 0}, 0}};
    EXPECT_EQ(true_first_contact(one, two, 10).outcome, gap > 0 ? Truth::none : Truth::contact);
  }
}

struct Class {
  double largest_aspect_ratio, size_ratio;
  int pairs;
};
void PrintTo(const Class& at, std::ostream* out) {
  *out << "aspect ratios to " << at.largest_aspect_ratio << ", sizes 1 : " << at.size_ratio;
}

class Predictor : public testing::TestWithParam<Class> {};

// Speed at which the surfaces approach each other at the predicted contact.
double approach_speed(const Pair& pair, const Prediction2& contact) {
  const auto surface_velocity = [&](const Flight<Ellipse>& flight) -> Vec2 {
    const Vec2 centre = advanced(flight.pose, flight.motion, contact.time).position;
    return flight.motion.velocity +
           flight.motion.angular_velocity * perpendicular(contact.point - centre);
  };
  return (surface_velocity(pair.one) - surface_velocity(pair.two)).dot(contact.normal);
}

// Never late and never missed; nothing reported that is not there. A contact is declared at 1 to 1.25
// contact gaps, so it comes early by at most 1.25 gap/speed to first order; twice that where the speed is
// so high that its change on the way does not matter (speed² ≫ gap, all but a few).
TEST_P(Predictor, IsNeverLateNeverWrongAgainstTheTruth) {
  Stream draw(5, Purpose::tests);
  const double horizon = 2;
  int contacts = 0, misses = 0, judged = 0;
  for (int trial = 0; trial < GetParam().pairs; ++trial) {
    const Pair pair = random_pair(draw, GetParam().largest_aspect_ratio, GetParam().size_ratio);
    const auto truth = true_first_contact(pair.one, pair.two, horizon);
    const Prediction2 found = first_contact(pair.one, pair.two, horizon, pair.contact_gap());
    ASSERT_NE(truth.outcome, Truth::undecided);
    ASSERT_EQ(truth.outcome == Truth::overlap_at_start, found.outcome == Outcome::overlap);
    ASSERT_EQ(truth.outcome == Truth::contact, found.outcome == Outcome::contact) << trial;
    contacts += truth.outcome == Truth::contact;
    misses += truth.outcome == Truth::none;
    if (truth.outcome != Truth::contact) continue;
    const double early = static_cast<double>(truth.time - found.time);
    EXPECT_GE(early, 0) << "late";
    const double speed = approach_speed(pair, found);
    EXPECT_GT(speed, 0);
    if (speed < 1e-4) continue;
    ++judged;
    EXPECT_LE(early, 2.5 * pair.contact_gap() / speed + 1e-15 * horizon);
  }
  EXPECT_GT(judged, 0.99 * contacts);
  EXPECT_GT(contacts, GetParam().pairs / 20);
  EXPECT_GT(misses, GetParam().pairs / 20);
}

INSTANTIATE_TEST_SUITE_P(Classes, Predictor,
                         testing::Values(Class{2, 1, 10'000}, Class{20, 1, 5'000},
                                         Class{100, 100, 5'000}));

}  // namespace
}  // namespace vitrel

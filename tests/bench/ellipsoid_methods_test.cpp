// The collision times of ellipsoids: the truth, the default method on every class, and what the root
// finders miss.

#include <gtest/gtest.h>

#include <cmath>

#include "bench/methods/ellipsoids/roots.h"
#include "bench/methods/method.h"
#include "bench/methods/opening.h"
#include "bench/surveys/verdict.h"
#include "core/contact/ellipsoid_eta.h"
#include "core/geometry/free_flight.h"
#include "tests/support/case_classes.h"

namespace vitrel::bench {
namespace {

using Truth = TrueEllipsoidContact::Outcome;

constexpr std::uint64_t seed = 1;
constexpr std::uint64_t pairs = 2000;

// ---- The truth ----

Flight<GrowingEllipsoid> ball(double radius, double growth, const Vec3& position,
                              const Vec3& velocity) {
  return {{{Vec3::Constant(radius)}, 1, growth},
          {position, Quaternion::Identity()},
          {velocity, Vec3(1, 2, 3)}};
}

TEST(TrueContactOfSolids, SpheresInClosedForm) {
  // 10 − 2 t = (1 + 2)(1 + t/2)
  const TrueEllipsoidContact growing = true_first_contact(ball(1, 0.5, {0, 0, 0}, {0, 0, 0}),
                                                          ball(2, 0.5, {10, 0, 0}, {-2, 0, 0}), 10);
  ASSERT_EQ(growing.outcome, Truth::contact);
  EXPECT_LT(growing.uncertainty, 1e-15);
  EXPECT_LE(std::abs(growing.time - 2), growing.uncertainty);
  EXPECT_NEAR(growing.approach_speed, 3.5, 1e-15);
  EXPECT_NEAR((growing.normal - Vec3::UnitX()).norm(), 0, 1e-15);
  // |(4 − t, 1)| = 2
  const auto still = ball(1, 0, {0, 0, 0}, {0, 0, 0});
  const TrueEllipsoidContact passing =
      true_first_contact(still, ball(1, 0, {4, 1, 0}, {-1, 0, 0}), 10);
  EXPECT_LT(passing.uncertainty, 1e-15);
  EXPECT_LE(std::abs(passing.time - (4 - std::sqrt(3.0L))), passing.uncertainty);
  EXPECT_EQ(true_first_contact(still, ball(1, 0, {4, 2.001, 0}, {-1, 0, 0}), 10).outcome,
            Truth::none);
  EXPECT_EQ(true_first_contact(still, ball(1, 0, {1, 1, 0}, {1, 0, 0}), 10).outcome,
            Truth::overlap_at_start);
}

// About a principal axis Euler's equations leave ω constant; the two references integrate and rotate independently.
TEST(TrueContactOfSolids, UniformTumblingIsAConstantAngularVelocity) {
  const auto scalene = [](const Vec3& semi_axes, const Vec3& position, const Vec3& velocity,
                          const Vec3& omega) -> Flight<GrowingEllipsoid> {
    return {{{semi_axes}, 1, 0}, {position, Quaternion::Identity()}, {velocity, omega}};
  };
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 spin = 7 * Vec3::Unit(axis);
    EllipsoidCase pair{scalene({3, 1, 0.4}, {0, 0, 0}, {0, 0, 0}, spin),
                       scalene({0.5, 1, 2}, {6, 0.3, 0.2}, {-1, 0, 0}, -spin), 10};
    const TrueEllipsoidContact constant = truth_of(pair);
    let_tumble(pair);
    const TrueEllipsoidContact tumbling = truth_of(pair);
    ASSERT_EQ(constant.outcome, Truth::contact);
    ASSERT_EQ(tumbling.outcome, Truth::contact);
    // Rounding of the attitude after some 40 rad, times 3 units of length, over the speed of approach.
    const double rounding = 200 * 1e-19 / constant.approach_speed;
    EXPECT_NEAR(static_cast<double>(tumbling.time - constant.time), 0,
                static_cast<double>(tumbling.uncertainty + constant.uncertainty) + rounding);
    // The normal is where a function is largest: known to the root of the rounding. It turns with surfaces at 7 · 5.
    const double normal_error = std::sqrt(1e-19);
    EXPECT_NEAR((tumbling.normal - constant.normal).norm(), 0, normal_error);
    EXPECT_NEAR(tumbling.approach_speed, constant.approach_speed, 35 * normal_error);
  }
}

/// The surfaces nearly touch at the start and move apart.
bool leaves(const CaseClassOf<3>& of) {
  return of.name == "touching_leaving" || of.name == "tumbling_leaving";
}

/// The completed criterion in 80-bit arithmetic; poses from those of the methods, in double.
bool overlap_by_criterion(const EllipsoidCase& asked, long double time) {
  using Vector = Eigen::Matrix<long double, 3, 1>;
  const auto at = static_cast<double>(time);
  const EllipsoidAxes<long double> one(body_at(asked.one, at), pose_at(asked, 0, at).orientation),
      two(body_at(asked.two, at), pose_at(asked, 1, at).orientation);
  const Vector d =
      (asked.two.pose.position - asked.one.pose.position).cast<long double>() +
      (asked.two.motion.velocity - asked.one.motion.velocity).cast<long double>() * time;
  return !ellipsoid_eta<long double>(one, two, d).disjoint_or_touching();
}

// A scan and a bisection that know nothing of axes and bounds. Poses in double limit what they can see to
// some 1e-15 of the reach, thus 1e-12 of the horizon where the surfaces cross at speed.
TEST(TrueContactOfSolids, ScansAndBisectionSayTheSame) {
  constexpr int samples = 1000;
  int contacts = 0;
  for (const CaseClassOf<3>& of : stability_suite<3>()) {
    if (leaves(of)) continue;  // its gap is that of the roundings
    for (std::uint64_t index = 0; index < 40; ++index) {
      const EllipsoidCase asked = make_case(of, seed + 1, index);
      const TrueEllipsoidContact truth = truth_of(asked);
      const bool touches = truth.outcome == Truth::contact;
      const auto end = touches ? static_cast<double>(truth.time) : asked.horizon;
      const double near = 1e-11 * asked.horizon;
      for (int k = 0; k < samples; ++k)
        ASSERT_FALSE(overlap_by_criterion(asked, (end - near) * k / samples))
            << of.name << ' ' << index << ": overlap before " << end;
      if (!touches || truth.approach_speed < 0.02 * asked.reach() / asked.horizon) continue;
      ++contacts;
      double low = end - near, high = end + near;
      ASSERT_TRUE(overlap_by_criterion(asked, high)) << of.name << ' ' << index;
      for (int k = 0; k < 40; ++k) {
        const double middle = 0.5 * (low + high);
        (overlap_by_criterion(asked, middle) ? high : low) = middle;
      }
      EXPECT_NEAR(high, end, 1e-12 * asked.horizon) << of.name << ' ' << index;
    }
  }
  EXPECT_GT(contacts, 80);
}

TEST(TrueContactOfSolids, ShortOverlapsHaveTheLengthOfTheParabola) {
  for (const double depth : {1e-4, 1e-8, 1e-12, 1e-16}) {
    const TrueEllipsoidContact truth = truth_of(passing_pair(depth));
    const double stored = 2 - (2 - depth);
    if (stored == 0) {
      EXPECT_EQ(truth.outcome, Truth::undecided);
      continue;
    }
    ASSERT_EQ(truth.outcome, Truth::contact) << depth;
    const double half = 0.5 * std::sqrt(50 * stored);
    EXPECT_NEAR(static_cast<double>(3 - truth.time), half,
                half * stored + static_cast<double>(truth.uncertainty) + 1e-15);
    EXPECT_NEAR(static_cast<double>(true_gap(passing_pair(depth).one, passing_pair(depth).two, 3)),
                -stored, 1e-18 + 1e-9 * stored);
  }
  EXPECT_EQ(truth_of(passing_pair(-1e-12)).outcome, Truth::none);
}

// I₃(I₃ − I₂) ω₃² = I₁(I₂ − I₁) ω₁² up to a factor (1 ± 0.1)².
TEST(TumblingClasses, NearSeparatrixHasTheEnergyOfTheMiddleAxis) {
  for_cases<3>("tumbling_near_separatrix", seed, 100, [](const EllipsoidCase& asked) {
    for (const Flight<TumblingEllipsoid>& flight : asked.tumbling) {
      const Vec3 moments = flight.body.shape.inertia_per_mass();
      const Vec3 own = flight.pose.orientation.conjugate() * flight.motion.angular_velocity;
      const double middle = moments.sum() - moments.minCoeff() - moments.maxCoeff();
      double slow = 0, fast = 0;
      for (int k = 0; k < 3; ++k) {
        const double excess = moments[k] * (moments[k] - middle) * own[k] * own[k];
        (excess > 0 ? fast : slow) += std::abs(excess);
      }
      EXPECT_NEAR(fast / slow, 1, 0.2101);
    }
  });
}

// Close to the separatrix rounding of the initial state moves the contact by some 1e-10, of which ten are allowed.
TEST(TumblingClasses, AreAsWellKnownAsTheirInitialState) {
  for (const CaseClassOf<3>& of : classes_named<3>("tumbling_near_separatrix")) {
    if (of.aspect_ratio != 20) continue;
    constexpr std::uint64_t sensitive = 16'201;
    const EllipsoidCase asked = make_case(of, seed, sensitive);
    const TrueEllipsoidContact truth = truth_of(asked);
    ASSERT_EQ(truth.outcome, Truth::contact);
    const auto verdict = [&](double off) {
      Prediction3 answer;
      answer.outcome = Outcome::contact;
      answer.time = static_cast<double>(truth.time) + off;
      return assess(asked, truth, answer, {1e-12, 1e-8}).verdict;
    };
    EXPECT_EQ(verdict(1e-9), Verdict::correct);
    EXPECT_EQ(verdict(-1e-9), Verdict::correct);
    EXPECT_EQ(verdict(1e-7), Verdict::late);
    EXPECT_EQ(verdict(-1e-7), Verdict::early);
  }
}

// ---- The methods ----

class DefaultMethodOfSolids : public testing::TestWithParam<NamedClass<3>> {};

TEST_P(DefaultMethodOfSolids, IsNeverWrong) {
  const CaseClassOf<3>& of = GetParam().of;
  // As for ellipses (default_method_test.cpp).
  constexpr AllowedError tolerance{1e-12, 1e-8};
  const MethodOf<3> method = collision_time_methods<3>().front();
  int contacts = 0, crossings = 0, undecided = 0;
  // There the reference takes some ten milliseconds for a pair.
  const std::uint64_t count = of.name == "tumbling_fast" ? pairs / 10 : pairs;
  for (std::uint64_t index = 0; index < count; ++index) {
    const EllipsoidCase asked = make_case(of, seed, index);
    const TrueEllipsoidContact truth = truth_of(asked);
    const Assessment assessment = assess(asked, truth, method.predict(asked), tolerance);
    contacts += truth.outcome == Truth::contact;
    undecided += truth.outcome == Truth::undecided;
    crossings += truth.outcome == Truth::contact && !assessment.degenerate;
    EXPECT_EQ(assessment.verdict, Verdict::correct) << "pair " << index;
  }
  EXPECT_EQ(undecided, 0);
  EXPECT_GE(contacts, leaves(of) ? 0 : count / 10);
  EXPECT_GE(crossings, leaves(of) ? 0 : count / 100);
}

INSTANTIATE_TEST_SUITE_P(Classes, DefaultMethodOfSolids, testing::ValuesIn(all_classes<3>()));

TEST(RootsOfSolids, ACloseDoublePairIsSteppedOver) {
  const EllipsoidCase asked = passing_pair(3e-5);
  const TrueEllipsoidContact truth = truth_of(asked);
  ASSERT_EQ(truth.outcome, Truth::contact);
  for (const MethodOf<3>& method : collision_time_methods<3>()) {
    const Prediction3 answer = method.predict(asked);
    if (method.name == "separating_axis") {
      EXPECT_EQ(answer.outcome, Outcome::contact);
      EXPECT_NEAR(answer.time, static_cast<double>(truth.time),
                  1.25 * asked.contact_gap() / truth.approach_speed);
    } else {
      EXPECT_EQ(answer.outcome, Outcome::none) << method.name;
    }
  }
  // Steps that are short enough see it.
  for (auto* predict : {&eta_root, &perram_wertheim_root})
    EXPECT_NEAR((*predict)(asked, 1e-3).time, static_cast<double>(truth.time), 1e-12);
}

TEST(RootsOfSolids, TheSignsOfContactFollowARootOfEta) {
  int found = 0;
  for (std::uint64_t index = 0; index < 300; ++index) {
    const EllipsoidCase asked = make_case(stability_suite<3>().front(), seed, index);
    const TrueEllipsoidContact truth = truth_of(asked);
    const Prediction3 answer = eta_root(asked, 1e-3);
    if (truth.outcome != Truth::contact || answer.outcome != Outcome::contact) continue;
    ++found;
    EXPECT_NEAR(answer.time, static_cast<double>(truth.time), 1e-9);
    EXPECT_NEAR((answer.normal - truth.normal).norm(), 0, 1e-6);
  }
  EXPECT_GT(found, 60);
}

// η₁ vanishes at all times: its signs are those of rounding.
TEST(RootsOfSolids, ParallelBodiesOfOneShapeAreMissedByEta) {
  int contacts = 0, missed = 0;
  for_cases<3>("parallel_congruent", seed, 300, [&](const EllipsoidCase& asked) {
    if (truth_of(asked).outcome != Truth::contact) return;
    ++contacts;
    missed += eta_root(asked, 1e-2).outcome == Outcome::none;
  });
  EXPECT_GT(contacts, 60);
  EXPECT_GT(missed, contacts / 2);
}

}  // namespace
}  // namespace vitrel::bench

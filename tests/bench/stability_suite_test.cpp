// Every class of the stability suite keeps what it promises.

#include "bench/surveys/stability_suite.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "bench/surveys/drawn_class.h"
#include "bench/surveys/verdict.h"
#include "core/contact/ellipse_vieillard_baron.h"
#include "tests/support/case_classes.h"

namespace vitrel::bench {
namespace {

using Truth = TrueContact::Outcome;
constexpr std::uint64_t seed = 11;

// The local minima of the gap over the horizon, from samples and a ternary search.
std::vector<long double> min_gaps(const CollisionCase& of, int samples) {
  std::vector<long double> gaps, least;
  const long double step = static_cast<long double>(of.horizon) / samples;
  for (int k = 0; k <= samples; ++k) gaps.push_back(gap_at(of, k * step));
  for (int k = 1; k < samples; ++k) {
    if (gaps[k] > gaps[k - 1] || gaps[k] > gaps[k + 1]) continue;
    long double low = (k - 1) * step, high = (k + 1) * step;
    while (high - low > 1e-9L) {
      const long double left = low + (high - low) / 3, right = high - (high - low) / 3;
      const bool falls = gap_at(of, left) >= gap_at(of, right);
      (falls ? low : high) = falls ? left : right;
    }
    least.push_back(gap_at(of, low));
  }
  return least;
}

TEST(StabilitySuite, NamesAreUniqueWithTheirAspectRatio) {
  std::set<std::pair<std::string, double>> seen;
  for (const CaseClass& of : stability_suite())
    EXPECT_TRUE(seen.insert({of.name, of.aspect_ratio}).second) << of.name;
}

TEST(StabilitySuite, IsAFunctionOfItsKey) {
  for (const CaseClass& of : stability_suite()) {
    const auto facts = [&](std::uint64_t with_seed, std::uint64_t index) {
      const CollisionCase at = make_case(of, with_seed, index);
      return std::vector<double>{at.two.pose.position.x(), at.two.pose.angle,
                                 at.one.motion.velocity.y(), at.horizon};
    };
    EXPECT_EQ(facts(seed, 3), facts(seed, 3)) << of.name;
    EXPECT_NE(facts(seed, 3), facts(seed, 4)) << of.name;
    EXPECT_NE(facts(seed, 3), facts(seed + 1, 3)) << of.name;
  }
}

// Both answers occur, as often as the class allows; nothing overlaps that should not.
TEST(StabilitySuite, IsAMixOfContactsAndNone) {
  for (const CaseClass& of : stability_suite()) {
    constexpr int cases = 200;
    int contacts = 0, none = 0, overlaps = 0;
    for (int index = 0; index < cases; ++index) {
      const Truth truth = truth_of(make_case(of, seed, index)).outcome;
      contacts += truth == Truth::contact;
      none += truth == Truth::none;
      overlaps += truth == Truth::overlap_at_start;
    }
    if (of.name == "crossed_at_start") {
      EXPECT_EQ(overlaps, cases);
      continue;
    }
    EXPECT_LE(overlaps, of.name == "grazing" ? cases / 50 : 0) << of.name;
    EXPECT_GE(contacts, cases / 20) << of.name;
    if (of.name == "touching_approaching") {
      EXPECT_GE(contacts, 0.95 * cases);
    } else {
      EXPECT_GE(none, cases / 20) << of.name;
    }
  }
}

TEST(StabilitySuite, GenericIsAnEqualPairAtThermalSpeed) {
  for (const CaseClass& of : classes_named("generic")) {
    double squares = 0;
    constexpr int cases = 2000;
    for (int index = 0; index < cases; ++index) {
      const CollisionCase at = make_case(of, seed, index);
      EXPECT_DOUBLE_EQ(at.one.body.shape.aspect_ratio(), of.aspect_ratio);
      EXPECT_DOUBLE_EQ(at.two.body.shape.a * at.two.body.shape.b, 1);
      EXPECT_EQ(at.horizon, 2);
      EXPECT_FALSE(at.grows());
      squares += at.one.motion.angular_velocity * at.one.motion.angular_velocity;
    }
    // ⟨ω²⟩ = kT/I; the mean of N squares of normal numbers scatters by √(2/N): 5 of these.
    const double expected = 1 / make_case(of, seed, 0).one.body.shape.inertia_per_mass();
    EXPECT_NEAR(squares / cases, expected, 5 * std::sqrt(2.0 / cases) * expected);
  }
}

TEST(StabilitySuite, GrazingHasTheLeastGapItSays) {
  int inside = 0, outside = 0;
  for_cases("grazing", seed, 40, [&](const CollisionCase& at) {
    int fitting = 0;
    for (const long double gap : min_gaps(at, 300)) {
      const long double in_units = gap / at.gap_unit();
      if (std::abs(in_units) > 1.001e-3L || std::abs(in_units) < 0.99e-12L) continue;
      ++fitting;
      (in_units < 0 ? inside : outside) += 1;
    }
    EXPECT_GE(fitting, 1);
  });
  EXPECT_GT(inside, 20);
  EXPECT_GT(outside, 20);
}

TEST(StabilitySuite, FastRotationHasManyMinima) {
  for_cases("fast_rotation", seed, 20,
            [](const CollisionCase& at) { EXPECT_GE(min_gaps(at, 600).size(), 3U); });
}

TEST(StabilitySuite, AspectRatiosAndSizesReachTheirEnds) {
  double least = 1e9, most = 0, smallest = 1;
  for_cases("aspect_ratios", seed, 300, [&](const CollisionCase& at) {
    least = std::min(least, at.one.body.shape.aspect_ratio());
    most = std::max(most, at.two.body.shape.aspect_ratio());
  });
  for_cases("sizes", seed, 300, [&](const CollisionCase& at) {
    smallest = std::min(smallest, at.two.body.shape.a * at.two.body.shape.b);
  });
  EXPECT_LT(least, 1.2);
  EXPECT_GT(most, 80);
  EXPECT_LT(smallest, 1e-5);  // an area: the square of 1 : 300
  EXPECT_GE(smallest, 0.99e-6);
}

TEST(StabilitySuite, CrossedPairsHavePositivePsi) {
  for_cases("crossed_at_start", seed, 100, [](const CollisionCase& at) {
    EXPECT_GT(vieillard_baron(at.one.body.shape, at.one.pose.angle, at.two.body.shape,
                              at.two.pose.angle, at.two.pose.position - at.one.pose.position)
                  .psi,
              0);
    EXPECT_EQ(truth_of(at).outcome, Truth::overlap_at_start);
  });
}

TEST(StabilitySuite, TouchingPairsAreApartAndMoveAsTheySay) {
  for (const bool approaching : {false, true})
    for_cases(approaching ? "touching_approaching" : "touching_leaving", seed, 100,
              [&](const CollisionCase& at) {
                constexpr long double soon = 1e-9L;
                const long double start = gap_at(at, 0);
                EXPECT_GE(start, 0.25 * at.contact_gap());
                EXPECT_LE(start, 1.25 * at.contact_gap());
                EXPECT_EQ(start > gap_at(at, soon), approaching);
              });
}

TEST(StabilitySuite, SlowPairsMoveSlowly) {
  for_cases("slow", seed, 100, [](const CollisionCase& at) {
    EXPECT_LT((at.two.motion.velocity - at.one.motion.velocity).norm(), 2e-7);
    EXPECT_LT(std::abs(at.one.motion.angular_velocity), 2e-7);
    EXPECT_GT(at.one.motion.velocity.norm(), 1e-3);
    EXPECT_GT(gap_at(at, 0), 0);
  });
}

TEST(StabilitySuite, RoundAndNearlyRound) {
  for_cases("round", seed, 50, [](const CollisionCase& at) {
    EXPECT_TRUE(at.one.body.shape.is_round() && at.two.body.shape.is_round());
  });
  for_cases("nearly_circular", seed, 50, [](const CollisionCase& at) {
    EXPECT_NEAR(at.one.body.shape.aspect_ratio() - 1, 1e-12, 1e-15);
    EXPECT_NEAR(at.two.body.shape.aspect_ratio() - 1, 1e-12, 1e-15);
  });
}

/// check(case, true contact) of those of 100 cases that have a contact, which most have.
template <class Check>
void for_contacts(const std::string& name, const Check& check) {
  int contacts = 0;
  for_cases(name, seed, 100, [&](const CollisionCase& at) {
    const TrueContact truth = truth_of(at);
    if (truth.outcome != Truth::contact) return;
    ++contacts;
    check(at, truth);
  });
  EXPECT_GT(contacts, 50);
}

/// The angle of a body at the contact.
double angle_at(const Flight<GrowingEllipse>& flight, const TrueContact& truth) {
  return flight.pose.angle + flight.motion.angular_velocity * static_cast<double>(truth.time);
}

TEST(StabilitySuite, ParallelSidesMeetFlat) {
  for_contacts("parallel_sides", [](const CollisionCase& at, const TrueContact& truth) {
    const double angle = angle_at(at.one, truth);
    EXPECT_NEAR(angle, angle_at(at.two, truth), 3e-6);
    EXPECT_LT(std::abs(truth.normal.dot(unit(angle))), 0.6 / at.one.body.shape.aspect_ratio());
  });
}

TEST(StabilitySuite, TipsMeetAtTheTip) {
  for_contacts("tip", [](const CollisionCase& at, const TrueContact& truth) {
    EXPECT_GT(truth.normal.dot(unit(angle_at(at.one, truth))),
              std::cos(0.6 / at.one.body.shape.aspect_ratio()));
  });
}

TEST(StabilitySuite, LargeCoordinates) {
  for_cases("large_coordinates", seed, 20, [](const CollisionCase& at) {
    EXPECT_NEAR(at.one.pose.position.norm(), 1e6 * at.one.body.shape.a, 1);
    EXPECT_GT(gap_at(at, 0), 0);
  });
}

TEST(StabilitySuite, GrowthHasBothSignsAndPoints) {
  int points = 0, shrinking = 0, cases = 0;
  for_cases("growth", seed, 100, [&](const CollisionCase& at) {
    ++cases;
    EXPECT_TRUE(at.grows());
    for (const auto* body : {&at.one.body, &at.two.body}) {
      points += body->size == 0;
      shrinking += body->growth_rate < 0;
      EXPECT_GT(body->size_at(at.horizon), 0);
    }
  });
  EXPECT_NEAR(points, 0.3 * 2 * cases, 5 * std::sqrt(0.3 * 0.7 * 2 * cases));
  EXPECT_NEAR(shrinking, 0.35 * 2 * cases, 5 * std::sqrt(0.35 * 0.65 * 2 * cases));
}

}  // namespace
}  // namespace vitrel::bench

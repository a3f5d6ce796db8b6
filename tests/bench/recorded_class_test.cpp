// The questions of a real run, as a class of cases.

#include "bench/surveys/recorded_class.h"

#include <gtest/gtest.h>

#include "bench/methods/method.h"
#include "bench/surveys/verdict.h"

namespace vitrel::bench {
namespace {

using Truth = TrueContact::Outcome;
constexpr std::uint64_t seed = 5;

std::vector<double> facts(const CollisionCase& of) {
  return {of.one.pose.position.x(), of.one.pose.angle, of.two.pose.position.y(),
          of.two.motion.velocity.norm(), of.horizon};
}

TEST(RecordedClass, IsAFunctionOfItsKey) {
  const std::vector<CaseClass> classes = recorded_classes(), others = recorded_classes();
  ASSERT_EQ(classes.size(), 2u);
  for (std::size_t k = 0; k < classes.size(); ++k) {
    EXPECT_EQ(classes[k].name, "recorded");
    const std::vector<double> third = facts(make_case(classes[k], seed, 3));
    EXPECT_NE(third, facts(make_case(classes[k], seed, 4)));
    EXPECT_NE(third, facts(make_case(classes[k], seed + 1, 3)));
    make_case(others[k], seed, 20000);  // recorded farther at once
    EXPECT_EQ(third, facts(make_case(others[k], seed, 3)));
    EXPECT_EQ(third, facts(make_case(classes[k], seed, 3)));
    EXPECT_EQ(facts(make_case(classes[k], seed, 20000)), facts(make_case(others[k], seed, 20000)));
  }
  EXPECT_NE(classes[0].aspect_ratio, classes[1].aspect_ratio);
}

// In a hard run nothing overlaps, and the pair that has just collided is asked about again. The
// default method is right about every question that it steered the run by.
TEST(RecordedClass, IsAnsweredRightByTheDefaultMethod) {
  const Method method = collision_time_methods().front();
  for (const CaseClass& of : recorded_classes()) {
    int contacts = 0, none = 0, touching = 0;
    constexpr int cases = 4000;
    for (int index = 0; index < cases; ++index) {
      const CollisionCase asked = make_case(of, seed, static_cast<std::uint64_t>(index));
      EXPECT_DOUBLE_EQ(asked.one.body.shape.aspect_ratio(), of.aspect_ratio);
      EXPECT_FALSE(asked.grows());
      ASSERT_GE(asked.horizon, 0);
      const TrueContact truth = truth_of(asked);
      EXPECT_NE(truth.outcome, Truth::overlap_at_start) << index;
      contacts += truth.outcome == Truth::contact;
      none += truth.outcome == Truth::none;
      const double apart = static_cast<double>(true_gap(asked.one, asked.two, 0));
      touching += apart < 2 * asked.contact_gap();
      const AllowedError tolerance{1e-12, 1.375 * asked.contact_gap() / asked.gap_unit()};
      EXPECT_EQ(assess(asked, truth, method.predict(asked), tolerance).verdict, Verdict::correct)
          << index;
    }
    EXPECT_GT(contacts, cases / 20);
    EXPECT_GT(none, cases / 2);
    EXPECT_GT(touching, cases / 20);
  }
}

}  // namespace
}  // namespace vitrel::bench

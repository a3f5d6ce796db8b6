#include "bench/surveys/verdict.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vitrel::bench {
namespace {

using Truth = TrueContact::Outcome;

/// Two unit disks 4 apart that approach each other at `speed`: contact after 2/speed.
CollisionCase head_on(double speed, double horizon) {
  const auto disk = [](const Vec2& position, const Vec2& velocity) -> Flight<GrowingEllipse> {
    return {{{1, 1}, 1, 0}, {position, 0}, {velocity, 0}};
  };
  return {disk({0, 0}, {0, 0}), disk({4, 0}, {-speed, 0}), horizon};
}

Verdict verdict(const CollisionCase& asked, const Prediction2& answer,
                const AllowedError& tolerance = {}) {
  const TrueContact truth = truth_of(asked);
  return assess(asked, truth, answer, tolerance).verdict;
}

Prediction2 contact_at(double time) {
  return {Outcome::contact, time, {1, 0}, {1, 0}, 1};
}
const Prediction2 nothing{};
const Prediction2 gave_up{Outcome::not_converged, 0, {0, 0}, {0, 0}, 1};
const Prediction2 overlapping{Outcome::overlap, 0, {0, 0}, {0, 0}, 1};

TEST(Verdict, ContactAtOne) {
  const CollisionCase asked = head_on(2, 10);
  EXPECT_EQ(verdict(asked, contact_at(1)), Verdict::correct);
  EXPECT_EQ(verdict(asked, contact_at(1 + 9e-8)), Verdict::correct);
  EXPECT_EQ(verdict(asked, contact_at(1 - 9e-8)), Verdict::correct);
  EXPECT_EQ(verdict(asked, contact_at(1 + 2e-7)), Verdict::late);
  EXPECT_EQ(verdict(asked, contact_at(1 - 2e-7)), Verdict::early);
  EXPECT_EQ(verdict(asked, contact_at(std::nan(""))), Verdict::not_converged);
  EXPECT_EQ(verdict(asked, nothing), Verdict::missed);
  EXPECT_EQ(verdict(asked, gave_up), Verdict::not_converged);
  EXPECT_EQ(verdict(asked, overlapping), Verdict::false_contact);
}

TEST(Verdict, ErrorsAreThoseOfTheAnswer) {
  const CollisionCase asked = head_on(2, 10);
  const TrueContact truth = truth_of(asked);
  const Assessment of = assess(asked, truth, contact_at(0.75), {});
  EXPECT_NEAR(of.time_error, -0.25, 1e-15);
  EXPECT_NEAR(of.gap_error, 0.5, 1e-15);
  EXPECT_FALSE(of.degenerate);
  EXPECT_TRUE(std::isnan(assess(asked, truth, nothing, {}).time_error));
}

// Speed 1e-3 is below 0.02 · 2/horizon: early by 1e-5 is a gap of 1e-8, and that is what counts.
TEST(Verdict, DegenerateContactCountsByItsGap) {
  const CollisionCase asked = head_on(1e-3, 4);
  const CollisionCase there{asked.one, {asked.two.body, {{2 + 1e-3, 0}, 0}, asked.two.motion}, 4};
  const TrueContact truth = truth_of(there);
  ASSERT_EQ(truth.outcome, Truth::contact);
  const double time = static_cast<double>(truth.time);
  EXPECT_TRUE(assess(there, truth, contact_at(time), {}).degenerate);
  EXPECT_EQ(verdict(there, contact_at(time - 5e-6)), Verdict::correct);
  EXPECT_EQ(verdict(there, contact_at(time - 5e-5)), Verdict::early);
  EXPECT_EQ(verdict(there, contact_at(time + 5e-6)), Verdict::late);
}

TEST(Verdict, NoContact) {
  const CollisionCase apart = head_on(-1, 2);
  EXPECT_EQ(verdict(apart, nothing), Verdict::correct);
  EXPECT_EQ(verdict(apart, contact_at(1)), Verdict::false_contact);
  EXPECT_EQ(verdict(apart, overlapping), Verdict::false_contact);
  EXPECT_EQ(verdict(apart, gave_up), Verdict::not_converged);
  // A pass at a distance of 1e-9: its contact is within the tolerance, unless that is tightened.
  CollisionCase pass = head_on(2, 4);
  pass.two.pose.position.y() = 2 + 1e-9;
  EXPECT_EQ(verdict(pass, nothing), Verdict::correct);
  EXPECT_EQ(verdict(pass, contact_at(2)), Verdict::correct);
  EXPECT_EQ(verdict(pass, contact_at(2), {1e-8, 1e-10}), Verdict::false_contact);
}

TEST(Verdict, OverlapAtTheStart) {
  CollisionCase asked = head_on(1, 2);
  asked.two.pose.position = {1.5, 0};
  EXPECT_EQ(verdict(asked, overlapping), Verdict::correct);
  EXPECT_EQ(verdict(asked, contact_at(0)), Verdict::correct);
  EXPECT_EQ(verdict(asked, contact_at(1)), Verdict::missed);
  EXPECT_EQ(verdict(asked, nothing), Verdict::missed);
  EXPECT_EQ(verdict(asked, gave_up), Verdict::not_converged);
}

// Disks that touch at the closest approach, exactly: either answer will do there, none elsewhere.
TEST(Verdict, Undecided) {
  CollisionCase asked = head_on(1, 8);
  asked.two.pose.position.y() = 2;
  const TrueContact truth = truth_of(asked);
  ASSERT_EQ(truth.outcome, Truth::undecided);
  EXPECT_NEAR(static_cast<double>(truth.time), 4, 1e-8);
  EXPECT_TRUE(assess(asked, truth, nothing, {}).degenerate);
  EXPECT_EQ(verdict(asked, nothing), Verdict::correct);
  EXPECT_EQ(verdict(asked, contact_at(4)), Verdict::correct);
  EXPECT_EQ(verdict(asked, contact_at(3)), Verdict::false_contact);
}

}  // namespace
}  // namespace vitrel::bench

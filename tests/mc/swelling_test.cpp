#include "mc/swelling.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <vector>

#include "core/state/check.h"
#include "mc/insertion.h"
#include "tests/support/same_state.h"
#include "tests/support/scenes.h"

namespace vitrel {
namespace {

Configuration2 inserted(std::size_t n, const std::vector<Ellipse>& shapes) {
  Configuration2 c;
  c.resize(n);
  for (std::size_t i = 0; i < n; ++i) c.shape[i] = shapes[i % shapes.size()];
  insert_particles(c, {0.3, 100000, false}, 1, {});
  return c;
}

/// The end of a swelling that is not stopped.
struct Swollen : StageReport, SwellingState {};
Swollen swollen(Configuration2& c, double packing_fraction, std::uint64_t sweeps = 1'000'000) {
  Swollen result;
  static_cast<StageReport&>(result) = swell(c, {packing_fraction, sweeps}, 1, result, {});
  EXPECT_TRUE(exact_check(c).clean());
  return result;
}

struct Goal {
  std::vector<Ellipse> shapes;
  double packing_fraction;
};
void PrintTo(const Goal& goal, std::ostream* out) {
  *out << "aspect ratios ";
  for (const Ellipse& shape : goal.shapes) *out << shape.a / shape.b << ' ';
  *out << "to " << goal.packing_fraction;
}

class Swelling : public testing::TestWithParam<Goal> {};

// From a random start; the particles keep their size, the box gives way.
TEST_P(Swelling, ReachesThePackingFractionWithoutOverlap) {
  Configuration2 c = inserted(500, GetParam().shapes);
  const std::vector<Ellipse> shapes(c.shape);
  const Swollen report = swollen(c, GetParam().packing_fraction);
  EXPECT_EQ(report.end, StageEnd::reached) << report.reason;
  EXPECT_NEAR(packing_fraction(c), GetParam().packing_fraction, 1e-12);
  for (std::size_t i = 0; i < c.size(); ++i) EXPECT_EQ(c.shape[i].a, shapes[i].a);
}

INSTANTIATE_TEST_SUITE_P(
    RandomStart, Swelling,
    testing::Values(Goal{{of_aspect_ratio(2)}, 0.80}, Goal{{of_aspect_ratio(6)}, 0.75},
                    Goal{{Ellipse{1, 1}, Ellipse{1.4, 1.4}, of_aspect_ratio(3)}, 0.75}));

// 0.9069 is the densest packing of disks and ellipses alike: nothing gets beyond it, and a random
// start of so few sweeps stays well below.
TEST(SwellingLimits, KnowsWhenTheParticlesAreJammed) {
  Configuration2 c = inserted(60, {of_aspect_ratio(1.5)});
  const Swollen report = swollen(c, 0.95);
  EXPECT_EQ(report.end, StageEnd::stalled);
  EXPECT_THAT(report.reason, testing::HasSubstr("jammed"));
  EXPECT_LT(packing_fraction(c), 0.9069);
  EXPECT_GT(packing_fraction(c), 0.80);
}

// In a box barely longer than a particle, where it meets its own images.
TEST(SwellingLimits, MindsImagesInATinyBox) {
  Configuration2 c = inserted(3, {of_aspect_ratio(4)});
  const Swollen report = swollen(c, 0.5);
  EXPECT_EQ(report.end, StageEnd::reached) << report.reason;
}

// A stop in the middle of a round leaves the state at its beginning, hard and of unchanged particles.
TEST(SwellingLimits, GoesOnBitByBitAfterStops) {
  Configuration2 whole = inserted(100, {of_aspect_ratio(3)}), parts = whole;
  SwellingState undisturbed, state;
  EXPECT_EQ(swell(whole, {0.75, 1000000}, 1, undisturbed, {}).end, StageEnd::reached);
  std::uint64_t allowed = 25, questions = 0, stops = 0;
  const RunControl control{[&] { return ++questions > allowed; }, {}, {}};
  while (swell(parts, {0.75, 1000000}, 1, state, control).end == StageEnd::stopped) {
    EXPECT_TRUE(exact_check(parts).clean());
    EXPECT_EQ(parts.shape[0].a, of_aspect_ratio(3).a);
    allowed = 25 + 10 * ++stops;  // so that every round comes to its end some time
    questions = 0;
  }
  EXPECT_GT(stops, 3u);
  expect_same_state(parts, whole);
  EXPECT_EQ(state.moves.counts.tried(), undisturbed.moves.counts.tried());
}

TEST(SwellingLimits, SaysHowFarItGot) {
  Configuration2 c = inserted(100, {of_aspect_ratio(2)});
  const Swollen report = swollen(c, 0.8, 50);
  EXPECT_EQ(report.end, StageEnd::stalled);
  EXPECT_EQ(report.moves.sweeps, 50u);
  EXPECT_THAT(report.reason, testing::HasSubstr("0.8"));
}

}  // namespace
}  // namespace vitrel

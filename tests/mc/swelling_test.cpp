#include "mc/swelling.h"

#include <gtest/gtest.h>

#include <ostream>
#include <vector>

#include "core/state/check.h"
#include "mc/insertion.h"
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
  std::uint64_t sweep = 0;
  const StageReport report = swell(c, {GetParam().packing_fraction, 1000000}, 1, sweep, {});
  EXPECT_EQ(report.end, StageEnd::reached) << report.reason;
  EXPECT_NEAR(packing_fraction(c), GetParam().packing_fraction, 1e-12);
  EXPECT_TRUE(exact_check(c).clean());
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
  std::uint64_t sweep = 0;
  const StageReport report = swell(c, {0.95, 1000000}, 1, sweep, {});
  EXPECT_EQ(report.end, StageEnd::stuck);
  EXPECT_NE(report.reason.find("jammed"), std::string::npos) << report.reason;
  EXPECT_LT(packing_fraction(c), 0.9069);
  EXPECT_GT(packing_fraction(c), 0.80);
  EXPECT_TRUE(exact_check(c).clean());
}

// In a box barely longer than a particle, where it meets its own images.
TEST(SwellingLimits, MindsImagesInATinyBox) {
  Configuration2 c = inserted(3, {of_aspect_ratio(4)});
  std::uint64_t sweep = 0;
  const StageReport report = swell(c, {0.5, 1000000}, 1, sweep, {});
  EXPECT_EQ(report.end, StageEnd::reached) << report.reason;
  EXPECT_TRUE(exact_check(c).clean());
}

// A stop leaves a hard state of unchanged particles, from which another call goes on.
TEST(SwellingLimits, GoesOnAfterAStop) {
  Configuration2 c = inserted(100, {of_aspect_ratio(3)});
  std::uint64_t sweep = 0;
  int questions = 0;
  const Budget budget{[&] { return ++questions > 25; }, {}};
  EXPECT_EQ(swell(c, {0.7, 1000000}, 1, sweep, budget).end, StageEnd::stopped);
  EXPECT_TRUE(exact_check(c).clean());
  EXPECT_EQ(c.shape[0].a, of_aspect_ratio(3).a);
  EXPECT_EQ(swell(c, {0.7, 1000000}, 1, sweep, {}).end, StageEnd::reached);
  EXPECT_TRUE(exact_check(c).clean());
}

TEST(SwellingLimits, SaysHowFarItGot) {
  Configuration2 c = inserted(100, {of_aspect_ratio(2)});
  std::uint64_t sweep = 0;
  const StageReport report = swell(c, {0.8, 50}, 1, sweep, {});
  EXPECT_EQ(report.end, StageEnd::stuck);
  EXPECT_EQ(sweep, 50u);
  EXPECT_NE(report.reason.find("0.8"), std::string::npos);
  EXPECT_TRUE(exact_check(c).clean());
}

}  // namespace
}  // namespace vitrel

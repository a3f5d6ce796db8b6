#include "mc/insertion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/state/check.h"
#include "tests/support/scenes.h"

namespace vitrel {
namespace {

Configuration2 particles(std::size_t n, const Ellipse& shape) {
  Configuration2 c;
  c.resize(n);
  for (Ellipse& s : c.shape) s = shape;
  c.box = PeriodicBox<2>(Vec2(50, 50));
  return c;
}

TEST(Insertion, GivesAHardStateAtThePackingFraction) {
  for (double aspect_ratio : {1.0, 2.0, 6.0}) {
    Configuration2 c = particles(300, of_aspect_ratio(aspect_ratio));
    const StageReport report = insert_particles(c, {0.35, 100000, false}, 1, {});
    EXPECT_EQ(report.end, StageEnd::reached);
    EXPECT_NEAR(packing_fraction(c), 0.35, 1e-12);
    EXPECT_TRUE(exact_check(c).clean());
  }
}

TEST(Insertion, IntoABoxOfOneParticleLengthMindsTheImages) {
  Configuration2 c = particles(3, {3, 0.1});
  c.box = PeriodicBox<2>(Vec2(6.1, 3));
  const StageReport report = insert_particles(c, {packing_fraction(c), 1000000, false}, 1, {});
  ASSERT_EQ(report.end, StageEnd::reached);
  EXPECT_TRUE(exact_check(c).clean());
}

// Beyond the jamming limit of disks, 0.547, there is no way in.
TEST(Insertion, SaysWhenItIsHopeless) {
  Configuration2 c = particles(400, {1, 1});
  const StageReport report = insert_particles(c, {0.6, 2000, false}, 1, {});
  EXPECT_EQ(report.end, StageEnd::stuck);
  EXPECT_NE(report.reason.find("hopeless"), std::string::npos);
}

TEST(Insertion, AlignedMeansAngleZero) {
  Configuration2 c = particles(50, of_aspect_ratio(4));
  insert_particles(c, {0.3, 100000, true}, 1, {});
  for (double angle : c.angle) EXPECT_EQ(angle, 0);
}

// Two ellipses thrown at random overlap with probability 2 B₂/V, B₂ = A + P²/(4π) exactly: the
// share of second particles that find no place at the first attempt. 4 standard errors, false alarm
// 6e-5.
TEST(Insertion, FirstRejectionGivesTheSecondVirialCoefficient) {
  const Ellipse shape = of_aspect_ratio(4);
  const double b2 = shape.volume() + std::pow(perimeter(shape), 2) / (4 * std::numbers::pi);
  const int throws = 40'000;
  int rejected = 0;
  double volume = 0;
  for (int k = 0; k < throws; ++k) {
    Configuration2 c = particles(2, shape);
    c.box = PeriodicBox<2>(Vec2(12, 12));
    const StageReport report = insert_particles(c, {packing_fraction(c), 1, false}, k, {});
    rejected += report.end == StageEnd::stuck;
    volume = c.box.volume();
  }
  const double p = 2 * b2 / volume;
  EXPECT_NEAR(rejected, p * throws, 4 * std::sqrt(throws * p * (1 - p)));
}

}  // namespace
}  // namespace vitrel

// Free paths against the contact search, which shares no code with them, and the exact
// support gap.

#include "core/contact/ellipse_free_path_batch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/resting_bodies.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double gap = free_path_gap;
using Class = FreePathClass;
using Placed = PlacedBody<2>;
using Scene = FreePathScene<2>;

/// One axis in eight is along x or y.
Scene random_scene(Stream& draw, const Class& at, std::size_t count) {
  const auto angle = [&] {
    return draw.below(8) == 0 ? 0.5 * pi * static_cast<double>(draw.below(4))
                              : draw.uniform(-20, 20);
  };
  const auto body = [&]() -> Placed {
    const double root = std::sqrt(std::pow(at.largest_aspect_ratio, draw.uniform()));
    const double size = std::pow(at.largest_size_ratio, draw.uniform());
    return {{size * root, size / root}, {Vec2::Zero(), angle()}};
  };
  return random_scene<2>(draw, count, body, [&] { return direction(draw.uniform(-pi, pi)); });
}

class FreePathsOfEllipses : public testing::TestWithParam<Class> {};

TEST_P(FreePathsOfEllipses, EndsAtTheFirstContact) {
  Stream draw(71, Purpose::tests);
  FreePathTally tally;
  constexpr int scenes = 10'000;
  for (int k = 0; k < scenes; ++k) {
    const std::size_t count = 1 + draw.below(12);
    const Scene scene = random_scene(draw, GetParam(), count);
    const double max_length = scene.moving.shape.a * draw.uniform(0.1, 5);
    if (k % 2 == 0)
      check_path<RestingBodies<Ellipse>, 0>(scene, max_length, tally);
    else
      check_path<RestingBodies<Ellipse>, 1>(scene, max_length, tally);
    if (k % 10 == 0) check_path<RestingBodies<PlainEllipse>, 0>(scene, max_length, tally);
    if (HasFatalFailure()) FAIL() << "scene " << k;
  }
  EXPECT_GT(tally.partner, scenes / 5);
  EXPECT_GT(tally.free, scenes / 20);
}

INSTANTIATE_TEST_SUITE_P(Shapes, FreePathsOfEllipses,
                         testing::Values(Class{1, 1}, Class{1, 100}, Class{2, 1}, Class{6, 1},
                                         Class{10, 3}, Class{100, 1}, Class{100, 100}));

TEST(RoundFreePathBatch, EndsAtTheFirstContact) {
  Stream draw(72, Purpose::tests);
  FreePathTally tally;
  for (int k = 0; k < 10'000; ++k) {
    const std::size_t count = 1 + draw.below(12);
    const Scene scene = random_scene(draw, {1, 10}, count);
    const double max_length = scene.moving.shape.a * draw.uniform(0.1, 5);
    check_path<RoundBodies<Ellipse>, 0>(scene, max_length, tally);
    check_path<RoundBodies<Ellipse>, 1>(scene, max_length, tally);
    if (HasFatalFailure()) FAIL() << "scene " << k;
  }
  EXPECT_GT(tally.partner, 2000);
  EXPECT_GT(tally.free, 1000);
}

// The contact distance of oracles: semi-axes 2 and 1, at angles 0 and 90 degrees and d at 45, is √10.
TEST(EllipseFreePathBatch, MeetsCrossedEllipsesAtTheKnownDistance) {
  const Ellipse shape{2, 1};
  const double height = std::sqrt(5);
  const Scene scene{{shape, {Vec2::Zero(), 0}}, {{shape, {Vec2(10, height), 0.5 * pi}}}};
  for (const FreePath& end : {path_end<RestingBodies<Ellipse>, 0>(scene, 20),
                              path_end<RestingBodies<PlainEllipse>, 0>(scene, 20)}) {
    EXPECT_EQ(end.partner, 0u);
    EXPECT_NEAR(end.length, 10 - height, 10 * gap);
  }
}

// An ellipse closer than the gap is touched at once if it is ahead, and ignored if it is behind or masked out.
TEST(EllipseFreePathBatch, TouchesAtOnceWhatIsAhead) {
  const Ellipse shape{2, 1};
  for (const double side : {1., -1.}) {
    const Vec2 place = side * (2 + 0.5 * gap) * direction(0.3 + 0.5 * pi);
    const Scene scene{{shape, {Vec2::Zero(), 0.3}}, {{shape, {place, 0.3}}}};
    for (const FreePath& end : {path_end<RestingBodies<Ellipse>, 1>(scene, 1),
                                path_end<RestingBodies<PlainEllipse>, 1>(scene, 1)}) {
      EXPECT_EQ(end.partner, side > 0 ? 0 : FreePath::none);
      EXPECT_EQ(end.length, side > 0 ? 0 : 1);
    }
  }
  EllipseFreePathBatch<0> paths({shape, Vec2(1, 0)}, nullptr, gap, 1);
  EllipseBatch group;
  group.set(2, shape, Vec2(4.5, 0), Vec2(1, 0));
  paths.add(group, 0, Vec2::Zero(), detail::all_lanes_but(2));
  EXPECT_EQ(paths.end().partner, FreePath::none);
}

}  // namespace
}  // namespace vitrel

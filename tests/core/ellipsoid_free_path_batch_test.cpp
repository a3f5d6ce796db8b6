// Free paths in space against the contact search, which shares no code with them, and the exact support gap.

#include "core/contact/ellipsoid_free_path_batch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/resting_bodies.h"
#include "tests/support/solids.h"

namespace vitrel {
namespace {

constexpr double gap = free_path_gap;
using Class = FreePathClass;
using Placed = PlacedBody<3>;
using Scene = FreePathScene<3>;

/// One body in eight is aligned with the box.
Scene random_scene(Stream& draw, const Class& at, std::size_t count) {
  const auto body = [&]() -> Placed {
    const double size = std::pow(at.largest_size_ratio, draw.uniform());
    return {scaled(random_ellipsoid(draw, at.largest_aspect_ratio), size),
            {Vec3::Zero(), draw.below(8) == 0 ? Quaternion::Identity() : random_orientation(draw)}};
  };
  return random_scene<3>(draw, count, body, [&] { return random_direction(draw); });
}

class FreePathsOfEllipsoids : public testing::TestWithParam<Class> {};

TEST_P(FreePathsOfEllipsoids, EndAtTheFirstContact) {
  Stream draw(73, Purpose::tests);
  FreePathTally tally;
  constexpr int scenes = 3'000;
  for (int k = 0; k < scenes; ++k) {
    const std::size_t count = 1 + draw.below(12);
    const Scene scene = random_scene(draw, GetParam(), count);
    const double max_length = scene.moving.shape.circumradius() * draw.uniform(0.1, 5);
    if (k % 3 == 0)
      check_path<RestingBodies<Ellipsoid>, 0>(scene, max_length, tally);
    else if (k % 3 == 1)
      check_path<RestingBodies<Ellipsoid>, 1>(scene, max_length, tally);
    else
      check_path<RestingBodies<Ellipsoid>, 2>(scene, max_length, tally);
    if (k % 10 == 0) check_path<RestingBodies<PlainEllipsoid>, 1>(scene, max_length, tally);
    if (HasFatalFailure()) FAIL() << "scene " << k;
  }
  EXPECT_GT(tally.partner, scenes / 5);
  EXPECT_GT(tally.free, scenes / 20);
}

INSTANTIATE_TEST_SUITE_P(Shapes, FreePathsOfEllipsoids,
                         testing::Values(Class{1, 1}, Class{1, 30}, Class{2, 1}, Class{6, 1},
                                         Class{10, 3}, Class{30, 1}, Class{30, 30}));

// Two equal ellipsoids with the same orientation touch like spheres, in the coordinates in which they are such.
TEST(EllipsoidFreePathBatch, MeetsAlignedBodiesAtTheKnownDistance) {
  const Ellipsoid shape{Vec3(3, 1.5, 0.5)};
  const Quaternion aligned = Quaternion::Identity();
  const Scene scene{{shape, {Vec3::Zero(), aligned}}, {{shape, {Vec3(2.4, 10, -0.6), aligned}}}};
  for (const FreePath& end : {path_end<RestingBodies<Ellipsoid>, 1>(scene, 20),
                              path_end<RestingBodies<PlainEllipsoid>, 1>(scene, 20)}) {
    EXPECT_EQ(end.partner, 0u);
    EXPECT_NEAR(end.length, 10 - 3 * std::sqrt(1 - 0.4 * 0.4 - 0.6 * 0.6), 10 * gap);
  }
}

// An ellipsoid closer than the gap is touched at once if it is ahead, and ignored if it is behind or masked out.
TEST(EllipsoidFreePathBatch, TouchesAtOnceWhatIsAhead) {
  const Ellipsoid shape{Vec3(2, 1, 0.5)};
  const Quaternion turned(Eigen::AngleAxisd(0.3, Vec3::UnitX()));
  for (const double side : {1., -1.}) {
    const Vec3 place = side * (1 + 0.5 * gap) * (turned * Vec3::UnitZ());
    const Scene scene{{shape, {Vec3::Zero(), turned}}, {{shape, {place, turned}}}};
    for (const FreePath& end : {path_end<RestingBodies<Ellipsoid>, 2>(scene, 1),
                                path_end<RestingBodies<PlainEllipsoid>, 2>(scene, 1)}) {
      EXPECT_EQ(end.partner, side > 0 ? 0 : FreePath::none);
      EXPECT_EQ(end.length, side > 0 ? 0 : 1);
    }
  }
  const OrientedEllipsoid body(shape, Quaternion::Identity());
  EllipsoidFreePathBatch<0> paths(body, &body, gap, 1);
  NumberedBatch<SphereBatch<3>> group;
  group.set(2, body, Vec3(4.5, 0, 0));
  paths.add(group, 0, Vec3::Zero(), detail::all_lanes_but(2));
  EXPECT_EQ(paths.end().partner, FreePath::none);
}

}  // namespace
}  // namespace vitrel

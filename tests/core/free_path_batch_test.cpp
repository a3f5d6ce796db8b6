// Free paths of ellipses and ellipsoids agree with the contact search, which shares no code with
// them, and the exact support gap.

#include "core/contact/ellipse_free_path_batch.h"
#include "core/contact/ellipsoid_free_path_batch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/resting_bodies.h"
#include "tests/support/solids.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double gap = free_path_gap;
using Class = FreePathClass;

/// Checks the path by the algorithm of the shape and by the general one.
template <class Plain, int along>
void expect_end(const FreePathScene<Plain::dimension>& scene, double max_length,
                std::size_t partner, double length, double tolerance = 0) {
  using Shape = ParticleShape<Plain::dimension>;
  for (const FreePath& end : {path_end<RestingBodies<Shape>, along>(scene, max_length),
                              path_end<RestingBodies<Plain>, along>(scene, max_length)}) {
    EXPECT_EQ(end.partner, partner);
    EXPECT_NEAR(end.length, length, tolerance);
  }
}

/// One axis in eight is along x or y.
FreePathScene<2> random_flat_scene(Stream& draw, const Class& at) {
  const std::size_t count = 1 + draw.below(12);
  const auto angle = [&] {
    return draw.below(8) == 0 ? 0.5 * pi * static_cast<double>(draw.below(4))
                              : draw.uniform(-20, 20);
  };
  const auto body = [&]() -> PlacedBody<2> {
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
    const FreePathScene<2> scene = random_flat_scene(draw, GetParam());
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
    const FreePathScene<2> scene = random_flat_scene(draw, {1, 10});
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
  const FreePathScene<2> scene{{shape, {Vec2::Zero(), 0}}, {{shape, {Vec2(10, height), 0.5 * pi}}}};
  expect_end<PlainEllipse, 0>(scene, 20, 0, 10 - height, 10 * gap);
}

// An ellipse closer than the gap is touched at once if it is ahead, and ignored if it is behind or masked out.
TEST(EllipseFreePathBatch, TouchesAtOnceWhatIsAhead) {
  const Ellipse shape{2, 1};
  for (const double side : {1., -1.}) {
    const Vec2 place = side * (2 + 0.5 * gap) * direction(0.3 + 0.5 * pi);
    const FreePathScene<2> scene{{shape, {Vec2::Zero(), 0.3}}, {{shape, {place, 0.3}}}};
    expect_end<PlainEllipse, 1>(scene, 1, side > 0 ? 0 : FreePath::none, side > 0 ? 0 : 1);
  }
  EllipseFreePathBatch<0> paths({shape, Vec2(1, 0)}, nullptr, gap, 1);
  EllipseBatch group;
  group.set(2, shape, Vec2(4.5, 0), Vec2(1, 0));
  paths.add(group, 0, Vec2::Zero(), detail::all_lanes_but(2));
  EXPECT_EQ(paths.end().partner, FreePath::none);
}

/// One body in eight is aligned with the box.
FreePathScene<3> random_scene_in_space(Stream& draw, const Class& at) {
  const std::size_t count = 1 + draw.below(12);
  const auto body = [&]() -> PlacedBody<3> {
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
    const FreePathScene<3> scene = random_scene_in_space(draw, GetParam());
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
  const FreePathScene<3> scene{{shape, {Vec3::Zero(), aligned}},
                               {{shape, {Vec3(2.4, 10, -0.6), aligned}}}};
  expect_end<PlainEllipsoid, 1>(scene, 20, 0, 10 - 3 * std::sqrt(1 - 0.4 * 0.4 - 0.6 * 0.6),
                                10 * gap);
}

// An ellipsoid closer than the gap is touched at once if it is ahead, and ignored if it is behind or masked out.
TEST(EllipsoidFreePathBatch, TouchesAtOnceWhatIsAhead) {
  const Ellipsoid shape{Vec3(2, 1, 0.5)};
  const Quaternion turned(Eigen::AngleAxisd(0.3, Vec3::UnitX()));
  for (const double side : {1., -1.}) {
    const Vec3 place = side * (1 + 0.5 * gap) * (turned * Vec3::UnitZ());
    const FreePathScene<3> scene{{shape, {Vec3::Zero(), turned}}, {{shape, {place, turned}}}};
    expect_end<PlainEllipsoid, 2>(scene, 1, side > 0 ? 0 : FreePath::none, side > 0 ? 0 : 1);
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

// Free paths in space against the contact search, which shares no code with them, and the exact support gap.

#include "core/contact/ellipsoid_free_path_batch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/contact/first_contact.h"
#include "tests/support/solids.h"

namespace vitrel {
namespace {

constexpr double gap = 1e-9;

struct Group : EllipsoidBatch {
  std::uint32_t particle[simd_width] = {};
};

struct Placed {
  Ellipsoid shape;
  Quaternion orientation;
  Vec3 position;  // from the centre of the one that moves
};

/// One ellipsoid at the origin, among others that it does not touch.
struct Scene {
  Ellipsoid shape;
  Quaternion orientation;
  std::vector<Placed> others;

  double distance(const Placed& other, const Vec3& moved) const {
    return support_gap(shape, orientation, other.shape, other.orientation, other.position - moved)
        .gap;
  }
};

struct Class {
  double largest_aspect_ratio, largest_size_ratio;
};
void PrintTo(const Class& at, std::ostream* out) {
  *out << "aspect ratios to " << at.largest_aspect_ratio
       << ", sizes to 1:" << at.largest_size_ratio;
}

/// A quarter of the others are at 10⁻¹ … 10⁻⁸ of their size from the first; one body in eight is aligned with the box.
Scene random_scene(Stream& draw, const Class& at, int count) {
  const auto body = [&] {
    return scaled(random_ellipsoid(draw, at.largest_aspect_ratio),
                  std::pow(at.largest_size_ratio, draw.uniform()));
  };
  const auto orientation = [&] {
    return draw.below(8) == 0 ? Quaternion::Identity() : random_orientation(draw);
  };
  Scene scene{body(), orientation(), {}};
  while (scene.others.size() < static_cast<std::size_t>(count)) {
    Placed other{body(), orientation(), Vec3::Zero()};
    const double reach = scene.shape.circumradius() + other.shape.circumradius();
    other.position = draw.uniform(0, 2) * reach * random_direction(draw);
    const SupportGap3 now =
        support_gap(scene.shape, scene.orientation, other.shape, other.orientation, other.position);
    if (draw.below(4) == 0) {
      const double wanted = reach * std::pow(10, -draw.uniform(1, 8));
      other.position += (wanted - now.gap) * now.normal;
    }
    if (scene.distance(other, Vec3::Zero()) >
        scene.shape.circumradius() / scene.shape.inradius() * 2 * gap)
      scene.others.push_back(other);
  }
  return scene;
}

template <int along>
FreePath path_end(const Scene& scene, double max_length) {
  std::vector<OrientedEllipsoid> bodies;
  for (const Placed& other : scene.others) bodies.emplace_back(other.shape, other.orientation);
  const OrientedEllipsoid moving(scene.shape, scene.orientation);
  EllipsoidFreePathBatch<along> paths(moving, bodies.data(), gap, max_length);
  const Vec3 offset(0.25, -0.5, 0.125);
  for (std::size_t begin = 0; begin < bodies.size(); begin += simd_width) {
    Group group;
    for (std::size_t k = begin; k < std::min(begin + simd_width, bodies.size()); ++k) {
      const int lane = static_cast<int>(k - begin);
      group.set(lane, bodies[k], scene.others[k].position - offset);
      group.particle[lane] = static_cast<std::uint32_t>(k);
    }
    paths.add(group, static_cast<std::uint32_t>(begin), offset, SimdBatch::Mask(true));
  }
  return paths.end();
}

/// Free all the way, and then either of the wanted length or in contact.
template <int along>
void check(const Scene& scene, double max_length, int& partner, int& free) {
  const FreePath end = path_end<along>(scene, max_length);
  const Vec3 e = Vec3::Unit(along);
  ASSERT_GE(end.length, 0);
  ASSERT_LE(end.length, max_length);
  for (const Placed& other : scene.others) {
    const Flight<Ellipsoid> moving{
        scene.shape, {Vec3::Zero(), scene.orientation}, {e, Vec3::Zero()}};
    const Flight<Ellipsoid> resting{
        other.shape, {other.position, other.orientation}, {Vec3::Zero(), Vec3::Zero()}};
    const Prediction3 met = first_contact(moving, resting, end.length, 0.5 * gap);
    ASSERT_EQ(met.outcome, Outcome::none) << "after " << met.time << " of " << end.length;
  }
  if (end.partner == FreePath::none) {
    ++free;
    ASSERT_EQ(end.length, max_length);
    return;
  }
  ++partner;
  const Placed& other = scene.others[end.partner];
  const Vec3 d = other.position - end.length * e;
  const SupportGap3 now =
      support_gap(scene.shape, scene.orientation, other.shape, other.orientation, d);
  const double aspect_ratio = scene.shape.circumradius() / scene.shape.inradius();
  const double rounding =
      1e-14 * (scene.shape.circumradius() + other.shape.circumradius() + max_length);
  ASSERT_GT(now.gap, gap - rounding);
  ASSERT_LT(now.gap, (aspect_ratio + 0.25) * gap + rounding);
  ASSERT_GT(now.normal.dot(e), 0);
  ASSERT_NEAR(end.offset_at_contact, d[along], rounding);
}

class FreePathsOfEllipsoids : public testing::TestWithParam<Class> {};

TEST_P(FreePathsOfEllipsoids, EndAtTheFirstContact) {
  Stream draw(73, Purpose::tests);
  int partner = 0, free = 0;
  constexpr int scenes = 3'000;
  for (int k = 0; k < scenes; ++k) {
    const Scene scene = random_scene(draw, GetParam(), 1 + static_cast<int>(draw.below(12)));
    const double max_length = scene.shape.circumradius() * draw.uniform(0.1, 5);
    if (k % 3 == 0)
      check<0>(scene, max_length, partner, free);
    else if (k % 3 == 1)
      check<1>(scene, max_length, partner, free);
    else
      check<2>(scene, max_length, partner, free);
    if (HasFatalFailure()) FAIL() << "scene " << k;
  }
  EXPECT_GT(partner, scenes / 5);
  EXPECT_GT(free, scenes / 20);
}

INSTANTIATE_TEST_SUITE_P(Shapes, FreePathsOfEllipsoids,
                         testing::Values(Class{1, 1}, Class{1, 30}, Class{2, 1}, Class{6, 1},
                                         Class{10, 3}, Class{30, 1}, Class{30, 30}));

// Two equal ellipsoids with the same orientation touch like spheres, in the coordinates in which they are such.
TEST(EllipsoidFreePathBatch, MeetsAlignedBodiesAtTheKnownDistance) {
  const Ellipsoid shape{Vec3(3, 1.5, 0.5)};
  const Scene scene{
      shape, Quaternion::Identity(), {{shape, Quaternion::Identity(), Vec3(2.4, 10, -0.6)}}};
  const FreePath end = path_end<1>(scene, 20);
  EXPECT_EQ(end.partner, 0u);
  EXPECT_NEAR(end.length, 10 - 3 * std::sqrt(1 - 0.4 * 0.4 - 0.6 * 0.6), 10 * gap);
}

// An ellipsoid closer than the gap is touched at once if it is ahead, and ignored if it is behind or masked out.
TEST(EllipsoidFreePathBatch, TouchesAtOnceWhatIsAhead) {
  const Ellipsoid shape{Vec3(2, 1, 0.5)};
  const Quaternion turned(Eigen::AngleAxisd(0.3, Vec3::UnitX()));
  for (const double side : {1., -1.}) {
    const Vec3 across = turned * Vec3::UnitZ();
    const Scene scene{shape, turned, {{shape, turned, side * (1 + 0.5 * gap) * across}}};
    const FreePath end = path_end<2>(scene, 1);
    EXPECT_EQ(end.partner, side > 0 ? 0 : FreePath::none);
    EXPECT_EQ(end.length, side > 0 ? 0 : 1);
  }
  const OrientedEllipsoid body(shape, Quaternion::Identity());
  EllipsoidFreePathBatch<0> paths(body, &body, gap, 1);
  Group group;
  group.set(2, body, Vec3(4.5, 0, 0));
  paths.add(group, 0, Vec3::Zero(), detail::all_lanes_but(2));
  EXPECT_EQ(paths.end().partner, FreePath::none);
}

}  // namespace
}  // namespace vitrel

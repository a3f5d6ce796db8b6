// Free paths against the contact search, which shares no code with them, and the exact
// support gap.

#include "core/contact/ellipse_free_path_batch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/contact/ellipse_gap.h"
#include "core/contact/first_contact.h"
#include "core/random/stream.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double gap = 1e-9;

struct Placed {
  Ellipse shape;
  double angle;
  Vec2 position;  // from the centre of the one that moves
};

/// One ellipse at the origin, among others that it does not touch.
struct Scene {
  Ellipse shape;
  double angle;
  std::vector<Placed> others;
};

struct Class {
  double largest_aspect_ratio, largest_size_ratio;
};
void PrintTo(const Class& at, std::ostream* out) {
  *out << "aspect ratios to " << at.largest_aspect_ratio
       << ", sizes to 1:" << at.largest_size_ratio;
}

/// A quarter of the others are at 10⁻¹ … 10⁻⁸ of their size from the first; one axis in eight is along x
/// or y.
Scene random_scene(Stream& draw, const Class& at, int count) {
  const auto ellipse = [&]() -> Ellipse {
    const double root = std::sqrt(std::pow(at.largest_aspect_ratio, draw.uniform()));
    const double size = std::pow(at.largest_size_ratio, draw.uniform());
    return {size * root, size / root};
  };
  const auto angle = [&] {
    return draw.below(8) == 0 ? 0.5 * pi * static_cast<double>(draw.below(4))
                              : draw.uniform(-20, 20);
  };
  Scene scene{ellipse(), angle(), {}};
  while (scene.others.size() < static_cast<std::size_t>(count)) {
    Placed other{ellipse(), angle(), Vec2::Zero()};
    const double reach = scene.shape.a + other.shape.a;
    other.position = draw.uniform(0, 2) * reach * direction(draw.uniform(-pi, pi));
    const SupportGap now =
        support_gap(scene.shape, scene.angle, other.shape, other.angle, other.position);
    if (draw.below(4) == 0) {
      const double wanted = reach * std::pow(10, -draw.uniform(1, 8));
      other.position += (wanted - now.gap) * now.normal;
    }
    if (support_gap(scene.shape, scene.angle, other.shape, other.angle, other.position).gap >
        scene.shape.aspect_ratio() * 2 * gap)
      scene.others.push_back(other);
  }
  return scene;
}

template <template <int> class Batch, int along>
FreePath path_end(const Scene& scene, double max_length) {
  Batch<along> paths(OrientedEllipse{scene.shape, direction(scene.angle)}, gap, max_length);
  const Vec2 offset(0.25, -0.5);
  for (std::size_t begin = 0; begin < scene.others.size(); begin += simd_width) {
    EllipseBatch group;
    for (std::size_t k = begin; k < std::min(begin + simd_width, scene.others.size()); ++k) {
      const Placed& other = scene.others[k];
      group.set(static_cast<int>(k - begin), other.shape, other.position - offset,
                direction(other.angle));
    }
    paths.add(group, static_cast<std::uint32_t>(begin), offset, typename Batch<along>::Mask(true));
  }
  return paths.end();
}

/// Free all the way, and then either of the wanted length or in contact.
template <template <int> class Batch, int along>
void check(const Scene& scene, double max_length, int& partner, int& free) {
  const FreePath end = path_end<Batch, along>(scene, max_length);
  const Vec2 e = along == 0 ? Vec2(1, 0) : Vec2(0, 1);
  ASSERT_GE(end.length, 0);
  ASSERT_LE(end.length, max_length);
  for (const Placed& other : scene.others) {
    const Flight<Ellipse> moving{scene.shape, {Vec2::Zero(), scene.angle}, {e, 0}};
    const Flight<Ellipse> resting{other.shape, {other.position, other.angle}, {Vec2::Zero(), 0}};
    const Prediction2 met = first_contact(moving, resting, end.length, 0.5 * gap);
    ASSERT_EQ(met.outcome, Outcome::none) << "after " << met.time << " of " << end.length;
  }
  if (end.partner == FreePath::none) {
    ++free;
    ASSERT_EQ(end.length, max_length);
    return;
  }
  ++partner;
  const Placed& other = scene.others[end.partner];
  const Vec2 d = other.position - end.length * e;
  const SupportGap now = support_gap(scene.shape, scene.angle, other.shape, other.angle, d);
  const double rounding = 1e-14 * (scene.shape.a + other.shape.a + max_length);
  ASSERT_GT(now.gap, gap - rounding);
  ASSERT_LT(now.gap, (scene.shape.aspect_ratio() + 0.25) * gap + rounding);
  ASSERT_GT(now.normal.dot(e), 0);
  ASSERT_NEAR(end.offset_at_contact, d.dot(e), rounding);
}

class FreePathsOfEllipses : public testing::TestWithParam<Class> {};

TEST_P(FreePathsOfEllipses, EndsAtTheFirstContact) {
  Stream draw(71, Purpose::tests);
  int partner = 0, free = 0;
  constexpr int scenes = 10'000;
  for (int k = 0; k < scenes; ++k) {
    const Scene scene = random_scene(draw, GetParam(), 1 + static_cast<int>(draw.below(12)));
    const double max_length = scene.shape.a * draw.uniform(0.1, 5);
    if (k % 2 == 0)
      check<EllipseFreePathBatch, 0>(scene, max_length, partner, free);
    else
      check<EllipseFreePathBatch, 1>(scene, max_length, partner, free);
    if (HasFatalFailure()) FAIL() << "scene " << k;
  }
  EXPECT_GT(partner, scenes / 5);
  EXPECT_GT(free, scenes / 20);
}

INSTANTIATE_TEST_SUITE_P(Shapes, FreePathsOfEllipses,
                         testing::Values(Class{1, 1}, Class{1, 100}, Class{2, 1}, Class{6, 1},
                                         Class{10, 3}, Class{100, 1}, Class{100, 100}));

template <int along>
using DiskFreePathBatch = RoundFreePathBatch<along>;

TEST(RoundFreePathBatch, EndsAtTheFirstContact) {
  Stream draw(72, Purpose::tests);
  int partner = 0, free = 0;
  for (int k = 0; k < 10'000; ++k) {
    const Scene scene = random_scene(draw, {1, 10}, 1 + static_cast<int>(draw.below(12)));
    const double max_length = scene.shape.a * draw.uniform(0.1, 5);
    check<DiskFreePathBatch, 0>(scene, max_length, partner, free);
    check<DiskFreePathBatch, 1>(scene, max_length, partner, free);
    if (HasFatalFailure()) FAIL() << "scene " << k;
  }
  EXPECT_GT(partner, 2000);
  EXPECT_GT(free, 1000);
}

// The contact distance of oracles: semi-axes 2 and 1, at angles 0 and 90 degrees and d at 45, is √10.
TEST(EllipseFreePathBatch, MeetsCrossedEllipsesAtTheKnownDistance) {
  const Ellipse shape{2, 1};
  const double height = std::sqrt(5);
  const Scene scene{shape, 0, {{shape, 0.5 * pi, Vec2(10, height)}}};
  const FreePath end = path_end<EllipseFreePathBatch, 0>(scene, 20);
  EXPECT_EQ(end.partner, 0u);
  EXPECT_NEAR(end.length, 10 - height, 10 * gap);
}

// An ellipse closer than the gap is touched at once if it is ahead, and ignored if it is behind or masked out.
TEST(EllipseFreePathBatch, TouchesAtOnceWhatIsAhead) {
  const Ellipse shape{2, 1};
  for (const double side : {1., -1.}) {
    const Scene scene{
        shape, 0.3, {{shape, 0.3, side * (2 + 0.5 * gap) * direction(0.3 + 0.5 * pi)}}};
    const FreePath end = path_end<EllipseFreePathBatch, 1>(scene, 1);
    EXPECT_EQ(end.partner, side > 0 ? 0 : FreePath::none);
    EXPECT_EQ(end.length, side > 0 ? 0 : 1);
  }
  EllipseFreePathBatch<0> paths({shape, Vec2(1, 0)}, gap, 1);
  EllipseBatch group;
  group.set(2, shape, Vec2(4.5, 0), Vec2(1, 0));
  paths.add(group, 0, Vec2::Zero(), detail::all_lanes_but(2));
  EXPECT_EQ(paths.end().partner, FreePath::none);
}

}  // namespace
}  // namespace vitrel

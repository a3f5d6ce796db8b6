// Neighbour lists against all pairs, exits against the support function, and what lists are kept in.

#include "core/neighbors/neighborhood.h"
#include "core/geometry/free_flight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "core/neighbors/list_pool.h"
#include "core/neighbors/spatial_order.h"
#include "core/random/stream.h"
#include "tests/support/neighbor_crowd.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;

Disk random_shape(Stream& draw, Disk) {
  return {draw.uniform(0.7, 1.4)};
}
Ellipse random_shape(Stream& draw, Ellipse) {
  if (draw.uniform() < 0.3) return {2, 2};
  const double b = draw.uniform(0.3, 1);
  return {b * draw.uniform(1, 2 / b), b};
}

template <class B>
Crowd<B> random_crowd(Stream& draw, const Vec2& lengths, std::size_t particles, double wanted,
                      std::size_t count) {
  std::vector<BaseShape<B>> kinds;
  for (std::size_t k = 0; k < count; ++k) kinds.push_back(random_shape(draw, BaseShape<B>{}));
  return {draw, lengths, particles, wanted, kinds};
}
/// Six particles, all of different shapes, are in a box of 9 × 7.
template <class B>
Crowd<B> small_crowd(Stream& draw) {
  return random_crowd<B>(draw, Vec2(9, 7), 6, 5, 6);
}

struct Scene {
  const char* name;
  Vec2 lengths;
  std::size_t particles;
  std::size_t kinds;
};

const Scene scenes[] = {
    {"many cells", {30, 40}, 150, 150},
    {"few cells", {9, 7}, 12, 3},
    {"a box shorter than two particles", {2.5, 3.5}, 4, 4},
    {"a box shorter than one", {1.1, 0.9}, 2, 1},
    {"alone with its images", {3, 1.5}, 1, 1},
    {"a dilute gas", {100, 60}, 20, 1},
};

template <class B>
class NeighborLists : public testing::Test {};
using Bodies = testing::Types<Disk, Ellipse, GrowingEllipse>;
TYPED_TEST_SUITE(NeighborLists, Bodies);

TYPED_TEST(NeighborLists, HoldAllWhoseNeighborhoodsMeet) {
  Stream draw(61, Purpose::tests);
  for (const Scene& scene : scenes) {
    SCOPED_TRACE(scene.name);
    for (const double wanted : {3.0, 7.0, 12.0})
      random_crowd<TypeParam>(draw, scene.lengths, scene.particles, wanted, scene.kinds)
          .expect_lists_right(0.01);
  }
}

// Particles move over the faces of the box or anywhere, also to the place of another (as in a
// corner of the box), and with growth at the size of the moment: the older a neighbourhood, the
// smaller. (Shrinking, the larger.)
TYPED_TEST(NeighborLists, StayRightThroughThousandsOfRenewals) {
  Stream draw(62, Purpose::tests);
  for (const Scene& scene : scenes)
    for (const double last_size : {1.0, 1.5, 0.6}) {
      if (last_size != 1 && !std::is_same_v<TypeParam, GrowingEllipse>) continue;
      SCOPED_TRACE(scene.name);
      Crowd<TypeParam> crowd =
          random_crowd<TypeParam>(draw, scene.lengths, scene.particles, 7, scene.kinds);
      constexpr int renewals = 1'500;
      for (int n = 1; n <= renewals; ++n) {
        const std::size_t i = draw.below(scene.particles);
        Pose2 pose = random_pose(draw, scene.lengths);
        if (n % 4) {
          const double step = crowd.lists.margin();
          pose.position =
              crowd.poses[i].position + Vec2{draw.uniform(-step, step), draw.uniform(-step, step)};
          pose.angle = crowd.poses[i].angle + draw.uniform(-0.3, 0.3);
        }
        if (n % 7 == 0) pose.position = crowd.poses[draw.below(scene.particles)].position;
        crowd.renew(i, pose, std::pow(last_size, static_cast<double>(n) / renewals));
        if (n % 100 == 0) crowd.expect_lists_right(0.01);
        if (this->HasFatalFailure()) return;
      }
    }
}

// About as many as wanted where there are enough particles for a mean.
TYPED_TEST(NeighborLists, AreAsLongAsWanted) {
  Stream draw(63, Purpose::tests);
  for (const double wanted : {4.0, 7.0, 10.0}) {
    Crowd<TypeParam> crowd = random_crowd<TypeParam>(draw, Vec2(50, 50), 400, wanted, 400);
    EXPECT_NEAR(static_cast<double>(crowd.listed().size()), 400 * wanted, 0.05 * 400 * wanted);
  }
}

// What is noted of a pair stays with it, seen from either side, until one of the two leaves; a new axis
// of a renewal separates the two if they are apart.
template <class B>
class Memories : public testing::Test {};
using Ellipses = testing::Types<Ellipse, GrowingEllipse>;
TYPED_TEST_SUITE(Memories, Ellipses);

TYPED_TEST(Memories, OfAPairStayWithIt) {
  Stream draw(64, Purpose::tests);
  Crowd<TypeParam> crowd = random_crowd<TypeParam>(draw, Vec2(12, 9), 20, 7, 20);
  const auto axis_of = [&](std::size_t i, const NeighborImage<2>& image) {
    for (const Neighbor<TypeParam>& neighbor : crowd.lists.of(i))
      if (neighbor.is(image)) return neighbor.warm_start.axis;
    ADD_FAILURE() << "no such neighbour";
    return Vec2(0, 0);
  };
  int noted = 0;
  for (std::size_t i = 0; i < 20; ++i) {
    if (crowd.lists.of(i).empty()) continue;
    const NeighborImage with = crowd.lists.of(i)[0];
    if (with.other == i) continue;
    const NeighborImage back = with.reversed_image(i);
    const Vec2 normal = direction(draw.uniform(0, 2 * pi));
    crowd.lists.store_axis(i, with, normal);
    EXPECT_EQ(axis_of(i, with), normal);
    EXPECT_EQ(axis_of(with.other, back), -normal);
    crowd.update(i, crowd.poses[i], 1);
    EXPECT_EQ(axis_of(i, with), normal);
    EXPECT_EQ(axis_of(with.other, back), -normal);
    ++noted;
  }
  EXPECT_GT(noted, 15);
}

TYPED_TEST(Memories, BeginWithAnAxisThatSeparates) {
  Stream draw(65, Purpose::tests);
  Crowd<TypeParam> crowd = random_crowd<TypeParam>(draw, Vec2(25, 25), 100, 7, 100);
  int apart = 0, separated_by_it = 0;
  for (std::size_t i = 0; i < 100; ++i)
    for (const Neighbor<TypeParam>& neighbor : crowd.lists.of(i)) {
      const std::size_t j = neighbor.other;
      const Vec2 d = crowd.poses[j].position + crowd.box.translation(neighbor.shift()) -
                     crowd.poses[i].position;
      const Vec2 n = neighbor.warm_start.axis;
      EXPECT_NEAR(n.norm(), 1, 1e-14);
      const double reach = support(crowd.shape(i), direction(crowd.poses[i].angle), n) +
                           support(crowd.shape(j), direction(crowd.poses[j].angle), n);
      const double best =
          distance(crowd.shape(i), crowd.poses[i].angle, crowd.shape(j), crowd.poses[j].angle, d);
      apart += best > 0;
      separated_by_it += best > 0 && n.dot(d) > reach;
    }
  EXPECT_GT(apart, 100);
  EXPECT_GT(separated_by_it, 0.95 * apart);
}

// ---- Exits ----

template <class B>
class Exits : public testing::Test {};
TYPED_TEST_SUITE(Exits, Bodies);

double height(const Disk& disk, double, const Vec2&) {
  return disk.radius;
}
double height(const Ellipse& ellipse, double angle, const Vec2& n) {
  return support(ellipse, direction(angle), n);
}

/// Particle 0 inside its neighbourhood, perhaps long after its last renewal.
struct Inside {
  Pose2 pose;
  Motion2 motion;
  CommonSize common;
};

template <class B>
Inside random_inside(Stream& draw, const Crowd<B>& crowd, double growth) {
  Inside inside;
  const double room = crowd.lists.margin() * draw.uniform();
  const double share = draw.uniform();
  const double max_support_rate =
      std::max(crowd.sizes[0] * crowd.shape(0).max_support_rate(), 1e-3);
  inside.pose = {crowd.poses[0].position + share * room * direction(draw.uniform(0, 2 * pi)),
                 crowd.poses[0].angle +
                     (1 - share) * room / max_support_rate * (draw.uniform() < 0.5 ? 1 : -1)};
  inside.motion = {{draw.normal(), draw.normal()}, draw.uniform() < 0.3 ? 0 : 3 * draw.normal()};
  inside.common = {crowd.sizes[0], growth};
  return inside;
}

template <class B>
double exit_time(const Crowd<B>& crowd, const Inside& inside) {
  return crowd.lists.exit_time(0, inside.pose, inside.motion, inside.common);
}

/// Returns |Δr| + rate |Δθ| since the last renewal.
template <class B>
double used_margin(const Crowd<B>& crowd, const Inside& inside, double time, double rate) {
  const Pose2 pose = advanced(inside.pose, inside.motion, time);
  return (pose.position - crowd.poses[0].position).norm() +
         rate * std::abs(pose.angle - crowd.poses[0].angle);
}

// Sampled in time and in all directions, the body does not reach beyond its own shape at the last
// renewal, widened by the margin.
TYPED_TEST(Exits, UntilThenTheBodyIsInsideItsNeighborhood) {
  Stream draw(66, Purpose::tests);
  for (int trial = 0; trial < 400; ++trial) {
    Crowd<TypeParam> crowd = small_crowd<TypeParam>(draw);
    const bool grows = std::is_same_v<TypeParam, GrowingEllipse> && trial % 3;
    const double growth = grows ? (trial % 3 == 1 ? 0.3 : -0.3) * draw.uniform() : 0;
    if (grows) crowd.update(0, crowd.poses[0], 1 + growth * draw.uniform());
    Inside inside = random_inside(draw, crowd, growth);
    // Since the last renewal it has grown too, at first by as much as there is room for.
    if (growth > 0)
      inside.common.size += 0.5 * crowd.lists.margin() / crowd.shape(0).circumradius();
    const double exit = exit_time(crowd, inside);
    ASSERT_GE(exit, 0);
    ASSERT_LT(exit, 1e9);
    for (int k = 0; k <= 40 && exit > 0; ++k) {
      const double time = exit * k / 40;
      const Pose2 pose = advanced(inside.pose, inside.motion, time);
      const double size = inside.common.size + growth * time;
      for (int m = 0; m < 90; ++m) {
        const Vec2 n = direction(2 * pi * m / 90);
        const double now = n.dot(pose.position) + size * height(crowd.shape(0), pose.angle, n);
        const double then = n.dot(crowd.poses[0].position) +
                            crowd.sizes[0] * height(crowd.shape(0), crowd.poses[0].angle, n);
        ASSERT_LE(now, then + crowd.lists.margin() * (1 + 1e-12) + 1e-13) << "at " << k << "/40";
      }
    }
  }
}

// Without growth it is exactly the time at which |Δr| + max_support_rate |Δθ| reaches the margin.
TYPED_TEST(Exits, ComeNoEarlierThanNeedBe) {
  Stream draw(67, Purpose::tests);
  for (int trial = 0; trial < 2'000; ++trial) {
    Crowd<TypeParam> crowd = small_crowd<TypeParam>(draw);
    const Inside inside = random_inside(draw, crowd, 0);
    const double exit = exit_time(crowd, inside);
    const double rate = crowd.shape(0).max_support_rate(), margin = crowd.lists.margin();
    EXPECT_NEAR(used_margin(crowd, inside, exit, rate), margin, 1e-9 * margin);
    EXPECT_LT(used_margin(crowd, inside, 0.5 * exit, rate), margin);
  }
}

// With growth not by much: the support rate is a tenth too large, and nothing is promised for longer
// than the time of a growth by a tenth.
TEST(GrowingExits, ComeNotMuchEarlierThanNeedBe) {
  Stream draw(68, Purpose::tests);
  for (int trial = 0; trial < 2'000; ++trial) {
    Crowd<GrowingEllipse> crowd = small_crowd<GrowingEllipse>(draw);
    const double growth = draw.uniform(0.01, 1);
    const Inside inside = random_inside(draw, crowd, growth);
    const double exit = exit_time(crowd, inside);
    const double used = used_margin(crowd, inside, exit, 1.1 * crowd.shape(0).max_support_rate()) +
                        growth * exit * crowd.shape(0).circumradius();
    EXPECT_LE(growth * exit, 0.1 + 1e-12);
    const bool at_the_tenth = std::abs(growth * exit - 0.1) < 1e-12;
    const bool outside_already = exit == 0;
    if (!at_the_tenth && !outside_already) {
      EXPECT_NEAR(used, crowd.lists.margin(), 1e-9 * crowd.lists.margin());
    }
  }
}

TYPED_TEST(Exits, ComeAtOnceOutsideAndNeverAtRest) {
  Stream draw(69, Purpose::tests);
  Crowd<TypeParam> crowd = small_crowd<TypeParam>(draw);
  Pose2 outside = crowd.poses[0];
  outside.position.x() += 1.01 * crowd.lists.margin();
  EXPECT_EQ(crowd.lists.exit_time(0, outside, {{-1, 0}, 0.1}, {1, 0}), 0);
  EXPECT_EQ(crowd.lists.exit_time(0, crowd.poses[0], {{0, 0}, 0}, {1, 0}),
            std::numeric_limits<double>::infinity());
}

// A neighbourhood around the pose ahead lasts longer by the part of the margin that lies between, unless a face of the
// box is in the way.
TYPED_TEST(Exits, ComeLaterFromANeighborhoodAhead) {
  Stream draw(73, Purpose::tests);
  int unhindered = 0;
  for (int trial = 0; trial < 500; ++trial) {
    Crowd<TypeParam> crowd = small_crowd<TypeParam>(draw);
    const Pose2 pose = crowd.poses[0];
    const Motion2 motion{{draw.normal(), draw.normal()}, 3 * draw.normal()};
    const double present = crowd.lists.exit_time(0, pose, motion, {1, 0});
    const Pose2 ahead = crowd.lists.ahead_of(0, pose, motion);
    EXPECT_TRUE((ahead.position.array().abs() <= 0.5 * crowd.box.lengths().array()).all());
    crowd.update(0, ahead, 1);
    const double later = crowd.lists.exit_time(0, pose, motion, {1, 0});
    EXPECT_GT(later, present);
    if ((ahead.position.array().abs() == 0.5 * crowd.box.lengths().array()).any()) continue;
    EXPECT_NEAR(later, 1.4 * present, 1e-9 * present);
    ++unhindered;
  }
  EXPECT_GT(unhindered, 300);
}

// ---- What lists are kept in ----

TEST(ListPool, HoldsWhatVectorsHold) {
  Stream draw(70, Purpose::tests);
  constexpr std::size_t lists = 30;
  ListPool<std::uint64_t> pool(lists);
  std::vector<std::vector<std::uint64_t>> expected(lists);
  std::vector<std::uint32_t> counts(lists);
  for (std::uint32_t& count : counts) count = static_cast<std::uint32_t>(draw.below(5));
  for (const bool reserved : {false, true}) {
    if (reserved) {
      pool.reserve(counts);
      for (auto& list : expected) list.clear();
    }
    for (int n = 0; n < 20'000; ++n) {
      const std::size_t k = draw.below(lists);
      const std::uint64_t choice = draw.below(20), value = draw.below(100);
      if (choice < 17) {
        pool.add(k, value);
        expected[k].push_back(value);
      } else if (choice < 19) {
        const auto unwanted = [&](std::uint64_t x) { return x % 3 == value % 3; };
        pool.remove_if(k, unwanted);
        std::erase_if(expected[k], unwanted);
      } else {
        pool.clear(k);
        expected[k].clear();
      }
      for (std::size_t list : {k, (k + 1) % lists})
        ASSERT_TRUE(std::ranges::equal(pool[list], expected[list]));
    }
    for (std::size_t k = 0; k < lists; ++k) ASSERT_TRUE(std::ranges::equal(pool[k], expected[k]));
  }
}

bool is_permutation_of_all(std::vector<std::uint32_t> order, std::size_t points) {
  std::ranges::sort(order);
  std::vector<std::uint32_t> all(points);
  std::iota(all.begin(), all.end(), 0);
  return order == all;
}

TEST(SpatialOrder, NamesEveryPointOnce) {
  Stream draw(71, Purpose::tests);
  const PeriodicBox<2> box(Vec2(3, 200));
  for (const std::size_t count : {0, 1, 2, 3, 10, 1000}) {
    std::vector<Vec2> points;
    for (std::size_t k = 0; k < count; ++k)
      points.push_back({draw.uniform(-1.5, 1.5), draw.uniform(-100, 100)});
    EXPECT_TRUE(is_permutation_of_all(spatial_order<2>(box, points), count));
  }
  const std::vector<Vec2> at_one_place(7, Vec2(-1.5, 100));
  EXPECT_TRUE(is_permutation_of_all(spatial_order<2>(box, at_one_place), 7));
}

// Along Morton's curve every aligned run of 4^m sites of a lattice with 2^k × 2^k fills a square of
// 2^m × 2^m.
TEST(SpatialOrder, FillsSquareAfterSquare) {
  constexpr int side = 32;
  const PeriodicBox<2> box(Vec2(side, side));
  std::vector<Vec2> sites;
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y) sites.push_back(Vec2(x + 0.5, y + 0.5) - Vec2(16, 16));
  Stream draw(72, Purpose::tests);
  for (std::size_t k = sites.size() - 1; k > 0; --k) std::swap(sites[k], sites[draw.below(k + 1)]);
  const std::vector<std::uint32_t> order = spatial_order<2>(box, sites);
  for (int length = 2; length <= side; length *= 2) {
    const int points = length * length;
    for (std::size_t first = 0; first < order.size(); first += points) {
      Vec2 low = sites[order[first]], high = low;
      for (int k = 0; k < points; ++k) {
        low = low.cwiseMin(sites[order[first + k]]);
        high = high.cwiseMax(sites[order[first + k]]);
      }
      EXPECT_EQ(high - low, Vec2(length - 1, length - 1));
    }
  }
}

}  // namespace
}  // namespace vitrel

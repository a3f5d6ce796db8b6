// Neighbour lists in three dimensions, with and without wider neighbourhoods, against all pairs.

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <tuple>
#include <vector>

#include "core/contact/ellipsoid_gap.h"
#include "core/geometry/free_flight.h"
#include "core/neighbors/neighborhood.h"
#include "core/random/stream.h"
#include "tests/support/solids.h"

namespace vitrel {
namespace {

using Image = std::tuple<std::size_t, std::size_t, int, int, int>;  // i sees j at this shift
using Body = Growing<Ellipsoid>;

struct Scene {
  const char* name;
  double box;
  std::size_t particles;
  std::vector<Ellipsoid> kinds;
  bool layered;
};

Ellipsoid oblate(double aspect) {
  return {Vec3(std::pow(aspect, 1. / 3), std::pow(aspect, 1. / 3), std::pow(aspect, -2. / 3))};
}

const Scene scenes[] = {
    {"rods in a box hardly longer than one",
     1.01 * 2 * std::pow(30, 2. / 3),
     40,
     {prolate(30)},
     true},
    {"rods and spheres", 22, 150, {prolate(20), prolate(1)}, true},
    {"discs", 9, 120, {oblate(40)}, true},
    {"short", 15, 60, {prolate(2), {Vec3(1.2, 1, 0.8)}}, false},
    {"alone with its images", 5, 1, {prolate(3)}, false},
};

class Crowd {
 public:
  Crowd(Stream& draw, const Scene& scene)
      : scene_(scene),
        box_(Vec3::Constant(scene.box)),
        type_index_(numbers(scene), scene.kinds.size()),
        poses_(drawn_poses(draw, scene)),
        sizes_(scene.particles, 1.),
        lists_(box_, scene_.kinds, type_index_, poses_, 14) {}
  Crowd(const Crowd&) = delete;

  const Neighborhoods<Body>& lists() const { return lists_; }

  /// A particle that has left its neighbourhood by a little, as runs do it, or now and then by far.
  void renew_one(Stream& draw, double size) {
    const std::size_t i = draw.below(scene_.particles);
    Pose3& pose = poses_[i];
    if (draw.uniform() < 0.02) pose = drawn_pose(draw, scene_);
    const bool joins = draw.uniform() < 0.05;
    const double turn = lists_.margin() / scene_.kinds[type_index_[i]].circumradius();
    const Motion3 motion{random_direction(draw), turn / lists_.margin() * random_direction(draw)};
    pose = advanced(pose, motion, draw.uniform() * lists_.margin());
    if (joins) pose.position = poses_[draw.below(scene_.particles)].position;
    Shift<3> image = Shift<3>::Zero();
    box_.wrap(pose.position, image);
    sizes_[i] = static_cast<float>(size);
    lists_.update(i, pose, size);
  }

  void expect_right() const {
    const std::multiset<Image> listed = this->listed();
    for (const Image& image : listed) {
      ASSERT_EQ(listed.count(image), 1u);
      ASSERT_EQ(listed.count(seen_from_there(image)), is_own(image) ? 0u : 1u);
    }
    for (const Image& image : closer_than(2 * lists_.margin() * (1 - 1e-12)))
      ASSERT_TRUE(listed.count(image) == 1 ||
                  (is_own(image) && listed.count(seen_from_there(image)) == 1))
          << std::get<0>(image) << " lacks " << std::get<1>(image);
    const std::multiset<Image> near = closer_than(3 * lists_.margin());
    const auto far =
        std::ranges::count_if(listed, [&](const Image& i) { return !near.contains(i); });
    ASSERT_LE(static_cast<double>(far), 0.1 * static_cast<double>(listed.size()));
  }

 private:
  static bool is_own(const Image& image) { return std::get<0>(image) == std::get<1>(image); }
  static Image seen_from_there(const Image& image) {
    const auto [i, j, x, y, z] = image;
    return {j, i, -x, -y, -z};
  }
  static std::vector<std::uint32_t> numbers(const Scene& scene) {
    std::vector<std::uint32_t> all;
    for (std::size_t i = 0; i < scene.particles; ++i)
      all.push_back(static_cast<std::uint32_t>(i % scene.kinds.size()));
    return all;
  }
  static Pose3 drawn_pose(Stream& draw, const Scene& scene) {
    const auto place = [&] { return scene.box * draw.uniform(-0.5, 0.5); };
    return {{place(), place(), place()}, random_orientation(draw)};
  }
  static std::vector<Pose3> drawn_poses(Stream& draw, const Scene& scene) {
    std::vector<Pose3> drawn;
    for (std::size_t i = 0; i < scene.particles; ++i) drawn.push_back(drawn_pose(draw, scene));
    return drawn;
  }

  std::multiset<Image> listed() const {
    std::multiset<Image> images;
    for (std::size_t i = 0; i < scene_.particles; ++i)
      for (const Neighbor<Body>& neighbor : lists_.of(i)) {
        const Shift<3> shift = neighbor.shift();
        images.insert({i, neighbor.other, shift.x(), shift.y(), shift.z()});
      }
    return images;
  }

  /// By the support gap of all images of all pairs.
  std::multiset<Image> closer_than(double gap) const {
    std::multiset<Image> images;
    for (std::size_t i = 0; i < scene_.particles; ++i)
      for (std::size_t j = 0; j < scene_.particles; ++j) {
        const Ellipsoid one = scaled(scene_.kinds[type_index_[i]], sizes_[i]);
        const Ellipsoid two = scaled(scene_.kinds[type_index_[j]], sizes_[j]);
        box_.for_each_image(
            poses_[j].position - poses_[i].position, one.circumradius() + two.circumradius() + gap,
            [&](const Shift<3>& shift, const Vec3& d) {
              if (i == j && shift.isZero()) return;
              if (!separated(one, poses_[i].orientation, two, poses_[j].orientation, d, gap))
                images.insert({i, j, shift.x(), shift.y(), shift.z()});
            });
      }
    return images;
  }

  const Scene& scene_;
  PeriodicBox<3> box_;
  TypeIndex type_index_;
  std::vector<Pose3> poses_;
  std::vector<double> sizes_;
  Neighborhoods<Body> lists_;
};

TEST(NeighborListsOfSolids, HoldAllWhoseNeighborhoodsMeet) {
  Stream draw(1, Purpose::tests, 701);
  for (const Scene& scene : scenes) {
    SCOPED_TRACE(scene.name);
    const Crowd crowd(draw, scene);
    EXPECT_EQ(crowd.lists().is_layered(), scene.layered);
    crowd.expect_right();
  }
}

TEST(NeighborListsOfSolids, StayRightThroughThousandsOfRenewals) {
  Stream draw(2, Purpose::tests, 701);
  for (const Scene& scene : scenes)
    for (const double last_size : {1., 1.2, 0.8}) {
      SCOPED_TRACE(scene.name);
      Crowd crowd(draw, scene);
      constexpr int renewals = 3'000;
      for (int n = 1; n <= renewals; ++n) {
        crowd.renew_one(draw, std::pow(last_size, static_cast<double>(n) / renewals));
        if (n % 300 == 0) crowd.expect_right();
        if (HasFatalFailure()) return;
      }
    }
}

}  // namespace
}  // namespace vitrel

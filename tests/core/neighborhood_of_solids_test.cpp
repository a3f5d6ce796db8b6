// Neighbour lists in three dimensions, with and without wider neighbourhoods, against all pairs.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/geometry/free_flight.h"
#include "tests/support/neighbor_crowd.h"

namespace vitrel {
namespace {

using Body = Growing<Ellipsoid>;

struct Scene {
  const char* name;
  double box;
  std::size_t particles;
  std::vector<Ellipsoid> kinds;
  bool layered;
};

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

Crowd<Body> random_crowd(Stream& draw, const Scene& scene) {
  return {draw, Vec3::Constant(scene.box), scene.particles, 14, scene.kinds};
}

/// Renews a particle that has left its neighbourhood by a little, as in runs, or now and then by
/// far.
void renew_one(Crowd<Body>& crowd, Stream& draw, double size) {
  const std::size_t i = draw.below(crowd.poses.size());
  const double margin = crowd.lists.margin();
  Pose3& pose = crowd.poses[i];
  if (draw.uniform() < 0.02) pose = random_pose(draw, crowd.box.lengths());
  const bool joins = draw.uniform() < 0.05;
  const double turn = margin / crowd.shape(i).circumradius();
  const Motion3 motion{random_direction(draw), turn / margin * random_direction(draw)};
  pose = advanced(pose, motion, draw.uniform() * margin);
  if (joins) pose.position = crowd.poses[draw.below(crowd.poses.size())].position;
  crowd.renew(i, pose, size);
  crowd.sizes[i] = static_cast<float>(size);
}

TEST(NeighborListsOfSolids, HoldAllWhoseNeighborhoodsMeet) {
  Stream draw(1, Purpose::tests, 701);
  for (const Scene& scene : scenes) {
    SCOPED_TRACE(scene.name);
    Crowd<Body> crowd = random_crowd(draw, scene);
    EXPECT_EQ(crowd.lists.is_layered(), scene.layered);
    crowd.expect_lists_right(0.1);
  }
}

TEST(NeighborListsOfSolids, StayRightThroughThousandsOfRenewals) {
  Stream draw(2, Purpose::tests, 701);
  for (const Scene& scene : scenes)
    for (const double last_size : {1., 1.2, 0.8}) {
      SCOPED_TRACE(scene.name);
      Crowd<Body> crowd = random_crowd(draw, scene);
      constexpr int renewals = 3'000;
      for (int n = 1; n <= renewals; ++n) {
        renew_one(crowd, draw, std::pow(last_size, static_cast<double>(n) / renewals));
        if (n % 300 == 0) crowd.expect_lists_right(0.1);
        if (HasFatalFailure()) return;
      }
    }
}

}  // namespace
}  // namespace vitrel

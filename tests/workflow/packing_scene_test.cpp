#include "workflow/report/packing_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "core/random/stream.h"
#include "tests/support/solids.h"

namespace vitrel {
namespace {

/// Bodies at random places, free to overlap.
Configuration3 soup(std::size_t n, const Vec3& lengths) {
  Configuration3 c;
  c.resize(n);
  c.box = PeriodicBox<3>(lengths);
  c.species_names = {"A", "B"};
  Stream draw(5, Purpose::tests);
  for (std::size_t i = 0; i < n; ++i) {
    c.species[i] = i % 3 == 0;
    c.shape[i] = i % 2 ? prolate(4) : oblate(3);
    c.orientation[i] = random_orientation(draw);
    for (int k = 0; k < 3; ++k) c.position[i][k] = lengths[k] * draw.uniform(-0.5, 0.5);
  }
  return c;
}

double signed_step(std::uint16_t step) {
  return static_cast<std::int16_t>(step);
}

TEST(PackingScene, HoldsPosesToTheRoundingOfTheirSteps) {
  const Configuration3 c = soup(50, {8, 9, 10});
  const PackingScene scene = packing_scene(c, {});
  ASSERT_EQ(scene.poses.size(), 7u * 50);
  EXPECT_EQ(scene.window, scene.box);
  for (std::size_t i = 0; i < 50; ++i) {
    for (int k = 0; k < 3; ++k) {
      const double fraction = scene.poses[7 * i + static_cast<std::size_t>(k)] / 65536.0 - 0.5;
      EXPECT_NEAR(fraction * c.box.lengths()[k], c.position[i][k], c.box.lengths()[k] / 131072);
    }
    const Quaternion& q = c.orientation[i];
    const double parts[4] = {q.w(), q.x(), q.y(), q.z()};
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(signed_step(scene.poses[7 * i + 3 + k]) / 32767, parts[k], 1 / 65534.0);
  }
}

// A rod of half-length 3 along x at x = 3.5 in a box of 8 reaches to 6.5: it is seen again from −8 on.
TEST(PackingScene, HoldsTheImagesThatMeetTheBox) {
  Configuration3 c;
  c.resize(2);
  c.species_names = {"A"};
  c.box = PeriodicBox<3>(Vec3::Constant(8));
  c.shape = {{Vec3(3, 0.5, 0.5)}, {Vec3(3, 0.5, 0.5)}};
  c.position = {Vec3(3.5, 0, 0), Vec3(0, 2, 0)};
  const PackingScene scene = packing_scene(c, {});
  ASSERT_EQ(scene.images.size(), 1u);
  EXPECT_EQ(scene.images[0].particle, 0u);
  EXPECT_EQ(scene.images[0].shift, Shift<3>(-1, 0, 0));
}

// About 100 of 1000, those near the middle: all whose centre is in the window, none whose centre is
// farther from it than its longest semi-axis.
TEST(PackingScene, ShowsTheMiddleOfALargePacking) {
  const Configuration3 c = soup(1000, {30, 30, 30});
  const PackingScene scene = packing_scene(c, {}, 100);
  EXPECT_EQ(scene.particles, 1000u);
  EXPECT_NEAR(scene.window.prod() / scene.box.prod(), 0.1, 1e-12);
  std::size_t inside = 0, near = 0;
  for (std::size_t i = 0; i < c.size(); ++i) {
    const double out = (c.position[i].cwiseAbs() - 0.5 * scene.window).maxCoeff();
    inside += out <= 0;
    near += out <= c.shape[i].circumradius();
  }
  EXPECT_GE(scene.shape.size(), inside);
  EXPECT_LT(scene.shape.size(), near);
  EXPECT_TRUE(scene.images.empty());
}

TEST(PackingScene, NamesTheParticlesThatOverlap) {
  const Configuration3 c = soup(200, {14, 14, 14});
  const ExactCheck<3> check = exact_check(c);
  ASSERT_FALSE(check.clean());
  std::set<std::size_t> overlapping;
  for (const PairImage<3>& pair : check.overlaps) overlapping.insert({pair.i, pair.j});
  const PackingScene whole = packing_scene(c, check);
  EXPECT_EQ(whole.overlapping_pairs, check.overlaps.size());
  EXPECT_EQ(std::set(whole.overlapping.begin(), whole.overlapping.end()), overlapping);

  const PackingScene part = packing_scene(c, check, 40);
  EXPECT_EQ(part.overlapping_pairs, check.overlaps.size());
  EXPECT_LT(part.overlapping.size(), overlapping.size());
  for (const std::size_t shown : part.overlapping) EXPECT_LT(shown, part.shape.size());
}

TEST(PackingScene, GoesIntoThePageAsNumbers) {
  const PackingScene scene = packing_scene(soup(6, {8, 9, 10}), {});
  const nlohmann::json data = scene_data(scene);
  EXPECT_EQ(data["particles"], 6);
  EXPECT_EQ(data["box"], nlohmann::json({8, 9, 10}));
  EXPECT_EQ(data["window"], data["box"]);
  EXPECT_EQ(data["shapes"].size(), 2u);
  EXPECT_EQ(data["shape"], nlohmann::json({0, 1, 0, 1, 0, 1}));
  EXPECT_EQ(data["species"], nlohmann::json({1, 0, 0, 1, 0, 0}));
  EXPECT_EQ(data["images"].size(), 4 * scene.images.size());
  EXPECT_EQ(data["poses"].get<std::string>().size(), 7u * 6 * 2 / 3 * 4);
  EXPECT_EQ(data["overlapping"], nlohmann::json::array());
}

}  // namespace
}  // namespace vitrel

#include "workflow/report/movie.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "core/random/stream.h"
#include "core/state/check.h"
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

/// The moving picture of a single state.
Movie3 picture(const Configuration3& state, std::size_t max_particles = 4'000) {
  MemoryTrajectory3 still({state});
  return film(still, {.particles = max_particles});
}

double signed_step(std::uint16_t step) {
  return static_cast<std::int16_t>(step);
}

TEST(MovieInSpace, HoldsPosesToTheRoundingOfTheirSteps) {
  const Configuration3 c = soup(50, {8, 9, 10});
  const Movie3 movie = picture(c);
  ASSERT_EQ(movie.poses.size(), 7u * 50);
  EXPECT_EQ(movie.window, Vec3::Ones());
  EXPECT_EQ(movie.box[0], c.box.lengths());
  for (std::size_t i = 0; i < 50; ++i) {
    for (int k = 0; k < 3; ++k) {
      const double fraction = movie.poses[7 * i + static_cast<std::size_t>(k)] / 65536.0 - 0.5;
      EXPECT_NEAR(fraction * c.box.lengths()[k], c.position[i][k], c.box.lengths()[k] / 131072);
    }
    const Quaternion& q = c.orientation[i];
    const double parts[4] = {q.w(), q.x(), q.y(), q.z()};
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(signed_step(movie.poses[7 * i + 3 + k]) / 32767, parts[k], 1 / 65534.0);
  }
}

// A rod of half-length 3 along x at x = 3.5 in a box of 8 reaches to 6.5: it is seen again from −8 on.
TEST(MovieInSpace, HoldsTheImagesThatMeetTheBox) {
  Configuration3 c;
  c.resize(2);
  c.species_names = {"A"};
  c.box = PeriodicBox<3>(Vec3::Constant(8));
  c.shape = {{Vec3(3, 0.5, 0.5)}, {Vec3(3, 0.5, 0.5)}};
  c.position = {Vec3(3.5, 0, 0), Vec3(0, 2, 0)};
  // Half a box later the other one is seen at both ends, and half a box later still neither.
  std::vector<Configuration3> frames(3, c);
  frames[1].position = {Vec3(-0.5, 0, 0), Vec3(-4, 2, 0)};
  frames[2].position = {Vec3(0, 0, 0), Vec3(0, 2, 0)};
  for (std::size_t k = 0; k < 3; ++k) frames[k].time = static_cast<double>(k);
  MemoryTrajectory3 trajectory(std::move(frames));
  const Movie3 movie = film(trajectory);
  ASSERT_EQ(movie.images.size(), 3u);
  ASSERT_EQ(movie.images[0].size(), 1u);
  EXPECT_EQ(movie.images[0][0].particle, 0u);
  EXPECT_EQ(movie.images[0][0].shift, Shift<3>(-1, 0, 0));
  ASSERT_EQ(movie.images[1].size(), 1u);
  EXPECT_EQ(movie.images[1][0].particle, 1u);
  EXPECT_EQ(movie.images[1][0].shift, Shift<3>(1, 0, 0));
  EXPECT_TRUE(movie.images[2].empty());
}

// About 100 of 1000, those near the middle: all whose centre is in the window, none whose centre is
// farther from it than its longest semi-axis.
TEST(MovieInSpace, ShowsTheMiddleOfALargePacking) {
  const Configuration3 c = soup(1000, {30, 30, 30});
  const Movie3 movie = picture(c, 100);
  EXPECT_EQ(movie.run_particles, 1000u);
  EXPECT_NEAR(movie.window.prod(), 0.1, 1e-12);
  const Vec3 window = movie.window.cwiseProduct(c.box.lengths());
  std::size_t inside = 0, near = 0;
  for (std::size_t i = 0; i < c.size(); ++i) {
    const double out = (c.position[i].cwiseAbs() - 0.5 * window).maxCoeff();
    inside += out <= 0;
    near += out <= c.shape[i].circumradius();
  }
  EXPECT_GE(movie.particles(), inside);
  EXPECT_LT(movie.particles(), near);
  EXPECT_TRUE(movie.images[0].empty());
}

TEST(MovieInSpace, NamesTheParticlesThatOverlap) {
  const Configuration3 c = soup(200, {14, 14, 14});
  const ExactCheck<3> check = exact_check(c);
  ASSERT_FALSE(check.clean());
  std::set<std::size_t> overlapping;
  for (const PairImage<3>& pair : check.overlaps) overlapping.insert({pair.i, pair.j});
  const Movie3 whole = picture(c);
  EXPECT_EQ(whole.overlapping_pairs[0], check.overlaps.size());
  EXPECT_EQ(std::set(whole.overlapping[0].begin(), whole.overlapping[0].end()), overlapping);

  const Movie3 part = picture(c, 40);
  EXPECT_EQ(part.overlapping_pairs[0], check.overlaps.size());
  EXPECT_LT(part.overlapping[0].size(), overlapping.size());
  for (const std::size_t shown : part.overlapping[0]) EXPECT_LT(shown, part.particles());
}

// The frames of a run as of a packing, each with its own overlaps.
TEST(MovieInSpace, FramesAreThoseOfTheTrajectory) {
  std::vector<Configuration3> frames(3, soup(20, {8, 9, 10}));
  for (std::size_t k = 0; k < 3; ++k) frames[k].time = 0.5 * static_cast<double>(k);
  frames[1] = soup(20, {20, 21, 22});
  frames[1].time = 0.5;
  MemoryTrajectory3 trajectory(frames);
  const Movie3 movie = film(trajectory);
  ASSERT_EQ(movie.frames(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    const Movie3 alone = picture(frames[k]);
    EXPECT_EQ(movie.time[k], frames[k].time);
    EXPECT_EQ(movie.box[k], frames[k].box.lengths());
    const auto begin = movie.poses.begin() + static_cast<std::ptrdiff_t>(k * 7 * 20);
    EXPECT_TRUE(std::equal(alone.poses.begin(), alone.poses.end(), begin));
    EXPECT_EQ(movie.images[k].size(), alone.images[0].size());
    EXPECT_EQ(movie.overlapping[k], alone.overlapping[0]);
  }
}

// A box of 10 is crossed from frame to frame: 1.3 boxes along x, of which the shortest way is 0.3.
TEST(MovieInSpace, LongWaysAreToldByJumps) {
  std::vector<Configuration3> frames(3, soup(1, {10, 10, 10}));
  for (std::size_t k = 0; k < 3; ++k) {
    frames[k].time = static_cast<double>(k);
    frames[k].position[0] += Vec3(13.0 * static_cast<double>(k), 0, 0);
    frames[k].box.wrap(frames[k].position[0], frames[k].image[0]);
  }
  MemoryTrajectory3 trajectory(std::move(frames));
  const Movie3 movie = film(trajectory);
  ASSERT_EQ(movie.jumps.size(), 2u);
  for (const Movie3::Jump& jump : movie.jumps) EXPECT_EQ(jump.shift, Shift<3>(1, 0, 0));
  EXPECT_TRUE(film(trajectory, {.images_known = false}).jumps.empty());
}

// Poses take 7 × 16 bits, in base64 56/3 characters; 12 for every image. Spheres of radius 1 at rest in the
// middle have no images, at a corner seven.
TEST(MovieInSpace, ImagesCostFrames) {
  Configuration3 c;
  c.resize(10);
  c.species_names = {"A"};
  c.box = PeriodicBox<3>(Vec3::Constant(30));
  const auto frames_at = [&c](const Vec3& position) {
    std::vector<Configuration3> frames(100, c);
    for (std::size_t k = 0; k < frames.size(); ++k) {
      frames[k].time = static_cast<double>(k);
      for (std::size_t i = 0; i < c.size(); ++i)
        frames[k].position[i] = position + Vec3(0, 0.01 * static_cast<double>(i), 0);
    }
    MemoryTrajectory3 trajectory(std::move(frames));
    return film(trajectory, {.characters = std::size_t{10} * 56 / 3 * 40}).frames();
  };
  EXPECT_EQ(frames_at(Vec3::Zero()), 40u);
  EXPECT_EQ(frames_at(Vec3::Constant(-14.9)), 10u * 56 / 3 * 40 / (10 * 56 / 3 + 10 * 7 * 12));
}

TEST(MovieInSpace, GoesIntoThePageAsNumbers) {
  const Movie3 movie = picture(soup(6, {8, 9, 10}));
  const nlohmann::json data = movie_data(movie);
  EXPECT_EQ(data["particles"], 6);
  EXPECT_EQ(data["box"], nlohmann::json({{8, 9, 10}}));
  EXPECT_EQ(data["window"], nlohmann::json({1, 1, 1}));
  EXPECT_EQ(data["shapes"].size(), 2u);
  EXPECT_EQ(data["shape"], nlohmann::json({0, 1, 0, 1, 0, 1}));
  EXPECT_EQ(data["species"], nlohmann::json({1, 0, 0, 1, 0, 0}));
  EXPECT_EQ(data["images"].size(), 1u);
  EXPECT_EQ(data["images"][0].size(), 4 * movie.images[0].size());
  EXPECT_EQ(data["poses"].get<std::string>().size(), 7u * 6 * 2 / 3 * 4);
  EXPECT_EQ(data["overlapping"], nlohmann::json(movie.overlapping));
}

}  // namespace
}  // namespace vitrel

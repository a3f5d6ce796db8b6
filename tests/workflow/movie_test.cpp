#include "workflow/report/movie.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/report_example.h"

namespace vitrel {
namespace {

using report_example::lattice;
using report_example::overlapping_frame;

constexpr double rounding = 0.5 / 65'536;

/// Where a shown particle is, in fractions of the box from −1/2 to 1/2, and its angle.
struct Shown {
  Vec2 position;
  double angle;
};
Shown shown(const Movie2& movie, std::size_t frame, std::size_t particle) {
  const std::uint16_t* pose = &movie.poses[3 * (frame * movie.particles() + particle)];
  return {Vec2(pose[0], pose[1]) / 65'536 - Vec2::Constant(0.5), pose[2] * M_PI / 65'536};
}

/// The displacement since frame 0, in boxes, as the page adds it up: the shortest way between frames,
/// and the jumps.
Vec2 displacement(const Movie2& movie, std::size_t frame, std::size_t particle) {
  Vec2 path = Vec2::Zero();
  for (std::size_t k = 1; k <= frame; ++k) {
    const Vec2 step = shown(movie, k, particle).position - shown(movie, k - 1, particle).position;
    path += step - (step.array() + 0.5).floor().matrix();  // from −1/2 up to, not including, 1/2
    for (const Movie2::Jump& jump : movie.jumps)
      if (jump.frame == k && jump.particle == particle) path += jump.shift.cast<double>().matrix();
  }
  return path;
}

double distance_on_circle(double x, double y, double period) {
  return std::abs(std::remainder(x - y, period));
}

TEST(Movie, PosesAreThoseOfTheTrajectoryToHalfAStep) {
  MemoryTrajectory2 trajectory = lattice(5, 20);
  const Movie2 movie = film(trajectory);
  ASSERT_EQ(movie.frames(), 20u);
  ASSERT_EQ(movie.particles(), 25u);
  EXPECT_EQ(movie.time[3], 1.5);
  EXPECT_EQ(movie.box[3], Vec2(20, 20));
  EXPECT_EQ(movie.species[1], 1);
  for (const std::size_t k : {0u, 7u, 19u}) {
    const Configuration2& state = trajectory.read(k);
    for (std::size_t i = 0; i < 25; ++i) {
      const Shown pose = shown(movie, k, i);
      for (int axis = 0; axis < 2; ++axis)
        EXPECT_LE(distance_on_circle(pose.position[axis], state.position[i][axis] / 20, 1),
                  rounding * (1 + 1e-9));
      EXPECT_LE(distance_on_circle(pose.angle, state.angle[i], M_PI), M_PI * rounding * (1 + 1e-9));
    }
  }
}

TEST(Movie, ShortWaysNeedNoJumps) {
  MemoryTrajectory2 trajectory = lattice(5, 100);
  const Movie2 movie = film(trajectory);
  // Particle 1 is on another one in the overlapping frame, 3.5 away: still a short way.
  EXPECT_TRUE(movie.jumps.empty());
  // 99 steps of (1, 0.5) in a box of 20.
  const Vec2 expected(99.0 / 20, 49.5 / 20);
  EXPECT_LE((displacement(movie, 99, 7) - expected).cwiseAbs().maxCoeff(), 2 * rounding);
}

TEST(Movie, LongWaysAreToldByJumps) {
  MemoryTrajectory2 trajectory = lattice(5, 200);
  MovieLimits limits;
  limits.frames = 5;  // 49.75 steps apart: two and a half boxes along x, more than one along y
  Movie2 movie = film(trajectory, limits);
  ASSERT_EQ(movie.frames(), 5u);
  EXPECT_FALSE(movie.jumps.empty());
  const Vec2 expected(199.0 / 20, 99.5 / 20);
  for (const std::size_t i : {0u, 12u, 24u})
    EXPECT_LE((displacement(movie, 4, i) - expected).cwiseAbs().maxCoeff(), 2 * rounding);
  // Without image counts the shortest way is all that is known.
  limits.images_known = false;
  movie = film(trajectory, limits);
  EXPECT_TRUE(movie.jumps.empty());
}

TEST(Movie, OverlapsComeFromTheExactCheckOfEveryShownFrame) {
  MemoryTrajectory2 trajectory = lattice(4, 6);
  const Movie2 movie = film(trajectory);
  for (std::size_t k = 0; k < 6; ++k) {
    const bool overlaps = k == overlapping_frame;
    EXPECT_EQ(movie.overlapping_pairs[k], overlaps ? 1u : 0u);
    EXPECT_EQ(movie.overlapping[k],
              overlaps ? std::vector<std::size_t>({0, 1}) : std::vector<std::size_t>());
  }
}

TEST(Movie, OverlapsAreSeenThatTheRoundedPosesHide) {
  // Two disks of radius 1, nearer than two radii by 1e-12: far below a step of the poses, 15/65536.
  Configuration2 state;
  state.box = PeriodicBox<2>(Vec2(15, 15));
  state.resize(2);
  state.position[1] = Vec2(2 - 1e-12, 0);
  MemoryTrajectory2 touching({state});
  EXPECT_EQ(film(touching).overlapping_pairs, std::vector<std::size_t>({1}));
  state.position[1] = Vec2(2 + 1e-12, 0);
  MemoryTrajectory2 apart({state});
  EXPECT_EQ(film(apart).overlapping_pairs, std::vector<std::size_t>({0}));
}

TEST(Movie, ThinnedFramesAreEvenAndHaveBothEnds) {
  MemoryTrajectory2 trajectory = lattice(10, 101);
  MovieLimits limits;
  limits.characters = std::size_t{8} * 100 * 11;
  const Movie2 movie = film(trajectory, limits);
  ASSERT_EQ(movie.frames(), 11u);
  EXPECT_EQ(movie.run_frames, 101u);
  for (std::size_t k = 0; k < 11; ++k) EXPECT_EQ(movie.time[k], 5.0 * static_cast<double>(k));
  limits.characters = 0;
  EXPECT_EQ(film(trajectory, limits).time, std::vector<double>({50}));
}

TEST(Movie, ManyJumpsCostFrames) {
  // One frame in 40: ways of two boxes, and every particle jumps in every frame.
  MemoryTrajectory2 trajectory = lattice(3, 641);
  MovieLimits limits;
  limits.characters = std::size_t{8} * 9 * 17;
  const Movie2 movie = film(trajectory, limits);
  EXPECT_LT(movie.frames(), 17u);
  EXPECT_GT(movie.frames(), 2u);
  EXPECT_LE(8 * movie.particles() * movie.frames() + 16 * movie.jumps.size(),
            11 * limits.characters / 10);
}

TEST(Movie, OfManyParticlesThoseInTheMiddleAreShown) {
  MemoryTrajectory2 trajectory = lattice(30, 3);
  MovieLimits limits;
  limits.particles = 200;
  const Movie2 movie = film(trajectory, limits);
  EXPECT_EQ(movie.run_particles, 900u);
  const double side = std::sqrt(200.0 / 900);
  EXPECT_EQ(movie.window, Vec2(side, side));
  // The window reaches to ±28.3, and rows are at ±2, ±6 … ±26.
  EXPECT_EQ(movie.particles(), 196u);
  for (std::size_t i = 0; i < movie.particles(); ++i)
    EXPECT_LE(shown(movie, 0, i).position.cwiseAbs().maxCoeff(), 26.0 / 120 + rounding);
}

TEST(Movie, DataForThePageAreBase64WithTheLowByteFirst) {
  Movie2 movie;
  movie.time = {0};
  movie.box = {Vec2(2, 3)};
  movie.shape = {{2, 0.5}};
  movie.species = {0};
  movie.species_names = {"A"};
  movie.poses = {0x4142, 0x4344, 0x4546};  // the bytes "BADCFE"
  movie.overlapping_pairs = {0};
  movie.overlapping = {{}};
  EXPECT_EQ(movie_data(movie)["poses"], "QkFEQ0ZF");
  movie.poses = {0x4142, 0x4344};
  EXPECT_EQ(movie_data(movie)["poses"], "QkFEQw==");
  movie.poses = {0x4142, 0x4344, 0x4546, 0x4748};
  EXPECT_EQ(movie_data(movie)["poses"], "QkFEQ0ZFSEc=");
  EXPECT_FALSE(movie_data(movie).contains("species"));
  EXPECT_TRUE(movie_data(Movie2{}).is_null());
}

}  // namespace
}  // namespace vitrel

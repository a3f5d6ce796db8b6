#include "analysis/dynamics/displacement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "analysis/dynamics/director_frame.h"
#include "analysis/structure/order.h"
#include "analysis/structure/orientation_tensor.h"
#include "tests/support/frames.h"
#include "tests/support/particles_of.h"
#include "tests/support/walking_solids.h"

namespace vitrel {
namespace {

using std::numbers::pi;

/// Mean over all origins and particles of value(particle, frame, frame `lag` later).
template <class Value>
double slow_mean(MemoryTrajectory3& trajectory, std::size_t lag, Value&& value) {
  double sum = 0, count = 0;
  for (std::size_t k = 0; k + lag < trajectory.frames(); ++k) {
    const Configuration3 from = trajectory.read(k), to = trajectory.read(k + lag);
    for (std::size_t i = 0; i < from.size(); ++i, ++count) sum += value(i, from, to);
  }
  return sum / count;
}

Vec3 moved(std::size_t i, const Configuration3& from, const Configuration3& to) {
  return to.unwrapped(i) - from.unwrapped(i);
}

/// cos of the angle by which an axis of the body has turned.
double turned(std::size_t i, const Configuration3& from, const Configuration3& to, int axis) {
  return (from.orientation[i] * Vec3::Unit(axis)).dot(to.orientation[i] * Vec3::Unit(axis));
}

/// The Legendre polynomials P_n of that cosine, in the mean.
double slow_order(MemoryTrajectory3& trajectory, std::size_t lag, unsigned n, int axis) {
  return slow_mean(trajectory, lag, [&](auto i, auto& from, auto& to) {
    return std::legendre(n, std::clamp(turned(i, from, to, axis), -1.0, 1.0));
  });
}

constexpr std::size_t lags[] = {1, 2, 7, 20};

TEST(DisplacementOfSolids, TranslationIsThatOfALoopOverAllPairsOfFrames) {
  MemoryTrajectory3 trajectory = walkers(12, 41, Vec3(1, 1, 1), 0.5, 1);
  const Displacements found =
      displacements(trajectory, {.wave_numbers = {0.5, 3}, .overlap_distance = 1.5});
  const DisplacementGroup& all = found.groups.front();
  EXPECT_EQ(all.rotors, 0u);
  EXPECT_TRUE(all.orientation.empty());
  for (const std::size_t lag : lags) {
    const std::size_t l = lag - 1;
    ASSERT_NEAR(found.lag[l], 0.5 * static_cast<double>(lag), 1e-12);
    const auto mean = [&](auto&& value) { return slow_mean(trajectory, lag, value); };
    const auto power = [&](int exponent) {
      return mean([=](auto i, auto& from, auto& to) {
        return std::pow(moved(i, from, to).norm(), exponent);
      });
    };
    const double square = power(2), quartic = power(4);
    EXPECT_NEAR(all.translation.value[l], square, 1e-12 * square);
    EXPECT_NEAR(all.quartic.value[l], quartic, 1e-12 * quartic);
    EXPECT_NEAR(all.non_gaussian.value[l], 3 * quartic / (5 * square * square) - 1, 1e-12);
    for (const std::size_t q : {0, 1}) {
      const double scattering = mean([&](auto i, auto& from, auto& to) {
        return std::sph_bessel(0, found.wave_numbers[q] * moved(i, from, to).norm());
      });
      EXPECT_NEAR(all.self_scattering[q].value[l], scattering, 1e-12);
    }
    const double overlap =
        mean([](auto i, auto& from, auto& to) { return moved(i, from, to).norm() < 1.5 ? 1 : 0; });
    EXPECT_NEAR(found.overlap.value[l], overlap, 1e-12);
  }
}

// The rotation vector adds up the turns of the single steps.
TEST(DisplacementOfSolids, RotationOfSpheroidsIsThatOfALoop) {
  MemoryTrajectory3 trajectory = walkers(12, 41, Vec3(2, 0.7, 0.7), 0.8, 2);
  std::vector<std::vector<Vec3>> angle(41, std::vector<Vec3>(12, Vec3::Zero()));
  for (std::size_t k = 1; k < 41; ++k) {
    const Configuration3 from = trajectory.read(k - 1), to = trajectory.read(k);
    for (std::size_t i = 0; i < 12; ++i) {
      const Eigen::AngleAxisd step(to.orientation[i] * from.orientation[i].inverse());
      angle[k][i] = angle[k - 1][i] + step.angle() * step.axis();
    }
  }
  const Displacements found = displacements(trajectory);
  EXPECT_EQ(found.axes, 1u);
  EXPECT_EQ(found.orders, (std::vector<double>{1, 2}));
  EXPECT_TRUE(found.unknown_turns.empty());
  const DisplacementGroup& all = found.groups.front();
  for (const std::size_t lag : lags) {
    const std::size_t l = lag - 1;
    const double along = slow_mean(trajectory, lag, [](auto i, auto& from, auto& to) {
      return std::pow(moved(i, from, to).dot(from.orientation[i] * Vec3::UnitX()), 2);
    });
    EXPECT_NEAR(all.parallel.value[l], along, 1e-12 * along);
    EXPECT_NEAR(all.perpendicular.value[l], all.translation.value[l] - along, 1e-12 * along);
    double square = 0, quartic = 0;
    for (std::size_t k = 0; k + lag < 41; ++k)
      for (std::size_t i = 0; i < 12; ++i) {
        const double turn = (angle[k + lag][i] - angle[k][i]).squaredNorm();
        square += turn / (12.0 * static_cast<double>(41 - lag));
        quartic += turn * turn / (12.0 * static_cast<double>(41 - lag));
      }
    EXPECT_NEAR(all.rotation.value[l], square, 1e-10);
    EXPECT_NEAR(all.quartic_rotation.value[l], quartic, 1e-9);
    EXPECT_NEAR(all.non_gaussian_rotation.value[l], 3 * quartic / (5 * square * square) - 1, 1e-9);
    for (const unsigned n : {1u, 2u})
      EXPECT_NEAR(all.orientation[n - 1].value[l], slow_order(trajectory, lag, n, 0), 1e-12);
  }
}

// From the longest to the shortest: y, x, z.
TEST(DisplacementOfSolids, ScaleneBodiesHaveThreeAxes) {
  MemoryTrajectory3 trajectory = walkers(8, 31, Vec3(1, 2, 0.5), 0.8, 3);
  const Displacements found = displacements(trajectory, {.orders = {1, 3}});
  EXPECT_EQ(found.axes, 3u);
  const DisplacementGroup& all = found.groups.front();
  ASSERT_EQ(all.orientation.size(), 6u);
  std::size_t next = 0;
  for (const int axis : {1, 0, 2})
    for (const unsigned n : {1u, 3u}) {
      const double p = slow_order(trajectory, 7, n, axis);
      EXPECT_NEAR(all.orientation[next++].value[6], p, 1e-12) << axis << ' ' << n;
    }
}

// A turn by more than half a turn looks like a shorter one the other way: then rotation is not given, but what
// needs no turns is.
TEST(DisplacementOfSolids, TurnsThatCannotBeToldApartAreNotGiven) {
  MemoryTrajectory3 trajectory = walkers(8, 31, Vec3(2, 1, 1), 3, 4);
  const Displacements found = displacements(trajectory);
  EXPECT_FALSE(found.unknown_turns.empty());
  const DisplacementGroup& all = found.groups.front();
  EXPECT_TRUE(all.rotation.value.empty() && all.non_gaussian_rotation.value.empty());
  EXPECT_EQ(all.orientation.at(1).value.size(), found.lag.size());
  EXPECT_EQ(all.parallel.value.size(), found.lag.size());
}

TEST(DisplacementOfSolids, ResultDependsNeitherOnThreadsNorOnMemory) {
  MemoryTrajectory3 trajectory = walkers(40, 60, Vec3(2, 1, 1), 0.5, 5);
  const Displacements one = displacements(trajectory, {.threads = 1});
  const Displacements many = displacements(trajectory, {.memory = 1 << 12, .threads = 3});
  EXPECT_EQ(one.groups[0].translation.value, many.groups[0].translation.value);
  EXPECT_EQ(one.groups[0].rotation.value, many.groups[0].rotation.value);
  EXPECT_EQ(one.groups[0].orientation[1].error, many.groups[0].orientation[1].error);
}

// The first Bragg peak of the face-centred cubic lattice, |q| = 2π √3/a with four points in a³.
TEST(MainWaveNumber, IsThatOfTheClosestPacking) {
  const auto c = particles_of<3>(std::vector<Ellipsoid>(32), {6, 3, 4});
  const double a = std::cbrt(4 * c.box.volume() / 32);
  EXPECT_NEAR(main_wave_number(c), 2 * pi * std::sqrt(3.0) / a, 1e-12);
}

// Bodies at fixed orientations relative to a director that turns about changing axes.
TEST(DirectorFrame, InSpaceFollowsTheDirector) {
  Stream draw(7, Purpose::tests);
  Quaternion director = random_orientation(draw);
  const auto spheroids = particles_of<3>(std::vector<Ellipsoid>(8, {Vec3(1, 1, 3)}));
  auto trajectory = trajectory_of(30, spheroids, [&](Configuration3& c, std::size_t k) {
    c.time = static_cast<double>(k);
    for (int i = 0; i < 8; ++i) {
      const double azimuth = pi / 4 * i;
      const Vec3 tilt_axis(std::cos(azimuth), std::sin(azimuth), 0);
      c.orientation[i] = director * Quaternion(Eigen::AngleAxisd(0.3, tilt_axis));
    }
    director = Quaternion(Eigen::AngleAxisd(0.7, random_direction(draw))) * director;
  });
  DirectorFrame<3> seen(trajectory);
  const Vec3 first = orientation_tensor(seen.read(0)).director();
  for (std::size_t k = 0; k < 30; ++k) {
    const Configuration3& frame = seen.read(k);
    EXPECT_NEAR(std::abs(orientation_tensor(frame).director().dot(first)), 1, 1e-12) << k;
    for (const Quaternion& q : frame.orientation)
      EXPECT_NEAR(std::abs((q * Vec3::UnitZ()).dot(first)), std::cos(0.3), 1e-12);
  }
}

// Over 2000 gases of 100 rotors: the mean of S is known to 2.5 per mille (standard deviation about a tenth of
// it), the expansion holds to 1 %.
TEST(NematicOrder, ByChanceInSpace) {
  double sum = 0, squares = 0;
  constexpr int gases = 2000;
  for (std::uint64_t gas = 0; gas < gases; ++gas) {
    Stream draw(gas, Purpose::tests);
    auto c = particles_of<3>(std::vector<Ellipsoid>(100, {Vec3(1, 1, 2)}));
    for (Quaternion& q : c.orientation) q = random_orientation(draw);
    const double order = orientation_tensor(c).nematic_order();
    sum += order;
    squares += order * order;
  }
  const double mean = sum / gases;
  const double error = std::sqrt((squares / gases - mean * mean) / gases);
  EXPECT_NEAR(mean, nematic_order_by_chance(100, 3), 0.01 * mean + 3 * error);
}

}  // namespace
}  // namespace vitrel

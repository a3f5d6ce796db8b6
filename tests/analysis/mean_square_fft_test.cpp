#include "analysis/dynamics/mean_square_fft.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/dynamics/displacement.h"
#include "tests/support/free_brownian.h"

namespace vitrel {
namespace {

double direct(const std::vector<double>& x, std::size_t lag) {
  double sum = 0;
  for (std::size_t k = 0; k + lag < x.size(); ++k) sum += (x[k + lag] - x[k]) * (x[k + lag] - x[k]);
  return sum / static_cast<double>(x.size() - lag);
}

// Random walks that begin far away: the offset must not cost accuracy. The bound is ten times the rounding
// of numbers of the size of the sums.
TEST(MeanSquareFft, EqualsTheDirectSumAtEveryLag) {
  for (const std::size_t length : {1u, 2u, 3u, 64u, 65u, 1000u}) {
    Stream draw(length, Purpose::tests);
    std::vector<double> x(length, 1000.0);
    for (std::size_t k = 1; k < length; ++k) x[k] = x[k - 1] + draw.normal();
    const auto [low, high] = std::minmax_element(x.begin(), x.end());
    const double square = (*high - *low) * (*high - *low) + 1;
    const std::vector<double> found = mean_square_changes(x);
    ASSERT_EQ(found.size(), length);
    for (std::size_t n = 0; n < length; ++n) {
      const double rounding = std::numeric_limits<double>::epsilon() * square *
                              static_cast<double>(length) / static_cast<double>(length - n);
      EXPECT_NEAR(found[n], direct(x, n), 10 * rounding) << length << " at " << n;
    }
  }
  EXPECT_TRUE(mean_square_changes({}).empty());
}

// x and y of all particles together give what the direct pass over all origins does.
TEST(MeanSquareFft, EqualsTheDisplacementsOfATrajectory) {
  MemoryTrajectory2 trajectory = free_brownian(ellipses(5), 400, 1);
  const Displacements found = displacements(trajectory, {.axis = {.every_lag_up_to = 400}});
  std::vector<double> msd(400), msr(400);
  for (std::size_t i = 0; i < 5; ++i) {
    std::vector<double> x, y, angle;
    for (std::size_t k = 0; k < 400; ++k) {
      const Configuration2& frame = trajectory.read(k);
      x.push_back(frame.unwrapped(i).x());
      y.push_back(frame.unwrapped(i).y());
      angle.push_back(frame.angle[i]);
    }
    const auto along = mean_square_changes(x), up = mean_square_changes(y);
    const auto turned = mean_square_changes(angle);
    for (std::size_t n = 0; n < 400; ++n) {
      msd[n] += (along[n] + up[n]) / 5;
      msr[n] += turned[n] / 5;
    }
  }
  for (std::size_t l = 0; l < found.lag.size(); ++l) {
    EXPECT_NEAR(found.groups[0].translation.value[l], msd[l + 1], 1e-12 * msd.back());
    EXPECT_NEAR(found.groups[0].rotation.value[l], msr[l + 1], 1e-12 * msr.back());
  }
}

}  // namespace
}  // namespace vitrel

#include "analysis/structure/frame_average.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/statistics/blocking.h"
#include "core/random/stream.h"
#include "core/special_values.h"
#include "tests/support/coverage.h"

namespace vitrel {
namespace {

TEST(FrameAverage, WithoutWeightsIsBlocking) {
  Stream draw(1, Purpose::tests);
  FrameAverage average;
  std::vector<double> series;
  for (int k = 0; k < 200; ++k) {
    series.push_back(3 + draw.normal());
    average.add(std::vector{series.back(), 7.0});
  }
  const Averages result = average.averages(true);
  const Estimate wanted = block_average(series);
  EXPECT_NEAR(result.mean[0], wanted.mean, 1e-14);
  EXPECT_NEAR(result.error[0], wanted.error, 1e-14);
  EXPECT_EQ(result.mean[1], 7);
  EXPECT_EQ(result.error[1], 0);
  EXPECT_TRUE(std::isnan(average.averages(false).error[0]));
  EXPECT_EQ(average.averages(false).mean[0], result.mean[0]);
}

TEST(FrameAverage, GivesNoWeightToWhatIsMissing) {
  FrameAverage average;
  average.add(std::vector{1.0, unknown}, std::vector{2.0, 5.0});
  average.add(std::vector{4.0}, std::vector{1.0});
  average.add(std::vector{unknown, 6.0, unknown}, std::vector{0.0, 1.0, 0.0});
  const Averages result = average.averages(true);
  ASSERT_EQ(result.mean.size(), 3u);
  EXPECT_EQ(result.mean[0], 2);  // (2·1 + 1·4)/3
  EXPECT_EQ(result.mean[1], 6);
  EXPECT_TRUE(std::isnan(result.mean[2]));
}

// A ratio whose denominators scatter as much as the numerators: x = 2 + e/√w around the truth 2. In 600
// series the error covers it in 68.27 %, within four binomial standard deviations.
TEST(FrameAverage, HasErrorsThatCoverTheTruth) {
  Coverage coverage;
  for (std::uint64_t trial = 0; trial < 600; ++trial) {
    Stream draw(2, Purpose::tests, trial);
    FrameAverage average;
    for (int k = 0; k < 256; ++k) {
      const double weight = draw.uniform(0.2, 3);
      average.add(std::vector{2 + draw.normal() / std::sqrt(weight)}, std::vector{weight});
    }
    const Averages result = average.averages(true);
    coverage.count(result.mean[0] - 2, result.error[0]);
  }
  expect_binomial(coverage.one, 600, 0.6827, 4);
}

}  // namespace
}  // namespace vitrel

#include "analysis/dynamics/time_axis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/trajectory.h"
#include "tests/support/even_steps.h"

namespace vitrel {
namespace {

using Times = std::vector<double>;

/// As a program writes them that keeps single precision.
Times rounded(Times times) {
  for (double& time : times) time = static_cast<float>(time);
  return times;
}

/// Frames 0, 1, 2, 4 and 8 units after the start of each cycle of 10.
Times cycles(std::size_t count, double unit, double start = 0) {
  Times times;
  for (std::size_t c = 0; c < count; ++c)
    for (const double k : {0, 1, 2, 4, 8})
      times.push_back(start + unit * (10 * static_cast<double>(c) + k));
  return times;
}

/// How many pairs of frames are that many units apart, by looking at all.
std::size_t pairs_apart(const Times& times, double unit, long units) {
  std::size_t count = 0;
  for (const double from : times)
    for (const double to : times) count += std::lround((to - from) / unit) == units;
  return count;
}

TEST(TimeAxis, RoundingToSinglePrecisionLeavesTimesEven) {
  for (const double start : {0.0, -300.0, 1000.0}) {
    const Times exact = even_steps(start, 0.1, 5001);
    const std::vector<Lag> lags = time_axis(rounded(exact));
    const std::vector<Lag> expected = time_axis(exact);
    ASSERT_EQ(lags.size(), expected.size()) << start;
    for (std::size_t k = 0; k < lags.size(); ++k) {
      EXPECT_EQ(lags[k].origins, expected[k].origins);
      // Only the ends of the run carry rounding.
      EXPECT_NEAR(lags[k].time, 0.1 * static_cast<double>(lags[k].frames), 3e-7 * lags[k].time);
    }
  }
}

TEST(TimeAxis, TimesThatAreOffByMoreThanRoundingAreNotEven) {
  Times times = even_steps(0, 0.1, 1001);
  times[500] += 0.9 * 100 * 0x1p-23;
  EXPECT_TRUE(evenly_spaced(times));
  times[500] += 0.3 * 100 * 0x1p-23;
  EXPECT_FALSE(evenly_spaced(times));
  times = even_steps(0, 0.1, 1001);
  times.erase(times.begin() + 500);
  EXPECT_FALSE(evenly_spaced(times));
  // So late that single precision could not tell the frames apart.
  EXPECT_FALSE(evenly_spaced(Times{1e9, 1e9 + 1, 1e9 + 2, 1e9 + 4}));
}

// Also where rounding scatters equal differences, by up to 0.06 % of the shortest: 2⁻²⁴ of both times.
TEST(TimeAxis, CyclesHaveAllPairsOfEqualDifferenceAsOrigins) {
  for (const double start : {0.0, 50.0}) {
    const Times times = rounded(cycles(40, 0.01, start));
    ASSERT_FALSE(evenly_spaced(times));
    const std::vector<Lag> lags = time_axis(times);
    Times units;
    for (const Lag& lag : lags) {
      units.push_back(std::round(lag.time / 0.01));
      EXPECT_NEAR(lag.time, 0.01 * units.back(), 0x1p-22 * times.back());
      EXPECT_EQ(lag.origins, pairs_apart(times, 0.01, std::lround(units.back()))) << units.back();
      ASSERT_EQ(lag.pairs.size(), lag.origins);
      for (std::size_t k = 0; k < lag.origins; ++k) {
        EXPECT_NEAR(times[lag.to(k)] - times[lag.from(k)], lag.time, 0x1p-22 * times.back());
        EXPECT_TRUE(k == 0 || lag.from(k) > lag.from(k - 1)) << "by time of origin";
      }
    }
    EXPECT_TRUE(std::ranges::is_sorted(units, std::less_equal<>()));
    // All that there are: 5, 15, 25 … are of no pair of 0, 1, 2, 4, 8 modulo 10.
    EXPECT_EQ(Times(units.begin(), units.begin() + 13),
              (Times{1, 2, 3, 4, 6, 7, 8, 9, 10, 11, 12, 13, 14}));
    EXPECT_GE(units.back(), 398 / std::pow(10, 1 / 50.0)) << "within a step of the end";
  }
}

// The first frame of a part of a run need not be that of a cycle.
TEST(TimeAxis, CyclesMayBeginAnywhere) {
  Times times = cycles(40, 1);
  times.erase(times.begin(), times.begin() + 4);
  const std::vector<Lag> lags = time_axis(times);
  ASSERT_GE(lags.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_EQ(lags[k].origins, pairs_apart(times, 1, std::lround(lags[k].time)));
  EXPECT_EQ(lags[0].time, 1);
  EXPECT_EQ(lags[0].origins, 78u);
}

// 0.01 · 10^(k/20), as the program writes them: no two differences are equal but by chance.
TEST(TimeAxis, ASingleLogarithmicSeriesHasTheLagsFromItsStart) {
  Times times{0};
  for (int k = 0; k <= 80; ++k) times.push_back(0.01 * std::pow(10.0, k / 20.0));
  const std::vector<Lag> lags = time_axis(times);
  ASSERT_EQ(lags.size(), 81u);
  for (std::size_t k = 0; k < lags.size(); ++k) {
    EXPECT_NEAR(lags[k].time, times[k + 1], 1e-6 * times[k + 1]);
    EXPECT_EQ(lags[k].origins, 1u);
    EXPECT_EQ(lags[k].from(0), 0u);
    EXPECT_EQ(lags[k].shortest_block(), 1);
  }
}

// t = 0, 1, 2, 4, 8 …: 2^k from the start and from 2^k, and no other pairs.
TEST(TimeAxis, PowersOfTwoHaveTwoOrigins) {
  const std::vector<Lag> lags = time_axis(Times{0, 1, 2, 4, 8, 16});
  ASSERT_EQ(lags.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(lags[k].time, std::pow(2, k));
    EXPECT_EQ(lags[k].origins, k < 4 ? 2u : 1u);
    EXPECT_EQ(lags[k].shortest_block(), 1) << "one ends where the other begins";
  }
}

TEST(TimeAxis, TheFirstFrameMayBeTheOnlyOrigin) {
  const TimeAxisOptions options{.longest_lag = 1, .only_first_origin = true};
  const Times uneven = cycles(20, 1);
  for (const Times& times : {even_steps(0, 0.1, 300), uneven}) {
    const std::vector<Lag> lags = time_axis(times, options);
    EXPECT_GT(lags.size(), 40u);
    for (const Lag& lag : lags) {
      EXPECT_EQ(lag.origins, 1u);
      EXPECT_EQ(lag.from(0), 0u);
      EXPECT_NEAR(lag.time, times[lag.to(0)] - times[0], 1e-6 * lag.time);
    }
    EXPECT_NEAR(lags.back().time, times.back() - times.front(), 0.05 * times.back());
  }
}

TEST(TimeAxis, BlocksOfUnevenOriginsLastForFourLags) {
  const Times times = cycles(200, 1);
  std::size_t shared = 0;
  for (const Lag& lag : time_axis(times)) {
    const auto block = static_cast<std::size_t>(lag.shortest_block());
    double closest = times.back();
    for (std::size_t k = 0; k + 1 < lag.origins; ++k)
      closest = std::min(closest, times[lag.from(k + 1)] - times[lag.from(k)]);
    if (closest >= lag.time) {
      EXPECT_EQ(block, 1u) << lag.time;
      continue;
    }
    ++shared;
    for (std::size_t k = 0; k + block < lag.origins; ++k)
      EXPECT_GE(times[lag.from(k + block)] - times[lag.from(k)], 4 * lag.time);
  }
  EXPECT_GT(shared, 10u);
}

TEST(TimeAxis, ManyUnevenFramesGiveLagsAndOriginsWithinTheOptions) {
  const Times times = cycles(20'000, 0.5);
  const std::vector<Lag> lags = time_axis(times, {.lags_per_decade = 10, .max_origins = 1000});
  EXPECT_LE(lags.size(), 55u);  // five decades and a third
  EXPECT_GE(lags.size(), 45u);
  for (const Lag& lag : lags) {
    EXPECT_LE(lag.origins, 1000u);
    // Those up to half the run have more than 2000 to be thinned.
    if (lag.time < 50'000) {
      EXPECT_GE(lag.origins, 500u) << lag.time;
    }
  }
  EXPECT_EQ(lags.front().time, 0.5);
}

/// Particles whose box crossings are in doubt at some frames.
class DoubtfulTrajectory : public Trajectory2 {
 public:
  DoubtfulTrajectory(Times times, std::vector<std::size_t> frames)
      : times_(std::move(times)), frames_(std::move(frames)) {}
  const std::vector<double>& times() const override { return times_; }
  const Configuration2& read(std::size_t) override { return frame_; }
  std::vector<std::size_t> doubtful_frames() const override { return frames_; }

 private:
  Times times_;
  std::vector<std::size_t> frames_;
  Configuration2 frame_;
};

// Frames 0, 1, 2, 4 and 8 of every cycle of 10: the way from 4 to 8 is in doubt in all of them.
TEST(TimeAxis, AnIntervalInDoubtTakesOnlyTheLagsThatSpanIt) {
  std::vector<std::size_t> doubtful;
  for (std::size_t c = 0; c < 40; ++c) doubtful.push_back(5 * c + 4);
  DoubtfulTrajectory trajectory(cycles(40, 1), doubtful);
  const std::vector<Lag> lags = time_axis_of_motion(trajectory);
  std::vector<double> units;
  for (const Lag& lag : lags) {
    units.push_back(lag.time);
    EXPECT_EQ(lag.origins, lag.pairs.size());
    for (const FramePair& pair : lag.pairs) EXPECT_EQ((pair.from + 1) / 5, (pair.to + 1) / 5);
  }
  // From 8 of a cycle to 4 of the next it is 6.
  EXPECT_EQ(units, (Times{1, 2, 3, 4, 6}));
  TrajectoryPart<2> part(trajectory, 4, 9);
  EXPECT_EQ(part.doubtful_frames(), (std::vector<std::size_t>{}));
  EXPECT_EQ(TrajectoryPart<2>(trajectory, 3, 9).doubtful_frames(), (std::vector<std::size_t>{1}));
  DoubtfulTrajectory all({0, 1, 2, 4}, {1, 2, 3});
  EXPECT_TRUE(time_axis_of_motion(all).empty());
  DoubtfulTrajectory even(even_steps(0, 1, 20), {7});
  EXPECT_EQ(time_axis_of_motion(even).size(), time_axis(even.times()).size());
}

// From 1 to 1000 steps nine factors of 10^(1/3); the next longer lag there is is taken, which above 100 steps may be
// farther by one of 50 per decade. All lags have the origins 0, 16, 32 …
TEST(TimeAxis, FewLagsAreLogarithmicallySpacedAndShareOrigins) {
  DoubtfulTrajectory run(even_steps(0, 1, 2001), {});
  const std::vector<Lag> lags = few_lags_of_motion(run, {});
  ASSERT_EQ(lags.size(), 10u);
  for (std::size_t k = 0; k < 10; ++k) {
    const double steps = static_cast<double>(lags[k].frames);
    const double wanted = std::pow(lags.back().time, static_cast<double>(k) / 9);
    EXPECT_GE(steps, wanted * (1 - 1e-9));
    EXPECT_LE(steps, std::max(wanted + 1, 1.05 * wanted));
    EXPECT_EQ(lags[k].stride, 16u);  // 2001/128, rounded up
    EXPECT_EQ(lags[k].origins, (2000 - lags[k].frames) / 16 + 1);
    EXPECT_LT(lags[k].to(lags[k].origins - 1), 2001u);
  }
  DoubtfulTrajectory listed(cycles(40, 1), {});
  const std::vector<Lag> few = few_lags_of_motion(listed, {});
  EXPECT_LE(few.size(), 10u);
  EXPECT_EQ(few.front().time, 1);
  EXPECT_EQ(few.back().time, time_axis(listed.times()).back().time);
  for (const Lag& lag : few) EXPECT_LE(lag.pairs.size(), 128u);
  EXPECT_EQ(few_lags_of_motion(DoubtfulTrajectory({0, 1}, {}), {}).size(), 1u);
}

TEST(TimeAxis, NeedsTwoFrames) {
  EXPECT_TRUE(time_axis(Times{}).empty());
  EXPECT_TRUE(time_axis(Times{3}).empty());
  ASSERT_EQ(time_axis(Times{3, 5}).size(), 1u);
  EXPECT_EQ(time_axis(Times{3, 5})[0].time, 2);
}

}  // namespace
}  // namespace vitrel

#include "analysis/dynamics/displacement.h"

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "core/error.h"
#include "tests/support/coverage.h"
#include "tests/support/frames.h"
#include "tests/support/free_brownian.h"

namespace vitrel {
namespace {

using std::numbers::pi;

constexpr double overlap_distance = 0.3;

/// What of one result has a closed form: value, error and truth.
struct Judged {
  std::string name;
  const Correlation* found;
  double truth;
};

/// Displacements per axis are normal with variance v = MSD/2, rotations with w = MSR:
/// ⟨r⁴⟩ = 2 MSD² in the plane, ⟨θ⁴⟩ = 3 MSR², F_s = exp(−q² v/2), L_n = exp(−n² w/2), and the share p
/// within a is 1 − exp(−a²/2v). Particles are independent: χ_4 = p(1 − p), whatever N.
std::vector<Judged> judged(const Displacements& result, double time, double inertia) {
  const DisplacementGroup& all = result.groups[0];
  const double msd = free_msd(time), msr = free_msr(time, inertia);
  const double p = 1 - std::exp(-overlap_distance * overlap_distance / msd);
  std::vector<Judged> list = {{"msd", &all.translation, msd},
                              {"parallel", &all.parallel, msd / 2},
                              {"perpendicular", &all.perpendicular, msd / 2},
                              {"quartic", &all.quartic, 2 * msd * msd},
                              {"alpha", &all.non_gaussian, 0},
                              {"msr", &all.rotation, msr},
                              {"quartic rotation", &all.quartic_rotation, 3 * msr * msr},
                              {"alpha of rotation", &all.non_gaussian_rotation, 0},
                              {"overlap", &result.overlap, p},
                              {"chi_4", &result.susceptibility, p * (1 - p)}};
  for (std::size_t j = 0; j < result.wave_numbers.size(); ++j) {
    const double q = result.wave_numbers[j];
    list.push_back(
        {fmt::format("F_s({})", q), &all.self_scattering.at(j), std::exp(-q * q * msd / 4)});
  }
  for (std::size_t j = 0; j < result.orders.size(); ++j) {
    const double n = result.orders[j];
    list.push_back({fmt::format("L_{}", n), &all.orientation.at(j), std::exp(-n * n * msr / 2)});
  }
  return list;
}

DisplacementOptions two_wave_numbers() {
  return {.wave_numbers = {2, 4}, .overlap_distance = overlap_distance};
}

// Five standard errors from 16 blocks or more: false-alarm rate 0.16 per mille by Student's distribution, for each of
// 84 points.
TEST(Displacement, FreeBrownianParticlesFollowTheClosedForms) {
  const Configuration2 start = ellipses(100);
  MemoryTrajectory2 trajectory = free_brownian(start, 801, 1);
  const Displacements result = displacements(trajectory, two_wave_numbers());
  ASSERT_EQ(result.groups.size(), 1u);
  EXPECT_EQ(result.groups[0].rotors, 100u);
  for (const std::size_t k : {0u, 1u, 4u, 19u, 99u, 115u})
    for (const Judged& judge : judged(result, result.lag.at(k), start.inertia(0))) {
      const double error = judge.found->error.at(k);
      if (judge.name == "chi_4" && k > 19) {
        EXPECT_TRUE(std::isnan(judge.found->value.at(k))) << "fewer than eight blocks";
        continue;
      }
      EXPECT_GT(error, 0) << judge.name;
      EXPECT_NEAR(judge.found->value.at(k), judge.truth, 5 * error)
          << judge.name << " at " << result.lag[k];
    }
  EXPECT_LT(result.groups[0].translation.error[19], 0.1 * free_msd(2));
  EXPECT_LE(result.lag.back(), 40 + 1e-9);
  EXPECT_GT(result.lag.back(), 37);
}

/// Every `step`-th frame of a run, with angles that are known up to whole turns.
class UncountedTurns : public MemoryTrajectory2 {
 public:
  UncountedTurns(Trajectory2& counted, std::size_t step)
      : MemoryTrajectory2(folded(counted, step)) {}
  double turn_period() const override { return 2 * pi; }

 private:
  static std::vector<Configuration2> folded(Trajectory2& counted, std::size_t step) {
    std::vector<Configuration2> frames;
    for (std::size_t k = 0; k < counted.frames(); k += step) {
      frames.push_back(counted.read(k));
      for (double& angle : frames.back().angle) angle = std::remainder(angle, 2 * pi);
    }
    return frames;
  }
};

// Turns from frame to frame are short, and then they are not.
TEST(Displacement, UncountedTurnsAreTheShortestOrUnknown) {
  MemoryTrajectory2 counted = free_brownian(ellipses(20), 401, 5);
  UncountedTurns all(counted, 1), few(counted, 100);
  const DisplacementGroup right = displacements(counted).groups[0];
  const DisplacementGroup found = displacements(all).groups[0];
  ASSERT_EQ(found.rotation.value.size(), right.rotation.value.size());
  EXPECT_GT(right.rotation.value.back(), 1);
  for (std::size_t l = 0; l < right.rotation.value.size(); ++l)
    EXPECT_NEAR(found.rotation.value[l], right.rotation.value[l], 1e-12 * right.rotation.value[l]);
  const Displacements unknown = displacements(few);
  EXPECT_FALSE(unknown.unknown_turns.empty());
  EXPECT_TRUE(unknown.groups[0].rotation.value.empty());
  EXPECT_FALSE(unknown.groups[0].orientation[0].value.empty());
}

/// The coverage of many runs, and how many of their errors are from blocks.
struct RunCoverage : Coverage {
  int blocked = 0;

  void count(double deviation, double error, std::size_t blocks) {
    Coverage::count(deviation, error);
    blocked += !std::isnan(error) && blocks > 0;
  }
  void expect_covers() const {
    EXPECT_GE(known, 99);
    EXPECT_NEAR(100.0 * one / known, 68.27, 3.5 * 4.65);
    EXPECT_NEAR(100.0 * two / known, 95, 3.5 * 2.2);
  }
};

/// The lag next to so many steps.
std::size_t lag_of(const Displacements& result, double steps) {
  const auto closer = [&](double a, double b) {
    return std::abs(a - steps * brownian_step) < std::abs(b - steps * brownian_step);
  };
  const auto at = std::min_element(result.lag.begin(), result.lag.end(), closer);
  return static_cast<std::size_t>(at - result.lag.begin());
}

using CoverageTable = std::map<std::pair<std::string, int>, RunCoverage>;

using Sampling = std::function<MemoryTrajectory2(MemoryTrajectory2&)>;

/// The coverage for runs of so many steps, or for those of their frames that are sampled.
CoverageTable coverage_of_free_runs(std::size_t length, const std::vector<int>& steps,
                                    const Sampling& sampled = {}) {
  constexpr int seeds = 100;
  CoverageTable coverage;
  const Configuration2 start = ellipses(60);
  DisplacementOptions options = two_wave_numbers();
  options.axis.every_lag_up_to = 1;
  options.axis.lags_per_decade = 10;
  for (int seed = 0; seed < seeds; ++seed) {
    MemoryTrajectory2 trajectory = free_brownian(start, length + 1, 100 + seed);
    if (sampled) trajectory = sampled(trajectory);
    const Displacements result = displacements(trajectory, options);
    for (const int n : steps) {
      const std::size_t k = lag_of(result, n);
      for (const Judged& judge : judged(result, result.lag[k], start.inertia(0)))
        coverage[{judge.name, n}].count(judge.found->value[k] - judge.truth, judge.found->error[k],
                                        judge.found->blocks[k]);
    }
  }
  return coverage;
}

/// Sums over pairs of frames, one after another, of means over the particles.
struct SlowSums {
  double origins = 0, msd = 0, msr = 0, parallel = 0, scattering = 0, l_4 = 0;

  void add(const Configuration2& then, const Configuration2& now) {
    const auto n = static_cast<double>(now.size());
    ++origins;
    for (std::size_t i = 0; i < now.size(); ++i) {
      const Vec2 moved = now.unwrapped(i) - then.unwrapped(i);
      const Vec2 axis(std::cos(then.angle[i]), std::sin(then.angle[i]));
      const double turned = now.angle[i] - then.angle[i];
      msd += moved.squaredNorm() / n;
      msr += turned * turned / n;
      parallel += std::pow(moved.dot(axis), 2) / n;
      scattering += ::j0(4 * moved.norm()) / n;
      l_4 += std::cos(4 * turned) / n;
    }
  }
};

/// At the l-th time difference, with 4 as the second wave number.
void expect_slow_sums(const Displacements& found, std::size_t l, const SlowSums& slow) {
  const DisplacementGroup& all = found.groups[0];
  const double origins = slow.origins;
  const double length = 1e-12 * std::min(slow.msd, all.translation.value.back());
  const double angle = 1e-12 * std::min(slow.msr, all.rotation.value.back());
  ASSERT_EQ(static_cast<double>(found.origins[l]), origins) << found.lag[l];
  EXPECT_NEAR(all.translation.value[l], slow.msd / origins, length);
  EXPECT_NEAR(all.rotation.value[l], slow.msr / origins, angle);
  EXPECT_NEAR(all.parallel.value[l], slow.parallel / origins, length);
  EXPECT_NEAR(all.self_scattering[1].value[l], slow.scattering / origins, 1e-9);
  EXPECT_NEAR(all.orientation[1].value[l], slow.l_4 / origins, 1e-12);
}

// All pairs of frames that many steps apart.
TEST(Displacement, UnevenTimesAreAveragedOverAllPairsOfEqualDifference) {
  MemoryTrajectory2 steps = free_brownian(ellipses(20), 161, 8);
  MemoryTrajectory2 trajectory = cycles(steps);
  const Displacements result = displacements(trajectory, two_wave_numbers());
  ASSERT_GT(result.lag.size(), 20u);
  for (std::size_t l = 0; l < result.lag.size(); ++l) {
    SlowSums slow;
    for (std::size_t k = 0; k < trajectory.frames(); ++k)
      for (std::size_t m = k + 1; m < trajectory.frames(); ++m) {
        const Configuration2 &then = trajectory.read(k), &now = trajectory.read(m);
        if (std::lround((now.time - then.time) / brownian_step) ==
            std::lround(result.lag[l] / brownian_step))
          slow.add(then, now);
      }
    expect_slow_sums(result, l, slow);
  }
}

// Thinned origins are every so many frames, which lie apart in the path; without thinning all
// frames are origins.
TEST(Displacement, EqualsTheSlowSumsAtEveryLag) {
  struct Run {
    std::size_t particles, frames, seed, max_origins, stride;
  };
  for (const Run& run : {Run{5, 400, 1, 400, 1}, Run{3, 100, 2, 15, 7}}) {
    MemoryTrajectory2 trajectory = free_brownian(ellipses(run.particles), run.frames, run.seed);
    DisplacementOptions options = two_wave_numbers();
    options.axis = {.every_lag_up_to = run.frames, .max_origins = run.max_origins};
    const Displacements found = displacements(trajectory, options);
    for (std::size_t l = 0; l < found.lag.size(); ++l) {
      SlowSums slow;
      const auto lag = static_cast<std::size_t>(std::lround(found.lag[l] / found.lag[0]));
      for (std::size_t k = 0; k + lag < run.frames; k += run.stride)
        slow.add(trajectory.read(k), trajectory.read(k + lag));
      expect_slow_sums(found, l, slow);
    }
  }
}

// 100 runs. Counts stay within 3.5 binomial standard deviations (4.65 for one error, 2.2 for two) of
// 68.27 and 95: false-alarm rate 0.05 % for each of 108, 5 % for all. Lags up to 10 steps have errors
// by blocking, longer ones by particles, but for correlations that decay, which have blocks of their own memory.
TEST(Displacement, ErrorBarsCoverTheClosedForms) {
  for (const auto& [what, counts] : coverage_of_free_runs(1000, {1, 5, 10, 100})) {
    SCOPED_TRACE(fmt::format("{} at {}", what.first, what.second));
    const bool by_blocks = what.second <= 10;
    if (what.first == "chi_4" && !by_blocks) {
      EXPECT_EQ(counts.known, 0);
      continue;
    }
    counts.expect_covers();
    const bool decays = what.first.starts_with("F_s") || what.first.starts_with("L_");
    EXPECT_EQ(counts.blocked > 50, by_blocks || decays);
  }
}

// The same of cycles. Origins of lags of 1 and 5 steps share nothing, of 20 steps twenty of them begin within
// four lags.
TEST(Displacement, ErrorBarsOfUnevenOriginsCoverTheClosedForms) {
  for (const auto& [what, counts] : coverage_of_free_runs(2400, {1, 5, 20}, cycles)) {
    SCOPED_TRACE(fmt::format("{} at {}", what.first, what.second));
    counts.expect_covers();
    EXPECT_GT(counts.blocked, 50);
  }
}

/// Frames of a free flight, one interval apart.
MemoryTrajectory2 flight(const Configuration2& start, std::size_t frames, double interval) {
  return trajectory_of(frames, start, [&](Configuration2& c, std::size_t k) {
    if (k > 0) fly(c, interval);
  });
}

// r = v t and θ = ω t: every origin gives the same square, through any number of box crossings.
TEST(Displacement, BallisticMotionIsExactAndWrappingImmaterial) {
  Configuration2 configuration = ellipses(3);
  configuration.velocity = {Vec2(1, 2), Vec2(-3, 0.5), Vec2(0, 0)};
  configuration.angular_velocity = {2, -7, 0.5};
  MemoryTrajectory2 trajectory = flight(configuration, 61, 0.25);
  ASSERT_NE(trajectory.read(60).image[1], Shift<2>(Shift<2>::Zero()));
  const Displacements result = displacements(trajectory);
  ASSERT_EQ(result.lag.size(), 30u);
  const double v2 = (5 + 9.25) / 3, w2 = (4 + 49 + 0.25) / 3;
  for (std::size_t k = 0; k < result.lag.size(); ++k) {
    const double t = result.lag[k];
    EXPECT_DOUBLE_EQ(t, 0.25 * static_cast<double>(k + 1));
    EXPECT_EQ(result.origins[k], 60 - k);
    EXPECT_NEAR(result.groups[0].translation.value[k], v2 * t * t, 1e-12 * v2 * t * t);
    EXPECT_NEAR(result.groups[0].rotation.value[k], w2 * t * t, 1e-12 * w2 * t * t);
  }
}

TEST(Displacement, LogarithmicTimesUseAllPairsOfEqualDifference) {
  Configuration2 configuration = ellipses(4);
  for (int i = 0; i < 4; ++i) configuration.velocity[i] = Vec2(1 + i, 0);
  MemoryTrajectory2 trajectory =
      trajectory_of(8, configuration, [](Configuration2& c, std::size_t k) {
        if (k > 0) fly(c, std::max(0.125, c.time));
      });
  const Displacements result = displacements(trajectory);
  ASSERT_EQ(result.lag.size(), 7u);
  // Squares t² {1, 4, 9, 16}: mean 7.5 t², variance 43 t⁴, and four particles behind the error.
  for (std::size_t k = 0; k < 7; ++k) {
    const double t = result.lag[k];
    EXPECT_DOUBLE_EQ(t, 0.125 * std::pow(2, k));
    EXPECT_EQ(result.origins[k], k < 6 ? 2u : 1u) << "from 0 to t, and from t to 2 t";
    EXPECT_NEAR(result.groups[0].translation.value[k], 7.5 * t * t, 1e-12 * t * t);
    EXPECT_NEAR(result.groups[0].translation.error[k], std::sqrt(43.0 / 4) * 1.1967592 * t * t,
                1e-6 * t * t);
  }
}

TEST(Displacement, SpeciesApartAndRoundParticlesDoNotTurn) {
  Configuration2 configuration = ellipses(3);
  configuration.species_names = {"ellipse", "disk", "absent"};
  configuration.shape[2] = {1.4, 1.4};
  configuration.species = {0, 0, 1};
  configuration.velocity = {Vec2(1, 0), Vec2(2, 0), Vec2(3, 0)};
  configuration.angular_velocity = {1, 2, 100};
  MemoryTrajectory2 trajectory = flight(configuration, 5, 1);
  const std::vector<DisplacementGroup> groups = displacements(trajectory).groups;
  ASSERT_EQ(groups.size(), 3u);
  const std::pair<const char*, double> expected[] = {
      {"all", 14.0 / 3}, {"ellipse", 2.5}, {"disk", 9}};
  for (std::size_t g = 0; g < 3; ++g) {
    EXPECT_EQ(groups[g].name, expected[g].first);
    EXPECT_NEAR(groups[g].translation.value[0], expected[g].second, 1e-13);
  }
  for (const std::size_t g : {0, 1}) EXPECT_NEAR(groups[g].rotation.value[0], 2.5, 1e-13);
  EXPECT_EQ(groups[0].rotors, 2u);
  EXPECT_TRUE(groups[2].rotation.value.empty());
}

// Every sum is over the same numbers in the same order.
TEST(Displacement, ResultDependsNeitherOnThreadsNorOnTheMemoryGranted) {
  MemoryTrajectory2 trajectory = free_brownian(ellipses(40), 300, 5);
  const Displacements one = displacements(trajectory, {.threads = 1});
  for (const DisplacementOptions& options : {DisplacementOptions{.threads = 2}, {.memory = 1}}) {
    const Displacements other = displacements(trajectory, options);
    EXPECT_EQ(one.groups[0].translation.value, other.groups[0].translation.value);
    EXPECT_EQ(one.groups[0].translation.error, other.groups[0].translation.error);
    EXPECT_EQ(one.groups[0].rotation.value, other.groups[0].rotation.value);
    const auto judge_one = judged(one, 1, 1), judge_other = judged(other, 1, 1);
    for (std::size_t j = 0; j < judge_one.size(); ++j) {
      EXPECT_EQ(judge_one[j].found->value[0], judge_other[j].found->value[0]) << judge_one[j].name;
      EXPECT_EQ(judge_one[j].found->error[0], judge_other[j].found->error[0]) << judge_one[j].name;
    }
  }
}

// A particle that flies along its long axis, and one that flies across while it makes a quarter turn: the
// long axis is that at the origin of time.
TEST(Displacement, PartsAlongAndAcrossTheLongAxisAtTheOriginOfTime) {
  Configuration2 configuration = ellipses(2);
  configuration.angle = {0.7, 1.1};
  configuration.velocity = {Vec2(3 * std::cos(0.7), 3 * std::sin(0.7)),
                            Vec2(-2 * std::sin(1.1), 2 * std::cos(1.1))};
  configuration.angular_velocity = {0, pi};
  MemoryTrajectory2 trajectory = flight(configuration, 2, 0.5);
  const DisplacementGroup all = displacements(trajectory).groups[0];
  EXPECT_NEAR(all.parallel.value[0], 0.5 * 2.25, 1e-13);
  EXPECT_NEAR(all.perpendicular.value[0], 0.5 * 1, 1e-13);
  EXPECT_NEAR(all.quartic.value[0], 0.5 * (2.25 * 2.25 + 1), 1e-13);
  EXPECT_NEAR(all.quartic_rotation.value[0], 0.5 * std::pow(pi / 2, 4), 1e-12);
  EXPECT_NEAR(all.orientation[0].value[0], 0.5 * (1 - 1), 1e-13);
}

// Half of the time all particles jump by 1 in every step, half of the time none does: Q of one step is
// 0 or 1 for all at once, ⟨Q⟩ = 1/2 and χ_4 = N/4. Moves are drawn anew for every step, the same for
// all: blocking sees N particles as one. Two standard errors; that of an error from 31 blocks, 1/√60, is taken three
// times.
TEST(Displacement, SusceptibilityCountsParticlesThatMoveTogether) {
  Stream draw(7, Purpose::tests);
  MemoryTrajectory2 trajectory =
      trajectory_of(2000, ellipses(50), [&](Configuration2& c, std::size_t k) {
        if (k == 0) return;
        c.velocity.assign(50, Vec2(draw.uniform() < 0.5 ? 1 : 0, 0));
        fly(c, 1);
      });
  const Displacements result = displacements(trajectory);
  EXPECT_NEAR(result.overlap.value[0], 0.5, 2 * result.overlap.error[0]);
  EXPECT_NEAR(result.overlap.error[0], 0.5 / std::sqrt(2000), 0.39 * 0.5 / std::sqrt(2000));
  EXPECT_NEAR(result.susceptibility.value[0], 12.5, 0.02);
}

// 4π/(√3 s) with the spacing s = √(2/(√3 ρ)) of the triangular lattice.
TEST(Displacement, MainWaveNumberIsThatOfTheTriangularLattice) {
  const double spacing = std::sqrt(2 / (std::sqrt(3.0) * 70 / 35));
  EXPECT_NEAR(main_wave_number(ellipses(70)), 4 * pi / (std::sqrt(3.0) * spacing), 1e-13);
  MemoryTrajectory2 trajectory = free_brownian(ellipses(70), 3, 6);
  EXPECT_EQ(displacements(trajectory).wave_numbers,
            std::vector<double>{main_wave_number(ellipses(70))});
}

TEST(Displacement, OriginsAreThinnedEvenlyAndLongLagsLogarithmically) {
  MemoryTrajectory2 trajectory = free_brownian(ellipses(1), 2001, 4);
  const Displacements result = displacements(
      trajectory, {.axis = {.every_lag_up_to = 10, .lags_per_decade = 5, .max_origins = 100}});
  // Every 21st frame is an origin, of lags that do not end beyond the run.
  EXPECT_EQ(result.origins.front(), 96u);
  EXPECT_EQ(result.origins.back(),
            (2000 - std::lround(result.lag.back() / result.lag.front())) / 21 + 1);
  // 10 single steps, then two decades (10 … 1000) of five, the last one met up to rounding.
  EXPECT_GE(result.lag.size(), 19u);
  EXPECT_LE(result.lag.size(), 20u);
}

// As of a run that consists of these frames only.
TEST(Displacement, HalvesAreThoseOfTheirFrames) {
  MemoryTrajectory2 trajectory = free_brownian(ellipses(5), 401, 4);
  const Displacements whole = displacements(trajectory);
  ASSERT_EQ(whole.halves.size(), 2u);
  for (const std::size_t begin : {0, 200}) {
    TrajectoryPart<2> part(trajectory, begin, begin == 0 ? 200 : 401);
    const Displacements right = displacements(part);
    const HalfOfRun& half = whole.halves[begin / 200];
    const DisplacementGroup& group = right.groups.front();
    ASSERT_EQ(half.lag.size(), right.lag.size());
    const auto expect_same = [&](const Correlation& found, const Correlation& other) {
      EXPECT_EQ(found.blocks, other.blocks);
      std::size_t with_error = 0;
      for (std::size_t k = 0; k < found.value.size(); ++k) {
        EXPECT_NEAR(found.value[k], other.value[k], 1e-12 * std::abs(other.value[k]) + 1e-14);
        if (found.blocks[k] == 0) continue;
        EXPECT_NEAR(found.error[k], other.error[k], 1e-9 * other.error[k]);
        ++with_error;
      }
      EXPECT_GT(with_error, 5u);
    };
    expect_same(half.translation, group.translation);
    expect_same(half.self_scattering.front(), group.self_scattering.front());
    expect_same(half.orientation.front(), group.orientation.front());
  }
}

// What is not asked for costs nothing, and changes nothing of the rest.
TEST(Displacement, PartsAreThoseOfTheWhole) {
  MemoryTrajectory2 trajectory = free_brownian(ellipses(3), 60, 2);
  const Displacements whole = displacements(trajectory);
  const Displacements part = displacements(
      trajectory, {.parts = {.displacement = false, .orientation = false, .overlap = false}});
  const DisplacementGroup &all = whole.groups[0], &some = part.groups[0];
  EXPECT_EQ(some.self_scattering[0].value, all.self_scattering[0].value);
  EXPECT_EQ(some.self_scattering[0].blocks, all.self_scattering[0].blocks);
  EXPECT_TRUE(some.translation.value.empty());
  EXPECT_TRUE(some.rotation.value.empty());
  EXPECT_TRUE(some.orientation.empty());
  EXPECT_TRUE(part.overlap.value.empty());
}

TEST(Displacement, OneFrameIsTheUsersMistake) {
  MemoryTrajectory2 trajectory({ellipses(1)});
  EXPECT_THROW(displacements(trajectory), UserError);
}

}  // namespace
}  // namespace vitrel

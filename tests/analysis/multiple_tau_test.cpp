#include "analysis/dynamics/multiple_tau.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <string_view>
#include <vector>

#include "analysis/dynamics/displacement.h"
#include "core/error.h"
#include "tests/support/coverage.h"
#include "tests/support/free_brownian.h"
#include "tests/support/scenes.h"
#include "tests/support/walking_solids.h"

namespace vitrel {
namespace {

constexpr double step = brownian_step;
const std::vector<double> wave_numbers{1, 4};

Configuration2 long_particles(std::size_t n) {
  Configuration2 c = ellipses(n);
  c.shape.assign(n, of_aspect_ratio(3));
  return c;
}

/// Particles of two species, A long and B round, in turn of two and one; they know nothing of each other.
Configuration2 mixture(std::size_t n) {
  Configuration2 c = long_particles(n);
  c.species_names = {"A", "B"};
  for (std::size_t i = 1; i < n; i += 3) {
    c.species[i] = 1;
    c.shape[i] = {1, 1};
  }
  return c;
}

template <int Dim>
void show(MultipleTau<Dim>& correlator, Trajectory<Dim>& trajectory, std::size_t begin,
          std::size_t end) {
  for (std::size_t k = begin; k < end; ++k)
    correlator.observe({static_cast<std::int64_t>(k), trajectory.read(k), {}});
}

template <int Dim>
MultipleTau<Dim> correlator_of(Trajectory<Dim>& trajectory, const MultipleTauOptions& options) {
  MultipleTau<Dim> correlator(trajectory.read(0), options);
  show(correlator, trajectory, 0, trajectory.frames());
  return correlator;
}

/// Lags up to half the run.
MultipleTauOptions half_of(const Trajectory2& trajectory) {
  const double duration = step * static_cast<double>(trajectory.frames() - 1);
  return {step, 0.5 * duration, wave_numbers};
}

/// The correlations of all particles.
CorrelatedGroup correlations(MemoryTrajectory2&& trajectory) {
  return correlator_of(trajectory, half_of(trajectory)).correlations().front();
}

const Column& column(const CorrelatedGroup& group, std::string_view name) {
  for (const Column& candidate : group.columns)
    if (candidate.name == name) return candidate;
  throw std::out_of_range(std::string(name));
}

using Pair = std::function<double(const Configuration2&, const Configuration2&, std::size_t)>;

double turn(const Configuration2& from, const Configuration2& to, std::size_t i) {
  return to.angle[i] - from.angle[i];
}
double distance(const Configuration2& from, const Configuration2& to, std::size_t i) {
  return (to.unwrapped(i) - from.unwrapped(i)).norm();
}

/// The definitions, one particle at a time.
const std::map<std::string, Pair> definitions{
    {"msd", [](auto& a, auto& b, auto i) { return std::pow(distance(a, b, i), 2); }},
    {"msr", [](auto& a, auto& b, auto i) { return std::pow(turn(a, b, i), 2); }},
    {"fs_1", [](auto& a, auto& b,
                auto i) { return std::cyl_bessel_j(0, wave_numbers[0] * distance(a, b, i)); }},
    {"fs_2", [](auto& a, auto& b,
                auto i) { return std::cyl_bessel_j(0, wave_numbers[1] * distance(a, b, i)); }},
    {"l_2", [](auto& a, auto& b, auto i) { return std::cos(2 * turn(a, b, i)); }},
    {"l_4", [](auto& a, auto& b, auto i) { return std::cos(4 * turn(a, b, i)); }}};

bool is_of_rotors(const std::string& name) {
  return name == "msr" || name.starts_with("l_");
}

/// One mean over the members for every origin: all frames that are a multiple of the stride.
std::vector<double> direct_series(MemoryTrajectory2& trajectory, const Lag& lag,
                                  const std::function<bool(std::size_t)>& is_member,
                                  const Pair& pair) {
  std::vector<double> series;
  for (std::size_t k = 0; k + lag.frames < trajectory.frames(); k += lag.stride) {
    const Configuration2 &from = trajectory.read(k), &to = trajectory.read(k + lag.frames);
    double total = 0, members = 0;
    for (std::size_t i = 0; i < from.size(); ++i)
      if (is_member(i)) total += pair(from, to, i), members += 1;
    series.push_back(total / members);
  }
  return series;
}

/// All lags by the rule of the header, from the stored frames.
std::vector<Lag> lags_of_the_rule(std::size_t frames) {
  std::vector<Lag> lags;
  const std::size_t longest = (frames - 1) / 2;
  for (std::size_t stride = 1; stride <= longest; stride *= 2)
    for (std::size_t j = stride == 1 ? 1 : 4; j < 8; ++j)
      if (j * stride <= longest)
        lags.push_back({j * stride, stride, (frames - 1 - j * stride) / stride + 1});
  return lags;
}

void expect_direct(const CorrelatedGroup& group, MemoryTrajectory2& trajectory,
                   const std::function<bool(std::size_t)>& is_member) {
  const std::vector<Lag> lags = lags_of_the_rule(trajectory.frames());
  ASSERT_EQ(column(group, "time").value.size(), lags.size());
  for (std::size_t k = 0; k < lags.size(); ++k) {
    EXPECT_NEAR(column(group, "time").value[k], step * static_cast<double>(lags[k].frames), 1e-12);
    EXPECT_EQ(column(group, "origins").value[k], static_cast<double>(lags[k].origins));
    for (const auto& [name, pair] : definitions) {
      const bool of_rotors = is_of_rotors(name);
      if (of_rotors && group.rotors == 0) continue;
      const auto counts = [&](std::size_t i) {
        return is_member(i) && !(of_rotors && trajectory.read(0).shape[i].is_round());
      };
      const Estimate direct =
          block_average(direct_series(trajectory, lags[k], counts, pair), lags[k].shortest_block());
      // The stated error of J_0; squares of distances that went through a box of a few units.
      const double tolerance = name.starts_with("fs_") ? 1e-10 : 1e-11;
      EXPECT_NEAR(column(group, name).value[k], direct.mean, tolerance) << name << " " << k;
      const double error = column(group, name).error[k];
      EXPECT_EQ(std::isnan(error), std::isnan(direct.error)) << name << " " << k;
      if (std::isnan(error)) continue;
      EXPECT_NEAR(error, direct.error, tolerance) << name << " " << k;
    }
  }
}

TEST(MultipleTau, EqualsTheDirectEvaluationOfStoredFrames) {
  MemoryTrajectory2 frames = free_brownian(mixture(7), 1500, 1);
  const std::vector<CorrelatedGroup> groups = correlator_of(frames, half_of(frames)).correlations();
  ASSERT_EQ(groups.size(), 3u);
  EXPECT_EQ(groups[0].name, "all");
  EXPECT_EQ(groups[1].name, "A");
  EXPECT_EQ(groups[2].name, "B");
  EXPECT_EQ(groups[0].particles, 7u);
  EXPECT_EQ(groups[0].rotors, 5u);
  EXPECT_EQ(groups[2].rotors, 0u);
  EXPECT_THROW(column(groups[2], "msr"), std::out_of_range);
  expect_direct(groups[0], frames, [](std::size_t) { return true; });
  expect_direct(groups[1], frames, [](std::size_t i) { return i % 3 != 1; });
  expect_direct(groups[2], frames, [](std::size_t i) { return i % 3 == 1; });
}

/// Where all frames are origins, on level 0, the analysis of the stored frames averages over the
/// same.
template <int Dim>
void expect_analysis(MemoryTrajectory<Dim>& trajectory, const MultipleTauOptions& options,
                     double of_squares) {
  const CorrelatedGroup found = correlator_of(trajectory, options).correlations().front();
  const Displacements direct = displacements(trajectory, {.wave_numbers = wave_numbers});
  const DisplacementGroup& all = direct.groups.front();
  const std::map<std::string, const Correlation*> compared{
      {"msd", &all.translation},
      {"msr", &all.rotation},
      {"fs_1", &all.self_scattering[0]},
      {Dim == 2 ? "l_2" : "p_1", &all.orientation[0]},
      {Dim == 2 ? "l_4" : "p_2", &all.orientation[1]}};
  for (std::size_t k = 0; k < 7; ++k) {
    EXPECT_EQ(column(found, "origins").value[k], static_cast<double>(direct.origins[k]));
    EXPECT_NEAR(column(found, "time").value[k], direct.lag[k], 1e-10);
    for (const auto& [name, right] : compared) {
      const double tolerance = name.starts_with("ms") ? of_squares : 1e-10;
      EXPECT_NEAR(column(found, name).value[k], right->value[k], tolerance) << name;
      EXPECT_NEAR(column(found, name).error[k], right->error[k], tolerance) << name;
    }
  }
}

TEST(MultipleTau, EqualsTheAnalysisOfTheSameFrames) {
  MemoryTrajectory2 plane = free_brownian(long_particles(10), 1000, 2);
  expect_analysis(plane, half_of(plane), 1e-12);
  MemoryTrajectory3 space = walkers(6, 600, Vec3(2, 1, 1), 0.5, 9);
  expect_analysis(space, {0.5, 100, wave_numbers}, 1e-10);
}

/// Displacements and turns are normal, with half the mean square for each coordinate.
double free_correlation(const std::string& name, double steps, double inertia) {
  const double msd = free_msd(steps * step), msr = free_msr(steps * step, inertia);
  if (name == "msd") return msd;
  if (name == "msr") return msr;
  if (name == "fs_1") return std::exp(-std::pow(wave_numbers[0], 2) * msd / 4);
  if (name == "fs_2") return std::exp(-std::pow(wave_numbers[1], 2) * msd / 4);
  return std::exp(-(name == "l_2" ? 4 : 16) * msr / 2);
}

// Over 100 seeds an error bar covers the closed form in 68.27 of 100 cases, binomially distributed: within
// 3.5 standard deviations, false alarm 1 % for the 24 counts together. Lags on the levels 0 … 3. (Over
// 1000 seeds they are between 63.0 and 69.4 %, 66.5 % on the average: blocks of four lags leave a little
// of the correlations out.)
TEST(MultipleTau, ErrorBarsCoverTheClosedForms) {
  const std::vector<std::size_t> rows{0, 8, 13, 16};
  const std::vector<double> steps{1, 10, 24, 40};
  const double inertia = long_particles(1).inertia(0);
  std::map<std::string, std::vector<Coverage>> covered;
  for (int seed = 0; seed < 100; ++seed) {
    const CorrelatedGroup found = correlations(free_brownian(long_particles(8), 4096, 100 + seed));
    for (const auto& [name, pair] : definitions)
      for (std::size_t k = 0; k < rows.size(); ++k) {
        ASSERT_NEAR(column(found, "time").value[rows[k]], steps[k] * step, 1e-9);
        const Column& values = column(found, name);
        covered[name].resize(rows.size());
        covered[name][k].count(values.value[rows[k]] - free_correlation(name, steps[k], inertia),
                               values.error[rows[k]]);
      }
  }
  for (const auto& [name, lags] : covered)
    for (std::size_t k = 0; k < lags.size(); ++k) {
      SCOPED_TRACE(testing::Message() << name << " after " << steps[k]);
      expect_binomial(lags[k].one, 100, 0.6827, 3.5);
    }
}

// Within four of their errors, at all lags that have one: about 120 numbers, false alarm 1 % (independent lags,
// Gaussian means; the seed is fixed).
TEST(MultipleTau, FreeParticlesFollowTheClosedForms) {
  const CorrelatedGroup found = correlations(free_brownian(long_particles(100), 4000, 3));
  const double inertia = long_particles(1).inertia(0);
  const Column& time = column(found, "time");
  std::size_t judged = 0;
  for (const auto& [name, pair] : definitions)
    for (std::size_t k = 0; k < time.value.size(); ++k) {
      const Column& values = column(found, name);
      if (std::isnan(values.error[k])) continue;
      EXPECT_NEAR(values.value[k], free_correlation(name, time.value[k] / step, inertia),
                  4 * values.error[k])
          << name << " at " << time.value[k];
      ++judged;
    }
  EXPECT_GE(judged, 6u * (7 + 3 * 4));  // lags of the levels 0 … 3
  EXPECT_GT(time.value.back(), 0.75 * 0.5 * 3999 * step);
}

template <int Dim>
void expect_continuation(MemoryTrajectory<Dim>& trajectory, const MultipleTauOptions& options,
                         const std::vector<std::size_t>& stops) {
  const MultipleTau<Dim> whole = correlator_of(trajectory, options);
  for (const std::size_t stop : stops) {
    MultipleTau<Dim> before(trajectory.read(0), options), after(trajectory.read(0), options);
    show(before, trajectory, 0, stop);
    after.restore(before.state());
    EXPECT_EQ(after.samples(), stop);
    show(after, trajectory, stop, trajectory.frames());
    EXPECT_EQ(after.state(), whole.state()) << stop;
    const CorrelatedGroup a = after.correlations().front(), b = whole.correlations().front();
    for (std::size_t c = 0; c < a.columns.size(); ++c)
      EXPECT_EQ(a.columns[c].value, b.columns[c].value) << stop;
  }
}

TEST(MultipleTau, StoppedAtAnySampleItContinuesBitIdentical) {
  MemoryTrajectory2 plane = free_brownian(mixture(4), 300, 4);
  expect_continuation(plane, half_of(plane), {0, 1, 2, 17, 64, 131, 299, 300});
  MemoryTrajectory3 space = walkers(6, 150, Vec3(2, 1, 1), 0.5, 9);
  expect_continuation(space, {0.5, 30, wave_numbers}, {0, 1, 17, 64, 150});
}

TEST(MultipleTau, TurnsThatCannotBeToldApartAreLeftOut) {
  MemoryTrajectory3 trajectory = walkers(6, 100, Vec3(2, 1, 1), 3, 9);
  const CorrelatedGroup found = correlator_of(trajectory, {0.5, 10, {}}).correlations().front();
  EXPECT_THROW(column(found, "msr"), std::out_of_range);
  EXPECT_FALSE(column(found, "p_2").value.empty());
}

TEST(MultipleTau, RefusesTheStateOfAnother) {
  const MultipleTau<2> mine(long_particles(4), {step, 10, wave_numbers});
  MultipleTau<2> fewer_wave_numbers(long_particles(4), {step, 10, {1}});
  EXPECT_THROW(fewer_wave_numbers.restore(mine.state()), UserError);
  MultipleTau<2> other_interval(long_particles(4), {2 * step, 10, wave_numbers});
  EXPECT_THROW(other_interval.restore(mine.state()), UserError);
}

// Where the longest lag is fixed, a longer run does not add to the state, but for the logarithm of the number of samples in the sums.
TEST(MultipleTau, MemoryIsBoundedByTheLevels) {
  const std::size_t n = 50;
  const auto state_size = [&](std::size_t samples, double longest) {
    MemoryTrajectory2 trajectory = free_brownian(long_particles(n), samples, 5);
    return correlator_of(trajectory, {step, longest, {}}).state().size();
  };
  const std::size_t levels = 6;  // lags up to 4 · 2⁵ steps
  const double longest = 128 * step;
  EXPECT_EQ(MultipleTau<2>::sample_bytes(n, {step, longest, {}}), levels * n * 5 * 8 * 8);
  const std::size_t samples_part = levels * n * 3 * 8;
  // Level 0 has 7 lags, 1 … 4 have 4, and the last 1; 4 correlations each.
  const auto sums_part = [](std::size_t samples) {
    const auto block_levels = static_cast<std::size_t>(std::log2(samples)) + 1;
    return (1 + 4 * block_levels) * 4 * (7 + 4 * 4 + 1);
  };
  for (const std::size_t samples : {1000u, 4000u}) {
    EXPECT_GE(state_size(samples, longest), samples_part);
    EXPECT_LE(state_size(samples, longest), samples_part + sums_part(samples) + 5);
  }
}

}  // namespace
}  // namespace vitrel

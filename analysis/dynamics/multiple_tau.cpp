#include "analysis/dynamics/multiple_tau.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>

#include "analysis/dynamics/time_axis.h"
#include "core/error.h"

namespace vitrel {

namespace {

constexpr std::size_t places = MultipleTau::points;

/// Room for the rounding of a longest lag that is a whole number of intervals.
constexpr double slack = 1e-9;

std::uint64_t longest_steps(const MultipleTauOptions& options) {
  return static_cast<std::uint64_t>(
      std::max(1.0, std::floor(options.longest_lag / options.interval * (1 + slack))));
}

/// The steps of a level between samples that are paired.
std::vector<std::size_t> level_steps(std::size_t level, std::uint64_t longest) {
  std::vector<std::size_t> steps;
  for (std::size_t j = level == 0 ? 1 : places / 2; j < places && (j << level) <= longest; ++j)
    steps.push_back(j);
  return steps;
}

std::size_t level_count(std::uint64_t longest) {
  std::size_t levels = 1;
  while (!level_steps(levels, longest).empty()) ++levels;
  return levels;
}

/// Σ terms(i), begin ≤ i < end, each in two partial sums that do not wait for each other; the order is
/// always the same.
template <std::size_t Count, class Terms>
std::array<double, Count> sums_of(std::size_t begin, std::size_t end, Terms&& terms) {
  std::array<double, Count> even{}, odd{};
  const auto add = [](std::array<double, Count>& sums, const std::array<double, Count>& more) {
    for (std::size_t k = 0; k < Count; ++k) sums[k] += more[k];
  };
  std::size_t i = begin;
  for (; i + 2 <= end; i += 2) {
    add(even, terms(i));
    add(odd, terms(i + 1));
  }
  if (i < end) add(even, terms(i));
  add(even, odd);
  return even;
}

void append(std::vector<double>& numbers, const std::vector<double>& more) {
  numbers.insert(numbers.end(), more.begin(), more.end());
}

/// Takes `count` numbers from the front of `numbers`.
std::vector<double> take_front(std::span<const double>& numbers, std::size_t count) {
  const std::span<const double> front = numbers.first(count);
  numbers = numbers.subspan(count);
  return {front.begin(), front.end()};
}

/// What a state must share with the correlator that takes it.
std::vector<double> identity(std::size_t particles, const MultipleTauOptions& options) {
  std::vector<double> numbers{static_cast<double>(particles), options.interval, options.longest_lag,
                              static_cast<double>(options.wave_numbers.size())};
  append(numbers, options.wave_numbers);
  return numbers;
}

}  // namespace

MultipleTau::MultipleTau(const Configuration2& particles, MultipleTauOptions options)
    : options_(std::move(options)) {
  make_groups(particles);
  make_levels();
  for (std::vector<double>* values : {&now_.x, &now_.y, &now_.angle, &now_.cosine, &now_.sine})
    values->resize(particles.size());
  square_.resize(particles.size());
}

void MultipleTau::make_groups(const Configuration2& particles) {
  order_.resize(particles.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  const auto key = [&](std::size_t i) {
    return std::pair(particles.species[i], particles.shape[i].is_round());
  };
  std::stable_sort(order_.begin(), order_.end(),
                   [&](std::size_t i, std::size_t j) { return key(i) < key(j); });

  groups_.push_back({"all", {}});
  for (std::size_t begin = 0; begin < order_.size();) {
    Range range{begin, begin, begin};
    const std::int32_t species = particles.species[order_[begin]];
    while (range.end < order_.size() && particles.species[order_[range.end]] == species) {
      if (!particles.shape[order_[range.end]].is_round()) ++range.rotors_end;
      ++range.end;
    }
    groups_.front().ranges.push_back(ranges_.size());
    groups_.push_back({particles.species_names[species], {ranges_.size()}});
    ranges_.push_back(range);
    begin = range.end;
  }
  if (ranges_.size() == 1) groups_.pop_back();
  for (Group& group : groups_)
    for (const std::size_t k : group.ranges) {
      group.particles += ranges_[k].end - ranges_[k].begin;
      group.rotors += ranges_[k].rotors_end - ranges_[k].begin;
    }
}

void MultipleTau::make_levels() {
  const std::uint64_t longest = longest_steps(options_);
  levels_.resize(level_count(longest));
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    levels_[l].ring.resize(points);
    for (const std::size_t steps : level_steps(l, longest))
      levels_[l].lags.push_back(
          {steps, std::vector<BlockSums>(groups_.size() * correlation_count())});
  }
}

std::uint64_t MultipleTau::shown(std::size_t level) const {
  return samples_ == 0 ? 0 : ((samples_ - 1) >> level) + 1;
}

std::size_t MultipleTau::held(std::size_t level) const {
  return static_cast<std::size_t>(std::min<std::uint64_t>(shown(level), points));
}

void MultipleTau::observe(const Frame<2>& frame) {
  take(frame.configuration);
  const std::uint64_t sample = samples_++;
  for (std::size_t l = 0; l < levels_.size() && sample % (std::uint64_t{1} << l) == 0; ++l) {
    Level& level = levels_[l];
    const std::uint64_t index = sample >> l;
    level.ring[index % points] = now_;
    for (LagSums& lag : level.lags)
      if (lag.steps <= index) correlate(level.ring[(index - lag.steps) % points], now_, lag);
  }
}

void MultipleTau::take(const Configuration2& configuration) {
  for (std::size_t k = 0; k < order_.size(); ++k) {
    const std::size_t i = order_[k];
    const Vec2 position = configuration.unwrapped(i);
    now_.x[k] = position.x();
    now_.y[k] = position.y();
    now_.angle[k] = configuration.angle[i];
    now_.cosine[k] = std::cos(configuration.angle[i]);
    now_.sine[k] = std::sin(configuration.angle[i]);
  }
}

void MultipleTau::correlate(const Sample& from, const Sample& to, LagSums& lag) {
  const std::size_t correlations = correlation_count();
  sums_.resize(ranges_.size() * correlations);
  for (std::size_t r = 0; r < ranges_.size(); ++r) {
    sum_translation(from, to, ranges_[r], &sums_[r * correlations]);
    sum_rotation(from, to, ranges_[r], &sums_[r * correlations + translations()]);
  }
  for (std::size_t g = 0; g < groups_.size(); ++g)
    for (std::size_t c = 0; c < correlations; ++c) {
      const std::size_t members = c < translations() ? groups_[g].particles : groups_[g].rotors;
      if (members == 0) continue;
      double total = 0;
      for (const std::size_t r : groups_[g].ranges) total += sums_[r * correlations + c];
      lag.sums[g * correlations + c].add(total / static_cast<double>(members));
    }
}

void MultipleTau::sum_translation(const Sample& from, const Sample& to, const Range& range,
                                  double* sums) {
  double* const square = square_.data();
  sums[0] = sums_of<1>(range.begin, range.end, [&](std::size_t i) {
    const double x = to.x[i] - from.x[i], y = to.y[i] - from.y[i];
    square[i] = x * x + y * y;
    return std::array{square[i]};
  })[0];
  for (std::size_t k = 0; k < options_.wave_numbers.size(); ++k) {
    const double q = options_.wave_numbers[k];
    sums[1 + k] = sums_of<1>(range.begin, range.end, [&](std::size_t i) {
      return std::array{bessel_(q * std::sqrt(square[i]))};
    })[0];
  }
}

void MultipleTau::sum_rotation(const Sample& from, const Sample& to, const Range& range,
                               double* sums) const {
  const auto terms = [&](std::size_t i) {
    const double turn = to.angle[i] - from.angle[i];
    const double once = to.cosine[i] * from.cosine[i] + to.sine[i] * from.sine[i];
    const double twice = 2 * once * once - 1;
    return std::array{turn * turn, twice, 2 * twice * twice - 1};
  };
  const auto found = sums_of<3>(range.begin, range.rotors_end, terms);
  std::copy(found.begin(), found.end(), sums);
}

std::vector<CorrelatedGroup> MultipleTau::correlations() const {
  std::vector<CorrelatedGroup> result;
  for (std::size_t g = 0; g < groups_.size(); ++g) result.push_back(group_columns(g));
  return result;
}

CorrelatedGroup MultipleTau::group_columns(std::size_t group) const {
  Column time{"time", "time", {}, {}}, origins{"origins", "1", {}, {}};
  std::vector<Column> values{{"msd", "length^2", {}, {}}};
  for (std::size_t k = 0; k < options_.wave_numbers.size(); ++k)
    values.push_back({fmt::format("fs_{}", k + 1), "1", {}, {}});
  values.push_back({"msr", "rad^2", {}, {}});
  values.push_back({"l_2", "1", {}, {}});
  values.push_back({"l_4", "1", {}, {}});

  for (std::size_t l = 0; l < levels_.size(); ++l)
    for (const LagSums& lag : levels_[l].lags) {
      const BlockSums* sums = &lag.sums[group * values.size()];
      if (sums->count() == 0) continue;
      const std::size_t stride = std::size_t{1} << l;
      const Lag axis{lag.steps * stride, stride, sums->count()};
      time.value.push_back(static_cast<double>(axis.frames) * options_.interval);
      origins.value.push_back(static_cast<double>(axis.origins));
      for (std::size_t c = 0; c < values.size(); ++c) {
        const Estimate estimate = sums[c].estimate(axis.shortest_block());
        values[c].value.push_back(estimate.mean);
        values[c].error.push_back(estimate.error);
      }
    }

  CorrelatedGroup result{groups_[group].name, groups_[group].particles, groups_[group].rotors, {}};
  result.columns.push_back(std::move(time));
  if (result.rotors == 0) values.resize(translations());
  std::move(values.begin(), values.end(), std::back_inserter(result.columns));
  result.columns.push_back(std::move(origins));
  return result;
}

std::vector<double> MultipleTau::state() const {
  std::vector<double> numbers = identity(order_.size(), options_);
  numbers.push_back(static_cast<double>(samples_));
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    for (std::size_t k = 0; k < held(l); ++k) {
      const Sample& sample = levels_[l].ring[k];
      append(numbers, sample.x);
      append(numbers, sample.y);
      append(numbers, sample.angle);
    }
    for (const LagSums& lag : levels_[l].lags)
      for (const BlockSums& sums : lag.sums) sums.store(numbers);
  }
  return numbers;
}

void MultipleTau::restore(const std::vector<double>& state) {
  const std::vector<double> mine = identity(order_.size(), options_);
  if (state.size() <= mine.size() || !std::equal(mine.begin(), mine.end(), state.begin()))
    throw UserError(
        "the correlations of the checkpoint are of other particles, intervals or wave numbers; "
        "continue the run with its own parameters");
  std::span<const double> numbers = std::span(state).subspan(mine.size());
  samples_ = static_cast<std::uint64_t>(numbers.front());
  numbers = numbers.subspan(1);
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    for (std::size_t k = 0; k < held(l); ++k) {
      Sample& sample = levels_[l].ring[k];
      sample.x = take_front(numbers, order_.size());
      sample.y = take_front(numbers, order_.size());
      sample.angle = take_front(numbers, order_.size());
      sample.cosine.clear();
      sample.sine.clear();
      for (const double angle : sample.angle) {
        sample.cosine.push_back(std::cos(angle));
        sample.sine.push_back(std::sin(angle));
      }
    }
    for (LagSums& lag : levels_[l].lags)
      for (BlockSums& sums : lag.sums) numbers = sums.restore(numbers);
  }
}

double MultipleTau::sample_bytes(std::size_t particles, const MultipleTauOptions& options) {
  return static_cast<double>(level_count(longest_steps(options)) * points * particles * 5 *
                             sizeof(double));
}

}  // namespace vitrel

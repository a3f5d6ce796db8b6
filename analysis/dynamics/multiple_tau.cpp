#include "analysis/dynamics/multiple_tau.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>

#include "analysis/dynamics/time_axis.h"
#include "core/error.h"
#include "core/state/figure_axis.h"

namespace vitrel {

namespace {

constexpr std::size_t places = MultipleTau<2>::points;

/// Allows for the rounding of a longest lag that is a whole number of intervals.
constexpr double slack = 1e-9;

std::uint64_t longest_steps(const MultipleTauOptions& options) {
  return static_cast<std::uint64_t>(
      std::max(1.0, std::floor(options.longest_lag / options.interval * (1 + slack))));
}

/// Returns the steps between paired samples of a level.
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

/// Returns Σ terms(i), begin ≤ i < end, each in two partial sums that do not wait for each other; the order is always
/// the same.
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

/// Returns |x(to) − x(from)|² of entry i.
template <std::size_t Count>
double squared_change(const std::array<std::vector<double>, Count>& from,
                      const std::array<std::vector<double>, Count>& to, std::size_t i) {
  double sum = 0;
  for (std::size_t d = 0; d < Count; ++d) {
    const double change = to[d][i] - from[d][i];
    sum += change * change;
  }
  return sum;
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

/// Returns the numbers that a state must share with the correlator that restores it.
std::vector<double> identity(std::size_t particles, const MultipleTauOptions& options) {
  std::vector<double> numbers{static_cast<double>(particles), options.interval, options.longest_lag,
                              static_cast<double>(options.wave_numbers.size())};
  append(numbers, options.wave_numbers);
  return numbers;
}

}  // namespace

template <int Dim>
MultipleTau<Dim>::Sample::Sample(std::size_t particles) {
  for (auto& values : position) values.resize(particles);
  for (auto& values : turn) values.resize(particles);
  for (auto& values : axis) values.resize(particles);
}

template <int Dim>
MultipleTau<Dim>::MultipleTau(const Configuration<Dim>& particles, MultipleTauOptions options)
    : options_(std::move(options)), now_(particles.size()), square_(particles.size()) {
  make_groups(particles);
  make_levels();
}

template <int Dim>
void MultipleTau<Dim>::make_groups(const Configuration<Dim>& particles) {
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

template <int Dim>
void MultipleTau<Dim>::make_levels() {
  const std::uint64_t longest = longest_steps(options_);
  levels_.resize(level_count(longest));
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    levels_[l].ring.resize(points);
    for (const std::size_t steps : level_steps(l, longest))
      levels_[l].lags.push_back(
          {steps, std::vector<BlockSums>(groups_.size() * correlation_count())});
  }
}

template <int Dim>
std::uint64_t MultipleTau<Dim>::shown(std::size_t level) const {
  return samples_ == 0 ? 0 : ((samples_ - 1) >> level) + 1;
}

template <int Dim>
std::size_t MultipleTau<Dim>::held(std::size_t level) const {
  return static_cast<std::size_t>(std::min<std::uint64_t>(shown(level), points));
}

template <int Dim>
void MultipleTau<Dim>::observe(const Frame<Dim>& frame) {
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

template <int Dim>
void MultipleTau<Dim>::take(const Configuration<Dim>& configuration) {
  for (std::size_t k = 0; k < order_.size(); ++k) {
    const Vec<Dim> position = configuration.unwrapped(order_[k]);
    for (std::size_t d = 0; d < Dim; ++d) now_.position[d][k] = position[static_cast<int>(d)];
    if (!configuration.shape[order_[k]].is_round()) take_orientation(configuration, k);
  }
}

/// In the plane the axis follows from the angle.
template <>
void MultipleTau<2>::set_axis(Sample& sample, std::size_t k) const {
  sample.axis[0][k] = std::cos(sample.turn[0][k]);
  sample.axis[1][k] = std::sin(sample.turn[0][k]);
}

template <>
void MultipleTau<2>::take_orientation(const Configuration2& configuration, std::size_t k) {
  now_.turn[0][k] = configuration.angle[order_[k]];
  set_axis(now_, k);
}

template <>
void MultipleTau<3>::take_orientation(const Configuration3& configuration, std::size_t k) {
  const std::size_t i = order_[k];
  const Quaternion& orientation = configuration.orientation[i];
  const Vec3 axis = figure_axis(configuration.shape[i], orientation);
  orientation_.resize(order_.size());
  Vec3 turn = Vec3::Zero();
  if (samples_ > 0) turn = rotation_vector(orientation * orientation_[k].conjugate());
  largest_turn_ = std::max(largest_turn_, turn.norm());
  orientation_[k] = orientation;
  for (std::size_t d = 0; d < 3; ++d) {
    now_.turn[d][k] += turn[static_cast<int>(d)];
    now_.axis[d][k] = axis[static_cast<int>(d)];
  }
}

template <int Dim>
void MultipleTau<Dim>::correlate(const Sample& from, const Sample& to, LagSums& lag) {
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

template <int Dim>
void MultipleTau<Dim>::sum_translation(const Sample& from, const Sample& to, const Range& range,
                                       double* sums) {
  double* const square = square_.data();
  sums[0] = sums_of<1>(range.begin, range.end, [&](std::size_t i) {
    square[i] = squared_change(from.position, to.position, i);
    return std::array{square[i]};
  })[0];
  for (std::size_t k = 0; k < options_.wave_numbers.size(); ++k) {
    const double q = options_.wave_numbers[k];
    sums[1 + k] = sums_of<1>(range.begin, range.end, [&](std::size_t i) {
      return std::array{direction_average_(q * std::sqrt(square[i]))};
    })[0];
  }
}

template <int Dim>
void MultipleTau<Dim>::sum_rotation(const Sample& from, const Sample& to, const Range& range,
                                    double* sums) const {
  const auto terms = [&](std::size_t i) {
    double cosine = 0;
    for (std::size_t d = 0; d < Dim; ++d) cosine += to.axis[d][i] * from.axis[d][i];
    const double twice = 2 * cosine * cosine - 1;
    const double turn = squared_change(from.turn, to.turn, i);
    return Dim == 2 ? std::array{turn, twice, 2 * twice * twice - 1}
                    : std::array{turn, cosine, 1.5 * cosine * cosine - 0.5};
  };
  const auto found = sums_of<3>(range.begin, range.rotors_end, terms);
  std::copy(found.begin(), found.end(), sums);
}

template <int Dim>
std::vector<CorrelatedGroup> MultipleTau<Dim>::correlations() const {
  std::vector<CorrelatedGroup> result;
  for (std::size_t g = 0; g < groups_.size(); ++g) result.push_back(group_columns(g));
  return result;
}

template <int Dim>
CorrelatedGroup MultipleTau<Dim>::group_columns(std::size_t group) const {
  Column time{"time", "time"}, origins{"origins", "1"};
  std::vector<Column> values{{"msd", "length^2"}};
  for (std::size_t k = 0; k < options_.wave_numbers.size(); ++k)
    values.push_back({fmt::format("fs_{}", k + 1), "1"});
  values.push_back({"msr", "rad^2"});
  values.push_back({Dim == 2 ? "l_2" : "p_1", "1"});
  values.push_back({Dim == 2 ? "l_4" : "p_2", "1"});

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
  if (!turns_are_known(largest_turn_))
    std::erase_if(values, [](const Column& column) { return column.name == "msr"; });
  std::move(values.begin(), values.end(), std::back_inserter(result.columns));
  result.columns.push_back(std::move(origins));
  return result;
}

template <int Dim>
std::vector<double> MultipleTau<Dim>::state() const {
  std::vector<double> numbers = identity(order_.size(), options_);
  numbers.push_back(static_cast<double>(samples_));
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    for (std::size_t k = 0; k < held(l); ++k)
      for (const std::vector<double>* series : stored(levels_[l].ring[k])) append(numbers, *series);
    for (const LagSums& lag : levels_[l].lags)
      for (const BlockSums& sums : lag.sums) sums.store(numbers);
  }
  if constexpr (Dim == 3) {
    for (const auto& series : now_.turn) append(numbers, series);
    numbers.push_back(largest_turn_);
    for (const Quaternion& q : orientation_)
      numbers.insert(numbers.end(), {q.w(), q.x(), q.y(), q.z()});
  }
  return numbers;
}

template <int Dim>
void MultipleTau<Dim>::restore(const std::vector<double>& state) {
  const std::vector<double> mine = identity(order_.size(), options_);
  if (state.size() <= mine.size() || !std::equal(mine.begin(), mine.end(), state.begin()))
    throw UserError(
        "the correlations of the checkpoint are of other particles, intervals or wave numbers; "
        "continue the run with its own parameters");
  const std::size_t particles = order_.size();
  std::span<const double> numbers = std::span(state).subspan(mine.size());
  samples_ = static_cast<std::uint64_t>(take_front(numbers, 1).front());
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    for (std::size_t k = 0; k < held(l); ++k) {
      Sample& sample = levels_[l].ring[k] = Sample(particles);
      for (std::vector<double>* series : stored(sample)) *series = take_front(numbers, particles);
      if constexpr (Dim == 2)
        for (std::size_t i = 0; i < particles; ++i) set_axis(sample, i);
    }
    for (LagSums& lag : levels_[l].lags)
      for (BlockSums& sums : lag.sums) numbers = sums.restore(numbers);
  }
  if constexpr (Dim == 3) restore_orientations(numbers);
}

template <int Dim>
void MultipleTau<Dim>::restore_orientations(std::span<const double> numbers) {
  for (auto& series : now_.turn) series = take_front(numbers, order_.size());
  largest_turn_ = take_front(numbers, 1).front();
  orientation_.clear();
  while (!numbers.empty()) {
    const std::vector<double> q = take_front(numbers, 4);
    orientation_.emplace_back(q[0], q[1], q[2], q[3]);
  }
}

template <int Dim>
double MultipleTau<Dim>::sample_bytes(std::size_t particles, const MultipleTauOptions& options) {
  constexpr std::size_t numbers = Dim + rotations + Dim;
  return static_cast<double>(level_count(longest_steps(options)) * points * particles * numbers *
                             sizeof(double));
}

template class MultipleTau<2>;
template class MultipleTau<3>;

}  // namespace vitrel

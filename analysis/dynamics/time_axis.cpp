#include "analysis/dynamics/time_axis.h"

#include <algorithm>
#include <cmath>

#include "analysis/trajectory.h"

namespace vitrel {

namespace {

constexpr std::size_t max_pairs = std::size_t{1} << 22;
/// The relative rounding error of single precision.
constexpr double single_precision = 0x1p-24;
/// The maximum relative difference of time differences that are taken as equal.
constexpr double widest = 1e-3;
/// The number of time differences for functions that depend on more than the time difference.
constexpr std::size_t few_lags = 10;

std::size_t stride_to(std::size_t most, std::size_t available) {
  return (available + most - 1) / most;
}

std::vector<Lag> even_lags(std::span<const double> times, const TimeAxisOptions& options) {
  const double intervals = static_cast<double>(times.size() - 1);
  const auto longest =
      std::max<std::size_t>(1, static_cast<std::size_t>(options.longest_lag * intervals));
  const double growth = std::pow(10, 1 / static_cast<double>(options.lags_per_decade));
  const std::size_t stride = even_stride(times.size(), options);
  std::vector<Lag> lags;
  double next = 1;
  for (std::size_t frames = 1; frames <= longest;) {
    const double time = (times.back() - times.front()) * static_cast<double>(frames) / intervals;
    lags.push_back({frames, stride, (times.size() - frames - 1) / stride + 1, time});
    if (frames < options.every_lag_up_to) {
      next = static_cast<double>(++frames);
    } else {
      next = std::max(next * growth, static_cast<double>(frames + 1));
      frames = static_cast<std::size_t>(next);
    }
  }
  return lags;
}

/// A time difference between two frames, and the amount by which rounding may have changed it.
struct Difference {
  Difference(std::span<const double> times, std::size_t from, std::size_t to)
      : time(times[to] - times[from]),
        uncertainty(single_precision * (std::abs(times[from]) + std::abs(times[to]))),
        is_from_first(from == 0) {}

  double time, uncertainty;
  bool is_from_first;
};

/// Returns how far another difference may be from this one and yet be taken as equal.
double tolerance(const Difference& one, const Difference& other) {
  return std::min(one.uncertainty + other.uncertainty, widest * one.time);
}

/// Returns the differences from this number of first frames.
std::vector<Difference> first_differences(std::span<const double> times, std::size_t first_frames) {
  std::vector<Difference> found;
  for (std::size_t from = 0; from < first_frames; ++from) {
    if (from > 0 && found.size() + times.size() - 1 - from > max_pairs) break;
    for (std::size_t to = from + 1; to < times.size(); ++to) found.emplace_back(times, from, to);
  }
  std::sort(found.begin(), found.end(), [](const Difference& a, const Difference& b) {
    return std::pair(a.time, a.uncertainty) < std::pair(b.time, b.uncertainty);
  });
  return found;
}

/// Returns for every step of time the difference that most pairs have, in ascending order.
std::vector<Difference> common_differences(const std::vector<Difference>& sorted,
                                           std::size_t steps_per_decade) {
  std::vector<Difference> chosen;
  double chosen_step = -1;
  std::size_t chosen_pairs = 0;
  for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
    const Difference& first = sorted[begin];
    bool is_from_first = false;
    for (; end < sorted.size() && sorted[end].time - first.time <= tolerance(first, sorted[end]);
         ++end)
      is_from_first = is_from_first || sorted[end].is_from_first;
    const std::size_t pairs = end - begin;
    if (pairs == 1 && !is_from_first) continue;
    const double shortest = chosen.empty() ? first.time : chosen.front().time;
    const double step =
        std::floor(std::log10(first.time / shortest) * static_cast<double>(steps_per_decade));
    if (step > chosen_step)
      chosen.push_back(first);
    else if (pairs > chosen_pairs)
      chosen.back() = first;
    else
      continue;
    chosen_step = step;
    chosen_pairs = pairs;
  }
  return chosen;
}

/// Returns all pairs of frames that are this far apart and begin in one of the first frames.
std::vector<FramePair> pairs_of(const Difference& wanted, std::span<const double> times,
                                std::size_t first_frames) {
  std::vector<FramePair> pairs;
  for (std::size_t from = 0, to = 0; from < first_frames; ++from) {
    const auto away = [&](const Difference& d) { return d.time - wanted.time; };
    for (; to < times.size(); ++to) {
      const Difference difference(times, from, to);
      if (away(difference) < -tolerance(wanted, difference)) continue;
      if (away(difference) <= tolerance(wanted, difference))
        pairs.push_back({static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to)});
      break;
    }
  }
  return pairs;
}

/// Returns the maximum number of origins that begin within some window of this duration.
std::size_t max_within(double duration, const std::vector<FramePair>& pairs,
                       std::span<const double> times) {
  std::size_t most = 0;
  for (std::size_t begin = 0, end = 0; begin < pairs.size(); ++begin) {
    while (end < pairs.size() && times[pairs[end].from] - times[pairs[begin].from] < duration)
      ++end;
    most = std::max(most, end - begin);
  }
  return most;
}

Lag lag_of(const Difference& wanted, std::span<const double> times, std::size_t first_frames,
           std::size_t max_origins) {
  std::vector<FramePair> pairs;
  const std::vector<FramePair> all = pairs_of(wanted, times, first_frames);
  const std::size_t stride = stride_to(max_origins, all.size());
  double excess = 0;
  for (std::size_t k = 0; k < all.size(); k += stride) {
    pairs.push_back(all[k]);
    excess += times[all[k].to] - times[all[k].from] - wanted.time;
  }
  const std::size_t origins = pairs.size();
  const bool share = max_within((1 - widest) * wanted.time, pairs, times) > 1;
  const std::size_t block = share ? max_within(4 * wanted.time, pairs, times) : 1;
  const double time = wanted.time + excess / static_cast<double>(origins);
  return {0, 0, origins, time, std::move(pairs), block};
}

std::vector<Lag> uneven_lags(std::span<const double> times, const TimeAxisOptions& options) {
  const std::size_t first_frames = options.only_first_origin ? 1 : times.size() - 1;
  std::vector<Lag> lags;
  double least = 0;  // keeps lags so far apart that no pair of frames belongs to two
  for (const Difference& wanted :
       common_differences(first_differences(times, first_frames), options.lags_per_decade)) {
    if (wanted.time < least) continue;
    lags.push_back(lag_of(wanted, times, first_frames, options.max_origins));
    least = wanted.time * (1 + 3 * widest);
  }
  return lags;
}

}  // namespace

std::size_t origins_for(std::size_t particles, std::size_t most, std::size_t divisor) {
  constexpr std::size_t particles_at_all = std::size_t{1} << 21;
  return std::clamp(particles_at_all / std::max<std::size_t>(1, particles),
                    std::max<std::size_t>(1, most / divisor), most);
}

std::size_t even_stride(std::size_t frames, const TimeAxisOptions& options) {
  return stride_to(options.only_first_origin ? 1 : options.max_origins, frames);
}

double Lag::shortest_block() const {
  if (!pairs.empty()) return static_cast<double>(pairs_per_block);
  return stride < frames ? 4 * static_cast<double>(frames) / static_cast<double>(stride) : 1;
}

std::vector<Lag> time_axis(std::span<const double> times, const TimeAxisOptions& options) {
  if (times.size() < 2) return {};
  return evenly_spaced(times) ? even_lags(times, options) : uneven_lags(times, options);
}

std::vector<Lag> lags_from_zero(std::span<const double> times, const TimeAxisOptions& axis) {
  std::vector<Lag> lags = time_axis(times, axis);
  const std::size_t stride = even_stride(times.size(), axis);
  lags.insert(lags.begin(), Lag{0, stride, (times.size() - 1) / stride + 1});
  return lags;
}

std::vector<Lag> time_axis_of_motion(const FrameTimes& trajectory, const TimeAxisOptions& options) {
  std::vector<Lag> lags = time_axis(trajectory.times(), options);
  const std::vector<std::size_t> doubtful = trajectory.doubtful_frames();
  const auto spans_doubt = [&](const FramePair& pair) {
    const auto next = std::ranges::upper_bound(doubtful, pair.from);
    return next != doubtful.end() && *next <= pair.to;
  };
  std::erase_if(lags, [&](Lag& lag) {
    if (lag.pairs.empty()) return false;
    std::erase_if(lag.pairs, spans_doubt);
    lag.origins = lag.pairs.size();
    return lag.origins == 0;
  });
  return lags;
}

std::vector<Lag> few_lags_of_motion(const FrameTimes& trajectory, TimeAxisOptions options) {
  options.max_origins = std::min(options.max_origins, few_origins);
  options.longest_lag = std::min(options.longest_lag, longest_of_few);
  std::vector<Lag> all = time_axis_of_motion(trajectory, options), few;
  if (all.empty()) return few;
  const double shortest = all.front().time, range = all.back().time / shortest;
  double next = 0;  // next of few_lags steps
  for (Lag& lag : all) {
    const double place = range > 1 ? std::log(lag.time / shortest) / std::log(range) : 0;
    if (place * (few_lags - 1) < next - 1e-9) continue;
    next = std::floor(place * (few_lags - 1) + 1e-9) + 1;
    few.push_back(std::move(lag));
  }
  return few;
}

}  // namespace vitrel

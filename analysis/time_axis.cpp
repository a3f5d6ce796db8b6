#include "analysis/time_axis.h"

#include <algorithm>
#include <cmath>

#include "analysis/trajectory.h"

namespace vitrel {

namespace {

Lag lag_of(std::size_t frames, std::size_t samples, std::size_t most_origins) {
  const std::size_t available = samples - frames;
  const std::size_t stride = (available + most_origins - 1) / most_origins;
  return {frames, stride, (available - 1) / stride + 1};
}

std::vector<Lag> even_lags(std::size_t samples, const TimeAxisOptions& options) {
  const double span = options.longest_lag * static_cast<double>(samples - 1);
  const auto longest = std::max<std::size_t>(1, static_cast<std::size_t>(span));
  const double growth = std::pow(10, 1 / static_cast<double>(options.lags_per_decade));
  std::vector<Lag> lags;
  double next = 1;
  for (std::size_t frames = 1; frames <= longest;) {
    lags.push_back(lag_of(frames, samples, options.most_origins));
    if (frames < options.every_lag_up_to) {
      next = static_cast<double>(++frames);
    } else {
      next = std::max(next * growth, static_cast<double>(frames + 1));
      frames = static_cast<std::size_t>(next);
    }
  }
  return lags;
}

std::vector<Lag> lags_from_the_start(std::size_t samples) {
  std::vector<Lag> lags;
  for (std::size_t frames = 1; frames < samples; ++frames) lags.push_back({frames, 1, 1});
  return lags;
}

}  // namespace

double Lag::shortest_block() const {
  return stride < frames ? 4 * static_cast<double>(frames) / static_cast<double>(stride) : 1;
}

std::vector<Lag> time_axis(std::span<const double> times, const TimeAxisOptions& options) {
  if (times.size() < 2) return {};
  return evenly_spaced(times) ? even_lags(times.size(), options)
                              : lags_from_the_start(times.size());
}

}  // namespace vitrel

#pragma once

#include <cstddef>
#include <span>
#include <vector>

/// The time differences at which a correlation is evaluated, and the origins it is averaged over.
namespace vitrel {

struct TimeAxisOptions {
  double longest_lag = 0.5;  ///< longest time difference, as a fraction of the run; in (0, 1]
  std::size_t every_lag_up_to =
      100;  ///< in sample intervals; longer lags are spaced logarithmically,
  std::size_t lags_per_decade = 50;  ///< that many to a decade
  std::size_t most_origins = 4096;   ///< time origins per lag; evenly thinned beyond
};

/// Which pairs of frames make up one point: (k, k + frames) for k = 0, stride, 2 stride …
struct Lag {
  std::size_t frames;
  std::size_t stride;
  std::size_t origins;

  /// Displacements from origins closer than the lag share part of their path. For diffusion their
  /// squares are correlated as (1 − s/lag)², and blocks of four lags leave 6 % of the variance
  /// between blocks: that many origins. 1 where origins share nothing.
  double shortest_block() const;
};

/// The lags of a run with these sample times. Evenly sampled: 1 … `every_lag_up_to` sample
/// intervals, then logarithmically spaced ones up to `longest_lag`; all frames are origins, evenly
/// thinned to `most_origins` per lag. Any other run (logarithmic samples): the first frame is the
/// only origin, every later one a lag. Empty for fewer than two frames.
std::vector<Lag> time_axis(std::span<const double> times, const TimeAxisOptions& options = {});

}  // namespace vitrel

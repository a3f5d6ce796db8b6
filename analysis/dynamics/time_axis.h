#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "analysis/trajectory.h"

/// @file
/// The time differences at which a correlation is evaluated, and the origins over which it is averaged.
namespace vitrel {

struct TimeAxisOptions {
  /// Longest time difference, as a fraction of the run, if that is evenly sampled; in (0, 1].
  double longest_lag = 0.5;
  /// All lags up to this number of sample intervals are used; longer lags are spaced logarithmically.
  std::size_t every_lag_up_to = 100;
  std::size_t lags_per_decade = 50;  ///< number of longer lags per decade
  std::size_t max_origins = 4096;    ///< time origins per lag; evenly thinned beyond
  bool only_first_origin = false;    ///< the first frame is the only origin
};

struct FramePair {
  std::uint32_t from, to;
};

/// The pairs of frames that make up one point, by time of origin. In evenly sampled runs they are (k, k + frames) for
/// k = 0, stride, 2 stride …; otherwise they are listed.
struct Lag {
  std::size_t frames, stride;
  std::size_t origins;
  double time = 0;                    ///< the mean time difference of the pairs
  std::vector<FramePair> pairs = {};  ///< empty: evenly sampled
  std::size_t pairs_per_block = 1;    ///< length of blocks for the errors, for listed pairs

  std::size_t from(std::size_t origin) const {
    return pairs.empty() ? origin * stride : pairs[origin].from;
  }
  std::size_t to(std::size_t origin) const {
    return pairs.empty() ? origin * stride + frames : pairs[origin].to;
  }

  /// Returns the minimum number of origins of a block for the errors. Displacements from origins closer than the lag
  /// share part of their path. For diffusion their squares are correlated as (1 − s/lag)², and blocks of four lags
  /// leave 6 % of the variance between blocks. A block therefore has as many origins as lie within four lags, where
  /// they are densest. It is 1 if origins share nothing.
  double shortest_block() const;
};

/// Returns the lags of a run with these sample times, ascending, without 0. Empty for fewer than two frames.
///
/// An evenly sampled run has the lags 1 … `every_lag_up_to` sample intervals, then logarithmically spaced ones up to
/// `longest_lag`. All frames are origins, evenly thinned to `max_origins`, the same ones for all lags (even_stride).
///
/// Any other run, such as one with logarithmic samples, once or in cycles, has lags as follows:
/// 1. Time differences of pairs of frames are equal if rounding to single precision can account for their difference,
///    2⁻²⁴ of each of the four times, but never by more than a thousandth.
/// 2. A lag is a time difference that at least two pairs have, or that the first frame has with another one. Of those
///    within one of `lags_per_decade` steps the one with most pairs is taken, and among equals the shortest. Lags go on
///    to the end of the run, for the longest may have as many origins as any.
/// 3. All pairs of a lag are origins, in the order of time, evenly thinned to `max_origins`. Blocks for the errors are
///    counted in origins, so their durations differ, but none is shorter than four lags.
/// Lags are looked for among at most 2²² pairs, those of the first frames: all pairs of 2 896 frames, and 2²²/frames
/// origins of longer runs, which should comprise a cycle. The cost is about (lags) × (frames), and a second for the
/// pairs.
std::vector<Lag> time_axis(std::span<const double> times, const TimeAxisOptions& options = {});

/// Returns a number of origins that is enough for averages over this number of particles at each of them: `most`, or
/// fewer, down to `most`/`divisor`, if together these were more than 2²¹ particles.
std::size_t origins_for(std::size_t particles, std::size_t most, std::size_t divisor = 4);

/// Returns the number of frames from one origin to the next in an evenly sampled run.
std::size_t even_stride(std::size_t frames, const TimeAxisOptions& options);

/// Returns the lags of time_axis after time difference 0, which has all frames as origins, evenly thinned to
/// `max_origins`.
std::vector<Lag> lags_from_zero(std::span<const double> times, const TimeAxisOptions& axis);

/// Returns the lags at which the motion of particles can be evaluated. If the run is not evenly sampled, pairs of
/// frames with a doubtful frame between them, or at their end, are left out, and so are lags without a pair. An evenly
/// sampled run keeps all, because its intervals are alike.
std::vector<Lag> time_axis_of_motion(const FrameTimes& trajectory,
                                     const TimeAxisOptions& options = {});

/// The maximum number of origins in few_lags_of_motion, and the longest of its time differences as a fraction of an
/// evenly sampled run: errors of longer ones would rest on too few independent origins.
inline constexpr std::size_t few_origins = 128;
inline constexpr double longest_of_few = 0.125;

/// Returns at most ten of the lags of time_axis_of_motion, about equally far apart on a logarithmic scale, with the
/// shortest and the longest among them. They serve functions that depend on more than the time difference. They share
/// origins.
std::vector<Lag> few_lags_of_motion(const FrameTimes& trajectory, TimeAxisOptions options);

}  // namespace vitrel

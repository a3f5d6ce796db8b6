#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "analysis/dynamics/time_axis.h"
#include "analysis/structure/frame_average.h"
#include "analysis/trajectory.h"
#include "core/parallel.h"

/// @file
/// Functions of the positions of particles at two times, at a few time differences.
namespace vitrel {

/// All particles at an origin of time, and a time difference later.
template <int Dim>
struct TwoTimes {
  std::size_t origin;                  ///< number of the origin among those of this time difference
  const std::vector<Vec<Dim>>* start;  ///< positions at the origin, in the box
  std::vector<Vec<Dim>> end;           ///< positions at the later time
  std::vector<double> distance;        ///< |r_i(t) − r_i(0)|, unwrapped
};

/// A function that gives a row of numbers, one for every x. `row` is called for several origins at a time.
template <int Dim>
struct TwoTimeFunction {
  std::vector<double> x;
  std::function<std::vector<double>(const TwoTimes<Dim>&)> row;
};

/// Averages of a function of two times over origins.
struct TwoTimeAverages {
  std::vector<double> x;
  std::vector<Averages> at_lag;  ///< rows at every lag
};

/// Makes one pass over the origins of all lags for all functions. The rows of a lag are averaged in the order of time,
/// with the errors of FrameAverage: NaN if frames are not evenly sampled, or origins too few. The lags should share
/// origins (few_lags_of_motion). A frame is read once for every lag that ends at it and once as an origin; the
/// positions of one origin and of all lags after it are held, 8 N (Dim + lags (Dim + 1)) bytes, and 16 bytes for every
/// number of all rows. Threads share the lags of an origin, and the result does not depend on their number.
template <int Dim>
std::vector<TwoTimeAverages> average_two_times(Trajectory<Dim>& trajectory,
                                               const std::vector<Lag>& lags,
                                               const std::vector<TwoTimeFunction<Dim>>& functions,
                                               const ProgressReport& report = {},
                                               int threads = all_cores);

}  // namespace vitrel

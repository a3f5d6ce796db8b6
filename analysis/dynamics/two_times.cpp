#include "analysis/dynamics/two_times.h"

namespace vitrel {

namespace {

template <int Dim>
TwoTimes<Dim> read_pair(Trajectory<Dim>& trajectory, const Configuration<Dim>& start,
                        std::size_t to, std::size_t origin) {
  const Configuration<Dim>& frame = trajectory.read_places(to);
  TwoTimes<Dim> pair{origin, &start.position, frame.position, {}};
  for (std::size_t i = 0; i < frame.size(); ++i)
    pair.distance.push_back((frame.unwrapped(i) - start.unwrapped(i)).norm());
  return pair;
}

}  // namespace

template <int Dim>
std::vector<TwoTimeAverages> average_two_times(Trajectory<Dim>& trajectory,
                                               const std::vector<Lag>& lags,
                                               const std::vector<TwoTimeFunction<Dim>>& functions,
                                               const ProgressReport& report, int threads) {
  std::vector<std::vector<FrameAverage>> sums(lags.size(),
                                              std::vector<FrameAverage>(functions.size()));
  std::vector<std::size_t> next(lags.size());  // next origin of every lag
  for (std::size_t from = 0; from < trajectory.frames(); ++from) {
    std::vector<std::size_t> at_lag;
    for (std::size_t l = 0; l < lags.size(); ++l)
      if (next[l] < lags[l].origins && lags[l].from(next[l]) == from) at_lag.push_back(l);
    if (at_lag.empty()) continue;
    const Configuration<Dim> start = trajectory.read_places(from);
    std::vector<TwoTimes<Dim>> pairs;
    for (const std::size_t l : at_lag) {
      pairs.push_back(read_pair(trajectory, start, lags[l].to(next[l]), next[l]));
      ++next[l];
    }
    each_in_parallel(pairs.size(), threads, [&](std::size_t p) {
      for (std::size_t f = 0; f < functions.size(); ++f)
        sums[at_lag[p]][f].add(functions[f].row(pairs[p]));
    });
    const double done = static_cast<double>(from + 1);
    if (report) report({done / static_cast<double>(trajectory.frames()), done, "frames"});
  }
  const bool is_even = evenly_spaced(trajectory.times());
  std::vector<TwoTimeAverages> averages;
  for (std::size_t f = 0; f < functions.size(); ++f) {
    averages.push_back({functions[f].x, {}});
    for (const std::vector<FrameAverage>& lag : sums)
      averages.back().at_lag.push_back(lag[f].averages(is_even));
  }
  return averages;
}

template std::vector<TwoTimeAverages> average_two_times(Trajectory2&, const std::vector<Lag>&,
                                                        const std::vector<TwoTimeFunction<2>>&,
                                                        const ProgressReport&, int);
template std::vector<TwoTimeAverages> average_two_times(Trajectory3&, const std::vector<Lag>&,
                                                        const std::vector<TwoTimeFunction<3>>&,
                                                        const ProgressReport&, int);

}  // namespace vitrel

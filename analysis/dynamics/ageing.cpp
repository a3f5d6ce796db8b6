#include "analysis/dynamics/ageing.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "analysis/structure/order.h"
#include "core/error.h"

namespace vitrel {

namespace {

constexpr double rounding = 1e-9;  // relative, of a waiting time
constexpr double bin_width = 0.5;  // for orientational correlations

double nematic_length(const Configuration2& frame) {
  if (rotor_count(frame) < 2) return std::numeric_limits<double>::quiet_NaN();
  return correlation_length(nematic_correlation(frame, bin_width));
}
double nematic_length(const Configuration3&) {
  return std::numeric_limits<double>::quiet_NaN();
}

std::size_t frame_after(const std::vector<double>& times, double waiting_time) {
  const double earliest = times.front() + waiting_time * (1 - rounding);
  const auto found = std::ranges::lower_bound(times, earliest);
  if (times.end() - found < 2)
    throw UserError(
        fmt::format("analysis.waiting_times has {:g}, but the last frame, which must be later, is "
                    "{:g} after the first",
                    waiting_time, times.back() - times.front()));
  return static_cast<std::size_t>(found - times.begin());
}

}  // namespace

template <int Dim>
std::vector<AgedMotion> ageing(Trajectory<Dim>& trajectory, DisplacementOptions options,
                               const ProgressReport& report) {
  options.axis.only_first_origin = true;
  options.axis.longest_lag = 1;
  if (!options.wave_numbers.empty()) options.wave_numbers = {options.wave_numbers.front()};
  options.orders = {2};
  const std::vector<double>& times = trajectory.times();
  std::vector<AgedMotion> aged;
  for (const double waiting_time : options.waiting_times) {
    const std::size_t frame = frame_after(times, waiting_time);
    TrajectoryPart<Dim> rest(trajectory, frame, times.size());
    aged.push_back({times[frame] - times.front(), displacements<Dim>(rest, options, report),
                    nematic_length(trajectory.read(frame))});
  }
  return aged;
}

template std::vector<AgedMotion> ageing(Trajectory2&, DisplacementOptions, const ProgressReport&);
template std::vector<AgedMotion> ageing(Trajectory3&, DisplacementOptions, const ProgressReport&);

}  // namespace vitrel

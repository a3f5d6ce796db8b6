#include "analysis/dynamics/viscosity.h"

#include <algorithm>
#include <cmath>

namespace vitrel {
namespace {

/// Returns the squared changes over this lag from the first origins, added over the elements.
std::vector<double> squared_changes(const std::vector<std::vector<double>>& moments, const Lag& lag,
                                    std::size_t origins) {
  std::vector<double> squares(origins);
  for (const std::vector<double>& moment : moments)
    for (std::size_t k = 0; k < origins; ++k) {
      const double change = moment[lag.to(k)] - moment[lag.from(k)];
      squares[k] += change * change;
    }
  return squares;
}

Estimate mean_of_origins(std::span<const double> series, const Lag& lag, double factor) {
  CorrelationSum sum(series.size());
  sum.add(0, series);
  const Estimate mean = sum.estimate(lag, 1).by_blocks;
  return {factor * mean.mean, factor * mean.error, mean.blocks};
}

/// Returns the slope between the relaxation time and three times that.
DiffusionCoefficient slope(const std::vector<Lag>& lags,
                           const std::vector<std::vector<double>>& moments, double relaxation_time,
                           double factor) {
  const auto at = [&](double time) { return std::ranges::lower_bound(lags, time, {}, &Lag::time); };
  if (std::isnan(relaxation_time))
    return no_coefficient(
        "particles have not moved by a unit of length: the stress may not have decayed");
  if (lags.empty() || !lags.front().pairs.empty())
    return no_coefficient("the samples are not evenly spaced in time");
  const auto from = at(relaxation_time);
  const auto to = from == lags.end() ? from : at(3 * from->time);
  if (to == lags.end())
    return no_coefficient(
        "the longest time difference is below three times that in which stress decays");
  std::vector<double> changes = squared_changes(moments, *to, to->origins);
  const std::vector<double> before = squared_changes(moments, *from, to->origins);
  for (std::size_t k = 0; k < changes.size(); ++k) changes[k] -= before[k];
  const Estimate found = mean_of_origins(changes, *to, factor / (to->time - from->time));
  if (found.blocks == 0) return no_coefficient("the run is too short for an error");
  return {found.mean, found.error, from->time, to->time, ""};
}

}  // namespace

Viscosity shear_viscosity(const std::vector<double>& times,
                          const std::vector<std::vector<double>>& moments,
                          const ViscosityScale& scale, TimeAxisOptions axis) {
  axis.max_origins = times.size();
  const std::vector<Lag> lags = time_axis(times, axis);
  const double factor =
      1 / (2 * scale.volume * scale.temperature * static_cast<double>(moments.size()));
  Viscosity found;
  for (const Lag& lag : lags) {
    found.lag.push_back(lag.time);
    found.origins.push_back(lag.origins);
    found.moment.push_back(
        mean_of_origins(squared_changes(moments, lag, lag.origins), lag, factor));
  }
  found.shear = slope(lags, moments, scale.relaxation_time, factor);
  return found;
}

}  // namespace vitrel

#include "analysis/pair_correlation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/neighbors/pairs.h"

namespace vitrel {

namespace {

/// (cos 2θ, sin 2θ) of every particle; 0 for those that are round.
std::vector<Vec2> directors(const Configuration2& configuration) {
  std::vector<Vec2> result(configuration.size(), Vec2::Zero());
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const double twice = 2 * configuration.angle[i];
    if (!configuration.shape[i].is_round()) result[i] = {std::cos(twice), std::sin(twice)};
  }
  return result;
}

std::size_t bins_within(const Configuration2& configuration,
                        const PairCorrelationOptions& options) {
  const double range = std::min(options.distance_max, 0.5 * configuration.box.lengths().minCoeff());
  // A quotient that rounding leaves just below a whole number is one.
  return static_cast<std::size_t>(range / options.distance_step * (1 + 1e-12));
}

}  // namespace

PairCorrelation pair_correlation(const Configuration2& configuration,
                                 const PairCorrelationOptions& options) {
  const std::size_t bins = bins_within(configuration, options);
  const double step = options.distance_step, range = static_cast<double>(bins) * step;
  PairCorrelation result;
  for (std::vector<double>* row : {&result.g, &result.g_2, &result.g_4, &result.rotor_pairs})
    row->assign(bins, 0);
  if (bins == 0) return result;

  CellGrid<> cells(configuration.box, range, configuration.size());
  for (std::size_t i = 0; i < configuration.size(); ++i)
    cells.insert(i, {configuration.position[i]});
  const std::vector<Vec2> director = directors(configuration);
  for (std::size_t i = 0; i < configuration.size(); ++i)
    cells.for_each_near(configuration.position[i], range,
                        [&](std::size_t j, const Shift<2>&, const Vec2& d) {
                          if (j <= i) return;
                          const auto bin = static_cast<std::size_t>(d.norm() / step);
                          if (bin >= bins) return;
                          result.g[bin] += 1;
                          if (director[i].isZero(0) || director[j].isZero(0)) return;
                          const double cosine = director[i].dot(director[j]);
                          result.rotor_pairs[bin] += 1;
                          result.g_2[bin] += cosine;
                          result.g_4[bin] += 2 * cosine * cosine - 1;
                        });

  const double n = static_cast<double>(configuration.size());
  const double density = 0.5 * n * (n - 1) / configuration.box.volume();
  for (std::size_t bin = 0; bin < bins; ++bin) {
    const double inner = static_cast<double>(bin) * step, outer = inner + step;
    result.distance.push_back(0.5 * (inner + outer));
    result.g[bin] /= density * std::numbers::pi * (outer * outer - inner * inner);
    result.g_2[bin] /= result.rotor_pairs[bin];
    result.g_4[bin] /= result.rotor_pairs[bin];
  }
  return result;
}

}  // namespace vitrel

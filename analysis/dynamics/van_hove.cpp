#include "analysis/dynamics/van_hove.h"

#include <algorithm>
#include <cmath>

#include "analysis/structure/distance_bins.h"
#include "core/neighbors/cell_grid.h"

namespace vitrel {

namespace {

constexpr double max_pairs_per_particle = 1 << 13;

/// Counts in bins; what is farther is not counted.
void count(std::vector<double>& bins, double distance, double width) {
  const double at = distance / width;
  if (at < static_cast<double>(bins.size())) ++bins[static_cast<std::size_t>(at)];
}

std::vector<double> middles(std::size_t bins, double width) {
  std::vector<double> x;
  for (std::size_t k = 0; k < bins; ++k) x.push_back((static_cast<double>(k) + 0.5) * width);
  return x;
}

/// Every so many-th particle at an origin leaves no more pairs than allowed.
template <int Dim>
std::size_t start_stride(const Configuration<Dim>& frame, const std::vector<Lag>& lags,
                         double reach) {
  const double n = static_cast<double>(frame.size());
  double pairs = 0;
  for (const Lag& lag : lags)
    pairs +=
        static_cast<double>(lag.origins) * n * shell_volume<Dim>(0, reach) / frame.box.volume();
  return static_cast<std::size_t>(std::clamp(std::ceil(pairs / max_pairs_per_particle), 1.0, n));
}

}  // namespace

template <int Dim>
TwoTimeFunction<Dim> van_hove_self(const PairCorrelationOptions& options) {
  const double width = options.distance_step;
  const auto bins = static_cast<std::size_t>(options.distance_max / width * (1 + 1e-12));
  return {middles(bins, width), [=](const TwoTimes<Dim>& pair) {
            std::vector<double> row(bins);
            for (const double distance : pair.distance) count(row, distance, width);
            for (double& x : row) x /= width * static_cast<double>(pair.distance.size());
            return row;
          }};
}

template <int Dim>
TwoTimeFunction<Dim> van_hove_distinct(const Configuration<Dim>& first,
                                       const std::vector<Lag>& lags,
                                       const PairCorrelationOptions& options) {
  const DistanceBins<Dim> bins(first, options);
  const std::size_t n = first.size(), stride = start_stride(first, lags, bins.range());
  const auto row_of = [=, box = first.box](const TwoTimes<Dim>& pair) {
    if (bins.count() == 0) return std::vector<double>();
    std::vector<double> found(bins.count() + 1);
    CellGrid<Dim> cells(box, bins.range(), n);
    for (std::size_t j = 0; j < n; ++j) cells.insert(j, pair.end[j]);
    double starts = 0;
    for (std::size_t i = pair.origin % stride; i < n; i += stride, ++starts)
      cells.for_each_near((*pair.start)[i], bins.range(),
                          [&](std::size_t j, const Shift<Dim>&, const Vec<Dim>& separation) {
                            if (j != i) ++found[bins.bin(separation.squaredNorm())];
                          });
    return bins.over_ideal_gas(starts * static_cast<double>(n - 1),
                               [&](std::size_t k) { return found[k]; });
  };
  return {bins.middles(), row_of};
}

template TwoTimeFunction<2> van_hove_self(const PairCorrelationOptions&);
template TwoTimeFunction<3> van_hove_self(const PairCorrelationOptions&);
template TwoTimeFunction<2> van_hove_distinct(const Configuration2&, const std::vector<Lag>&,
                                              const PairCorrelationOptions&);
template TwoTimeFunction<3> van_hove_distinct(const Configuration3&, const std::vector<Lag>&,
                                              const PairCorrelationOptions&);

}  // namespace vitrel

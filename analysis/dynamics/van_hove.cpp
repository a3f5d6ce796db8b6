#include "analysis/dynamics/van_hove.h"

#include <algorithm>
#include <cmath>

#include "analysis/structure/distance_bins.h"
#include "core/neighbors/cell_grid.h"

namespace vitrel {

namespace {

constexpr double max_pairs_per_particle = 1 << 13;

/// Returns the n for which every n-th particle at an origin leaves no more pairs than allowed.
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
  const DistanceBins bins(options.distance_max, options.distance_step);
  return {bins.middles(), [bins](const TwoTimes<Dim>& pair) {
            std::vector<double> row(bins.count() + 1);
            for (const double distance : pair.distance) ++row[bins.bin(distance)];
            row.pop_back();  // particles that moved farther
            for (double& x : row) x /= bins.step() * static_cast<double>(pair.distance.size());
            return row;
          }};
}

template <int Dim>
TwoTimeFunction<Dim> van_hove_distinct(const Configuration<Dim>& first,
                                       const std::vector<Lag>& lags,
                                       const PairCorrelationOptions& options) {
  const DistanceBins bins(first, options);
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
                            if (j != i) ++found[bins.bin(separation.norm())];
                          });
    return bins.over_ideal_gas(starts * static_cast<double>(n - 1), box,
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

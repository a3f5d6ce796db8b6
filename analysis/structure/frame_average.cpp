#include "analysis/structure/frame_average.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "analysis/statistics/blocking.h"
#include "core/special_values.h"

namespace vitrel {

namespace {

/// Returns the weighted mean of one number; `value` is 0 where there is no weight.
Estimate weighted_average(const std::vector<double>& value, const std::vector<double>& weight,
                          std::size_t shortest_block) {
  const double frames = static_cast<double>(value.size());
  double sum = 0, weights = 0;
  for (std::size_t k = 0; k < value.size(); ++k) {
    sum += weight[k] * value[k];
    weights += weight[k];
  }
  if (weights == 0) return {unknown, unknown, 0};
  const double mean = sum / weights;
  std::vector<double> deviation;
  for (std::size_t k = 0; k < value.size(); ++k)
    deviation.push_back(weight[k] * (value[k] - mean) * frames / weights);
  Estimate estimate = slow_average(deviation, shortest_block);
  estimate.mean = mean;
  return estimate;
}

}  // namespace

void FrameAverage::add(std::span<const double> row, std::span<const double> weights) {
  assert(row.size() == weights.size());
  std::vector<double>& kept = rows_.emplace_back(row.begin(), row.end());
  std::vector<double>& kept_weights = weights_.emplace_back(weights.begin(), weights.end());
  for (std::size_t place = 0; place < kept.size(); ++place)
    if (std::isnan(kept[place])) kept[place] = kept_weights[place] = 0;
}

void FrameAverage::add(std::span<const double> row) {
  add(row, std::vector<double>(row.size(), 1.0));
}

Averages FrameAverage::averages(bool even, std::span<const double> slower) const {
  std::size_t shortest_block = 1;
  if (even && !slower.empty()) {
    const std::size_t blocks = slow_average(slower).blocks;
    even = blocks > 0;
    if (even) shortest_block = slower.size() / blocks;
  }
  std::size_t places = 0;
  for (const std::vector<double>& row : rows_) places = std::max(places, row.size());
  Averages result;
  for (std::size_t place = 0; place < places; ++place) {
    std::vector<double> value, weight;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const bool missing = place >= rows_[k].size();
      value.push_back(missing ? 0 : rows_[k][place]);
      weight.push_back(missing ? 0 : weights_[k][place]);
    }
    const Estimate estimate = weighted_average(value, weight, shortest_block);
    result.mean.push_back(estimate.mean);
    result.error.push_back(even ? estimate.error : unknown);
  }
  return result;
}

}  // namespace vitrel

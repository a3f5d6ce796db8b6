#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

/// Whether many values deviate from the truth as much as their errors say.
namespace vitrel {

/// χ² is 1 per value, with the standard deviation √(2/values).
struct ChiSquared {
  double sum = 0, values = 0;

  void add(double deviation, double error) {
    sum += std::pow(deviation / error, 2);
    ++values;
  }
  void expect_one(double deviations) const {
    EXPECT_NEAR(sum / values, 1, deviations * std::sqrt(2 / values));
  }
};

/// The values of every bin in independent samples.
class BinnedValues {
 public:
  /// The bins of one more sample, NaN where it has no value.
  void add(const std::vector<double>& row) {
    values_.resize(row.size());
    for (std::size_t k = 0; k < row.size(); ++k)
      if (!std::isnan(row[k])) values_[k].push_back(row[k]);
  }
  /// Of the means of all bins that have values, from the first or a later one on.
  ChiSquared chi_squared(double truth, std::size_t first = 0) const {
    ChiSquared result;
    for (std::size_t k = first; k < values_.size(); ++k) {
      if (values_[k].empty()) continue;
      const auto n = static_cast<double>(values_[k].size());
      double mean = 0, square = 0;
      for (const double value : values_[k]) mean += value / n;
      for (const double value : values_[k]) square += (value - mean) * (value - mean);
      result.add(mean - truth, std::sqrt(square / (n - 1) / n));
    }
    return result;
  }
  std::size_t size() const { return values_.size(); }

 private:
  std::vector<std::vector<double>> values_;
};

}  // namespace vitrel

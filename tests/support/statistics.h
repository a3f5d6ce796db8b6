#pragma once

#include <cmath>
#include <span>

/// Plain statistics for tests, independent of the analysis library that some of them judge.
namespace vitrel {

struct Estimate {
  double mean;
  double error;  ///< standard error
};

/// Mean and standard error of independent values.
inline Estimate estimate(std::span<const double> values) {
  const double n = static_cast<double>(values.size());
  double sum = 0, square = 0;
  for (double value : values) sum += value;
  const double mean = sum / n;
  for (double value : values) square += (value - mean) * (value - mean);
  return {mean, std::sqrt(square / (n - 1) / n)};
}

}  // namespace vitrel

#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace vitrel::bench {

struct Mean {
  double value, error;  ///< error holds for independent values
};

inline Mean mean_of(const std::vector<double>& values) {
  const double n = static_cast<double>(values.size());
  double sum = 0, square = 0;
  for (const double x : values) sum += x;
  for (const double x : values) square += (x - sum / n) * (x - sum / n);
  return {sum / n, std::sqrt(square / std::max(1., n - 1) / n)};
}

}  // namespace vitrel::bench

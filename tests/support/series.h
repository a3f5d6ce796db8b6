#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/random/stream.h"

namespace vitrel {

/// x_{k+1} = c x_k + √(1 − c²) ξ, from equilibrium: mean 0, variance 1, correlation c^|k|.
inline std::vector<double> autoregressive_series(std::size_t n, double c, Stream& draw) {
  std::vector<double> series(n);
  double x = draw.normal();
  for (double& value : series) {
    value = x;
    x = c * x + std::sqrt(1 - c * c) * draw.normal();
  }
  return series;
}

}  // namespace vitrel

#pragma once

#include <cstdint>
#include <optional>

#include "mc/options.h"

namespace vitrel {

/// Growth of all lengths in one stretch of growth, at most.
inline constexpr double largest_growth_of_stretch = 0.01;

/// Alternating growth and Monte Carlo (hybrid.h).
struct HybridOptions {
  double growth_rate = 1e-2;
  std::optional<double> packing_fraction;     ///< target, reached exactly
  std::optional<double> reduced_pressure;     ///< target
  SamplingOptions stretch = {.sweeps = 100};  ///< of Monte Carlo
  std::uint64_t seed = 1;
};

}  // namespace vitrel

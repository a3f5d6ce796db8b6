#pragma once

#include <cstdint>
#include <optional>

#include "mc/options.h"

namespace vitrel {

/// Upper bound of the growth of all lengths in one interval.
inline constexpr double largest_growth_of_stretch = 0.01;

/// Alternating growth and Monte Carlo (hybrid.h).
struct HybridOptions {
  double growth_rate = 1e-2;
  std::optional<double> packing_fraction;     ///< the stage ends exactly at it
  std::optional<double> reduced_pressure;     ///< the stage ends once it is reached
  SamplingOptions stretch = {.sweeps = 100};  ///< one interval of Monte Carlo
  std::uint64_t seed = 1;
};

}  // namespace vitrel

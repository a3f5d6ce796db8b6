#pragma once

#include <cstdint>
#include <optional>

#include "mc/options.h"

namespace vitrel {

/// Growth and Monte Carlo in turn (hybrid.h).
struct HybridOptions {
  double growth_rate = 1e-2;
  std::optional<double> packing_fraction;     ///< ends there, exactly
  std::optional<double> reduced_pressure;     ///< ends at such a pressure
  SamplingOptions stretch = {.sweeps = 100};  ///< of Monte Carlo
  std::uint64_t seed = 1;
};

}  // namespace vitrel

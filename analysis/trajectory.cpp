#include "analysis/trajectory.h"

#include <cmath>

namespace vitrel {

bool evenly_spaced(std::span<const double> times) {
  if (times.size() < 3) return true;
  const double interval = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  for (std::size_t k = 1; k < times.size(); ++k)
    if (std::abs(times[k] - times[k - 1] - interval) > 1e-6 * interval) return false;
  return true;
}

}  // namespace vitrel

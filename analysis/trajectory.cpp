#include "analysis/trajectory.h"

#include <algorithm>
#include <cmath>

namespace vitrel {

bool evenly_spaced(std::span<const double> times) {
  if (times.size() < 3) return true;
  const double interval = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  const double greatest = std::max(std::abs(times.front()), std::abs(times.back()));
  const double tolerance = std::min(0x1p-23 * greatest, 0.25 * interval);
  for (std::size_t k = 1; k < times.size(); ++k)
    if (std::abs(times[k] - times.front() - interval * static_cast<double>(k)) > tolerance)
      return false;
  return true;
}

}  // namespace vitrel

#pragma once

#include <vector>

namespace vitrel {

/// Sample times 0, interval, 2 interval, … ≤ duration.
std::vector<double> linear_times(double interval, double duration);

/// Sample times 0, first, first · 10^(1/per_decade), … ≤ duration.
std::vector<double> logarithmic_times(double first, int per_decade, double duration);

}  // namespace vitrel

#pragma once

#include <cstdint>
#include <vector>

namespace vitrel {

/// The evenly spaced times 0, interval, 2 interval, … ≤ duration: their number, and the k-th of them.
std::uint64_t even_count(double interval, double duration);
double even_time(std::uint64_t k, double interval, double duration);

/// All of them, as sample times.
std::vector<double> linear_times(double interval, double duration);

/// Sample times 0, first, first · 10^(1/per_decade), … ≤ duration.
std::vector<double> logarithmic_times(double first, int per_decade, double duration);

}  // namespace vitrel

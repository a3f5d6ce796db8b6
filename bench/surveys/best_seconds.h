#pragma once

#include <algorithm>
#include <chrono>
#include <limits>

namespace vitrel::bench {

/// The time that work() takes on the wall clock.
template <class Work>
double seconds_of(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The shortest of several times of work(), so that interruptions do not count.
template <class Work>
double best_seconds(int repeats, Work&& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < repeats; ++k) best = std::min(best, seconds_of(work));
  return best;
}

}  // namespace vitrel::bench

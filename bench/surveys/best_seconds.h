#pragma once

#include <algorithm>
#include <chrono>
#include <limits>

namespace vitrel::bench {

/// The shortest of several times of work(), so that interruptions do not count.
template <class Work>
double best_seconds(int repeats, Work&& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < repeats; ++k) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    best = std::min(best, spent.count());
  }
  return best;
}

}  // namespace vitrel::bench

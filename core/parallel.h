#pragma once

#include <cstddef>
#include <functional>
#include <limits>

namespace vitrel {

/// A number of threads that stands for as many as the machine has.
inline constexpr int all_cores = std::numeric_limits<int>::max();

/// Calls work(begin, end) for consecutive parts of [0, count) on up to `threads` threads, but no more than the machine
/// has. The partition depends on the number of threads, so the work for one index must not depend on other indices.
/// Rethrows an exception thrown by `work`.
void in_parallel(std::size_t count, int threads,
                 const std::function<void(std::size_t begin, std::size_t end)>& work);

/// Calls work(k) for every k in [0, count), in parallel as `in_parallel` does.
void each_in_parallel(std::size_t count, int threads, const auto& work) {
  in_parallel(count, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) work(k);
  });
}

}  // namespace vitrel

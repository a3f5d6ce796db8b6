#pragma once

#include <cstddef>
#include <functional>
#include <limits>

namespace vitrel {

/// As many threads as the machine has.
inline constexpr int all_cores = std::numeric_limits<int>::max();

/// Calls work(begin, end) for consecutive parts of [0, count), on up to `threads` threads at a time, no
/// more than the machine has. How the range is cut depends on the threads: what is done for one
/// number must not depend on others. An exception thrown by `work` comes out here.
void in_parallel(std::size_t count, int threads,
                 const std::function<void(std::size_t begin, std::size_t end)>& work);

}  // namespace vitrel

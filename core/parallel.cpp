#include "core/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace vitrel {

void in_parallel(std::size_t count, int threads,
                 const std::function<void(std::size_t begin, std::size_t end)>& work) {
  threads = std::min(threads, tbb::this_task_arena::max_concurrency());
  if (threads <= 1) return work(0, count);
  // Several parts per thread, so that none waits long for another.
  const std::size_t part = count / (4 * static_cast<std::size_t>(threads)) + 1;
  thread_local tbb::task_arena arena;  // kept: to make one takes as long as a small piece of work
  if (!arena.is_active() || arena.max_concurrency() != threads) {
    arena.terminate();
    arena.initialize(threads);
  }
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, part),
        [&](const tbb::blocked_range<std::size_t>& range) { work(range.begin(), range.end()); },
        tbb::simple_partitioner());
  });
}

}  // namespace vitrel

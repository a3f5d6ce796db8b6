#include "core/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#ifdef __SANITIZE_THREAD__
#include <atomic>
#include <future>
#include <vector>
#endif

namespace vitrel {

namespace {

using Work = std::function<void(std::size_t begin, std::size_t end)>;

#ifdef __SANITIZE_THREAD__

// The thread sanitizer does not see how oneTBB synchronises its threads and would report its tasks as data races.
void run_parts(std::size_t count, std::size_t part, int threads, const Work& work) {
  std::atomic<std::size_t> next = 0;
  const auto run = [&] {
    for (std::size_t begin = next.fetch_add(part, std::memory_order_relaxed); begin < count;
         begin = next.fetch_add(part, std::memory_order_relaxed))
      work(begin, std::min(begin + part, count));
  };
  std::vector<std::future<void>> running;
  for (int k = 0; k < threads; ++k) running.push_back(std::async(std::launch::async, run));
  for (std::future<void>& one : running) one.get();
}

#else

void run_parts(std::size_t count, std::size_t part, int threads, const Work& work) {
  thread_local tbb::task_arena arena;  // kept: creating one takes as long as a small piece of work
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

#endif

}  // namespace

void in_parallel(std::size_t count, int threads, const Work& work) {
  threads = std::min(threads, tbb::this_task_arena::max_concurrency());
  if (threads <= 1) return work(0, count);
  // Each thread gets several parts, so that none waits long for another.
  run_parts(count, count / (4 * static_cast<std::size_t>(threads)) + 1, threads, work);
}

}  // namespace vitrel

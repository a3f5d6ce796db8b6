#pragma once

namespace vitrel {

/// Prefetches the cache line at this address.
inline void prefetch_line(const void* address) {
  // The line goes into the second-level cache, because the first-level cache would not keep it until it is needed.
  constexpr int read = 0, second_level = 2;
  __builtin_prefetch(address, read, second_level);
  // Without this statement the compiler removes functions that only prefetch.
  asm volatile("");
}

}  // namespace vitrel
